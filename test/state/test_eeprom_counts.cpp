// The text of the counts: written, read again, and refused where it was damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "state/eeprom_counts.h"

namespace nord_driver::state {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kText[] =
    "# EEPROM writes of the drives, counted by nord_driver before they are done (eeprom_budget).\n"
    "schema: 1\n"
    "drives:\n"
    "  \"can0, address 5, inverter 1, sk2xxe\": {day: 2026-11-23, writes: 3, total: 41}\n";

std::string refusal(const std::string& text) {
  try {
    countsFrom(text, "/a/file");
  } catch (const StateError& error) {
    return error.what();
  }
  return "";
}

TEST(EepromCounts, AreWrittenAndReadTheSame) {
  const EepromCounts counts = countsFrom(kText, "/a/file");
  ASSERT_EQ(1u, counts.count("can0, address 5, inverter 1, sk2xxe"));
  const EepromCount& count = counts.begin()->second;
  EXPECT_EQ(20'780, count.day);
  EXPECT_EQ(3u, count.writes);
  EXPECT_EQ(41u, count.total);
  EXPECT_EQ(kText, textOf(counts));
}

TEST(EepromCounts, KeepAnyName) {
  const EepromCounts counts{{R"(a "quoted" \ end point)", {1, 2, 3}}};
  EXPECT_EQ(counts.begin()->first, countsFrom(textOf(counts), "").begin()->first);
}

TEST(EepromCounts, NameLineAndExpectationOfWhatIsBroken) {
  EXPECT_THAT(refusal(""), HasSubstr("/a/file ends before its line \"drives:\""));
  EXPECT_THAT(refusal("schema: 2\ndrives:\n"), StartsWith("/a/file, line 1: \"schema: 2\", expected schema: 1"));
  EXPECT_THAT(refusal(std::string(64, '\0')), StartsWith("/a/file, line 1: "));
  const std::string text = kText;
  EXPECT_THAT(refusal(text.substr(0, text.size() - 10)), StartsWith("/a/file, line 4: "));
  EXPECT_THAT(refusal(text + "  \"x\": {day: 2026-02-31, writes: 1, total: 1}\n"), StartsWith("/a/file, line 5: "));
  EXPECT_THAT(refusal(text + "  \"x\": {day: 2026-11-23, writes: -1, total: 1}\n"), StartsWith("/a/file, line 5: "));
  EXPECT_THAT(refusal(text + text.substr(text.find("  \"can0"))), HasSubstr("each drive once"));
}

}  // namespace
}  // namespace nord_driver::state
