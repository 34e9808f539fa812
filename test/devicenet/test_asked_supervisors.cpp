// The states of control supervisors (class 41, attribute 6; BU 0280 4.3.6), asked for before process data can change them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::seconds;
using testing::IsEmpty;

ScannerConfig asking(std::uint8_t supervisors) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].asked_supervisors = supervisors;
  return config;
}

/// Where the first frame that begins so was seen.
std::ptrdiff_t place(const ScannerRun& run, const std::string& begin) {
  const auto found = std::find_if(run.seen.begin(), run.seen.end(),
                                  [&](const std::string& frame) { return frame.rfind(begin, 0) == 0; });
  return found - run.seen.begin();
}

TEST(AskedSupervisors, AreToldBeforeTheFirstPollAndBeforeAnyTimeOutRuns) {
  ScannerRun run{asking(0x05)};
  run.devices[0]->attributes[{41, 1, 6}] = {3};
  run.devices[0]->attributes[{41, 3, 6}] = {7};
  ASSERT_TRUE(run.starts());
  const NodeStatus& status = run.scanner.status(0);
  EXPECT_EQ(std::uint8_t{3}, status.supervisors[0]);
  EXPECT_EQ(std::nullopt, status.supervisors[1]);
  EXPECT_EQ(std::uint8_t{7}, status.supervisors[2]);
  EXPECT_EQ(std::nullopt, status.supervisors[3]);
  const std::ptrdiff_t size = place(run, "> 42C#400E050208");
  ASSERT_LT(size, static_cast<std::ptrdiff_t>(run.seen.size()));
  EXPECT_EQ("> 42C#000E290106", run.seen[static_cast<std::size_t>(size) + 2]);
  EXPECT_EQ("> 42C#400E290306", run.seen[static_cast<std::size_t>(size) + 4]);
  EXPECT_EQ("> 42C#0010050209", run.seen[static_cast<std::size_t>(size) + 6].substr(0, 16)) << "the rate is next";
  EXPECT_THAT(run.violations(), IsEmpty());
}

// The object is missing, or the answers get lost: connected all the same.
TEST(AskedSupervisors, WhoDoesNotTellIsConnectedAllTheSame) {
  for (const bool lost : {false, true}) {
    ScannerRun run{asking(0x01)};
    if (lost) run.loses = [](const CanFrame& frame) { return frame.id == 0x42C && frame.data[2] == 41; };
    ASSERT_TRUE(run.starts()) << lost;
    EXPECT_EQ(std::nullopt, run.scanner.status(0).supervisors[0]);
    EXPECT_EQ(0u, run.scanner.status(0).counters.losses);
    EXPECT_THAT(run.violations(), IsEmpty());
  }
}

// What was told of a connection before is forgotten.
TEST(AskedSupervisors, AreAskedAnewForEachConnection) {
  ScannerRun run{asking(0x01)};
  run.devices[0]->attributes[{41, 1, 6}] = {7};
  ASSERT_TRUE(run.starts());
  run.devices[0]->powerOff();
  run.run(seconds{1});
  run.devices[0]->attributes.erase({41, 1, 6});
  run.devices[0]->powerOn();
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{5}));
  EXPECT_EQ(std::nullopt, run.scanner.status(0).supervisors[0]);
}

}  // namespace
}  // namespace nord_driver::devicenet
