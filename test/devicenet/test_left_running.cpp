// Modules that a killed driver has left with a turning motor, and a program for parameters that starts behind it: the
// module's own time-out is all that stops the motor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ScannerConfig explicitConfig(Duration rate) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.kind = IoKind::kNone;
  config.nodes[0].io.expected_packet_rate = rate;
  return config;
}

// Nothing is allocated or released before it has stopped, and its connection for process data never is released: whoever
// its master was, and whether or not it tells.
TEST(LeftRunning, ItsOwnTimeOutStopsItBeforeItIsAskedForAnything) {
  for (const bool tells : {true, false}) {
    ScannerRun run{explicitConfig(seconds{1})};
    FakeDevice& device = *run.devices[0];
    run.no_inputs = true;
    device.tells_owner = tells;
    device.timeout_step = milliseconds{100};
    run.begin();
    device.wasPolledBy(0, 1100, run.now);  // a rate that it has rounded up
    run.runUntil([&] { return run.sentTo("42E") != 0; }, seconds{10});
    EXPECT_EQ(1u, device.io_deaths) << tells;
    EXPECT_EQ(0x03, device.held) << tells;
    ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{1})) << run.scanner.status(0).reason.c_str();
    EXPECT_EQ(0x03, device.held) << "its process data stay as they are";
    run.scanner.releaseAll(run.now);
    ASSERT_TRUE(run.runUntil([&] { return run.scanner.released(); }, seconds{1}));
    EXPECT_EQ(0x02, device.held);
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// A module that was configured otherwise runs for longer than that: it is not let go of either.
TEST(LeftRunning, ALongerTimeOutGoesOn) {
  ScannerRun run{explicitConfig(milliseconds{25})};
  FakeDevice& device = *run.devices[0];
  run.no_inputs = true;
  run.begin();
  device.wasPolledBy(0, 2000, run.now);
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{4}));
  EXPECT_EQ(0x01, device.released_last);
  EXPECT_TRUE(device.established);
  run.run(seconds{7});
  EXPECT_EQ(1u, device.io_deaths);
  EXPECT_EQ(0x03, device.held);
}

// By the defaults the check for our MAC id takes longer, and nothing more is waited for.
TEST(LeftRunning, AShortTimeOutDelaysNothing) {
  ScannerRun run{explicitConfig(milliseconds{25})};
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{2100}));
}

// While it is left to its time-out that is said, and no frame goes to it.
TEST(LeftRunning, TheReasonIsTold) {
  ScannerRun run{explicitConfig(seconds{1})};
  run.begin();
  run.run(milliseconds{4400});
  EXPECT_EQ(NodeState::kAbsent, run.scanner.status(0).state);
  EXPECT_STREQ(
      "is asked for nothing before its own time-out must have run out: whoever had it before may have left its motor "
      "turning",
      run.scanner.status(0).reason.c_str());
  EXPECT_TRUE(run.scanner.isLeftAlone(0));
  EXPECT_EQ(0u, run.sentTo("42E") + run.sentTo("42C"));
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{300}));
  EXPECT_FALSE(run.scanner.isLeftAlone(0));
  EXPECT_STREQ("", run.scanner.status(0).reason.c_str());
}

}  // namespace
}  // namespace nord_driver::devicenet
