#include <gtest/gtest.h>

#include "commissioning/bus_selection.h"
#include "commissioning/checked_drive.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;

// Typed from BU 0020 6.1.2 and 6.2.2, BU 0070 5.1, BU 0280 5.1.3 and BU 2700 7.2. 0: no manual at hand prints it.
struct Row {
  Series series;
  const char* transport;
  bool behind_module;
  std::int32_t control_word;
};

constexpr Row kRows[] = {
    {Series::kSk1x0e, "profibus_dp", true, 3},   {Series::kSk2xxe, "profibus_dp", true, 3},
    {Series::kSk2xxe, "canopen", false, 3},      {Series::kSk2xxe, "devicenet", true, 3},
    {Series::kSk5xxe, "profibus_dp", false, 4},  {Series::kSk5xxe, "profibus_dp", true, 6},
    {Series::kSk5xxe, "profibus_ms2", false, 4}, {Series::kSk5xxe, "interbus", false, 5},
    {Series::kSk5xxe, "canopen", false, 6},      {Series::kSk5xxe, "canopen", true, 6},
    {Series::kSk5xxe, "devicenet", false, 7},    {Series::kSk5xxe, "devicenet", true, 6},
    {Series::kSk54xe, "profibus_dp", false, 4},  {Series::kSk54xe, "profibus_dp", true, 6},
    {Series::kSk300e, "profibus_dp", false, 10}, {Series::kSk700e, "profibus_dp", false, 10},
    {Series::kSk750e, "profibus_dp", false, 10}, {Series::kSk700e, "interbus", false, 14},
    {Series::kSk300e, "canopen", false, 0},      {Series::kSk750e, "devicenet", false, 0},
};

TEST(BusSelection, IsTheManuals) {
  for (const Row& row : kRows) {
    AskedDrive asked = askedDrive(row.series, row.transport);
    asked.identity.timeout_owner = row.behind_module ? TimeoutOwner::kModule : TimeoutOwner::kInverter;
    const BusSelection selection = busSelection({asked, knownOf(asked), {}, 1});
    EXPECT_EQ(row.control_word, selection.control_word.value_or(0))
        << profile::toString(row.series) << " " << row.transport;
    EXPECT_FALSE(selection.controlWordFits(0)) << "terminals";
    EXPECT_FALSE(selection.controlWordFits(1)) << "terminals";
    EXPECT_TRUE(selection.setpointFits(0)) << "as P509";
  }
}

TEST(BusSelection, CountsP510OfTheOlderSeriesOtherwise) {
  for (const auto& [transport, number] : std::vector<std::pair<const char*, std::int32_t>>{
           {"profibus_dp", 3}, {"interbus", 4}, {"canopen", 5}, {"devicenet", 6}}) {
    const AskedDrive asked = askedDrive(Series::kSk700e, transport);
    EXPECT_EQ(number, busSelection({asked, knownOf(asked), {}, 1}).setpoint) << transport;
  }
}

}  // namespace
}  // namespace nord_driver::commissioning
