// What a device that fell silent while it was moving is sent yet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint8_t kRuns = 0x7F, kStops = 0x7E;  // low byte of the control word

/// A device that runs, as its scanner is told, and is not heard any more.
ScannerConfig movingConfig(IoKind kind) {
  ScannerConfig config = busConfig(1);
  config.nodes[0] = nodeConfig(5, kind);
  return config;
}
bool fallsSilent(ScannerRun& run) {
  run.before_cycle = [&run] { run.scanner.setMoves(0, run.output[1] == kRuns); };
  run.output[1] = kRuns;
  if (!run.starts()) return false;
  run.run(milliseconds{100});
  run.devices[0]->unheard = true;
  return run.reaches(NodeState::kLost, seconds{1});
}

// Its commander may not have decided yet when it is lost: until what stops it was given, its outputs go on.
TEST(LastOutputs, OneThatFallsSilentWhileItMovesIsSentWhatStopsIt) {
  for (const IoKind kind : {IoKind::kPoll, IoKind::kStrobe, IoKind::kChangeOfState, IoKind::kCyclic}) {
    ScannerRun run{movingConfig(kind)};
    FakeDevice& device = *run.devices[0];
    ASSERT_TRUE(fallsSilent(run)) << toText(kind);
    run.run(milliseconds{300});
    EXPECT_EQ(kRuns, device.output[1]) << toText(kind);
    run.output[1] = kStops;
    run.scanner.hurry(0);
    run.run(milliseconds{50});
    EXPECT_EQ(kStops, device.output[1]) << toText(kind);
    EXPECT_EQ(0u, device.io_deaths) << toText(kind);
    run.run(milliseconds{200});
    EXPECT_EQ(1u, device.io_deaths) << toText(kind) << ": nothing is sent any more";
    EXPECT_EQ(1u, run.count(DevicenetEventKind::kNodeLost)) << toText(kind);
    device.unheard = false;
    EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2})) << toText(kind);
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// Nobody decides: its own time-out stops it, a second later than before.
TEST(LastOutputs, WhatASilentDeviceIsSentHasAnEnd) {
  ScannerRun run{movingConfig(IoKind::kPoll)};
  ASSERT_TRUE(fallsSilent(run));
  run.run(milliseconds{990});
  EXPECT_EQ(0u, run.devices[0]->io_deaths);
  run.run(milliseconds{140});
  EXPECT_EQ(1u, run.devices[0]->io_deaths);
  EXPECT_EQ(0x00, run.devices[0]->released_last);
  run.run(milliseconds{110});
  EXPECT_EQ(0x03, run.devices[0]->released_last);
}

// A clean exit, and a bus that is lost, in that second: nothing is sent any more, and it is not released before its time-out.
TEST(LastOutputs, WhatASilentDeviceIsSentEndsWithTheBus) {
  for (const bool restarts : {false, true}) {
    ScannerRun run{movingConfig(IoKind::kPoll)};
    ASSERT_TRUE(fallsSilent(run));
    run.run(milliseconds{100});
    if (restarts) {
      run.scanner.restart(run.now);
    } else {
      run.scanner.releaseAll(run.now);
    }
    EXPECT_TRUE(run.scanner.released()) << "nothing is waited for";
    const std::size_t polls = run.sentTo("42D");
    run.run(milliseconds{130});
    EXPECT_EQ(polls, run.sentTo("42D"));
    EXPECT_EQ(1u, run.devices[0]->io_deaths);
    EXPECT_EQ(0x00, run.devices[0]->released_last);
  }
}

}  // namespace
}  // namespace nord_driver::devicenet
