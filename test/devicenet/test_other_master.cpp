// A module that another scanner has, or works with: a release would take its connections away, and with them the time-out
// that stops its motor. Not every module looks who it is that asks for one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint8_t kOther = 17, kBoth = 0x03;

/// Requests to release something, of ours.
std::size_t releases(const ScannerRun& run) {
  std::size_t found = 0;
  for (const std::string& line : run.seen) {
    const bool asks = line.rfind("> 42E#", 0) == 0;
    found += asks && line.substr(8, 2) == "4C" ? 1 : 0;
  }
  return found;
}

/// The other one has it from now on, and was heard to be granted it.
void isTaken(ScannerRun& run) {
  FakeDevice& device = *run.devices[0];
  device.powerOn();
  device.explicit_rate = 60000;
  device.obeys_anybody = true;
  device.belongsTo(kOther, kBoth, run.now);
  run.say("42E#114B03010311");
  run.say("42B#11CB00");
}
/// And it polls it in each cycle.
void isPolled(ScannerRun& run) {
  run.before_cycle = [&run] { run.say("42D#007F040020"); };
}

// It does not tell whose it is, and only the polls say that it is somebody's.
TEST(OtherMaster, OneThatIsPolledIsNotReleased) {
  ScannerRun run{busConfig(1)};
  FakeDevice& device = *run.devices[0];
  device.tells_owner = false;
  device.explicit_rate = 60000;
  device.obeys_anybody = true;
  device.belongsTo(kOther, kBoth, run.now);
  isPolled(run);
  run.begin();
  run.run(seconds{10});
  EXPECT_EQ(0u, releases(run));
  EXPECT_EQ(kBoth, device.held);
  EXPECT_STREQ("is polled by another master", run.scanner.status(0).reason.c_str());
  EXPECT_EQ(0u, run.sentTo("42D"));

  // The other one ends, and its connections are left behind.
  run.before_cycle = nullptr;
  EXPECT_FALSE(run.reaches(NodeState::kExchanging, milliseconds{4900}));
  device.master = 0;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2})) << run.scanner.status(0).reason.c_str();
}

// It was absent, and what it was asked for then had no answer.
TEST(OtherMaster, OneThatTheOtherTakesFirstIsNotReleased) {
  for (int later = 0; later < 1500; later += 50) {
    ScannerRun run{busConfig(1)};
    run.devices[0]->powerOff();
    run.begin();
    run.run(seconds{5} + milliseconds{later});
    isTaken(run);
    run.run(seconds{4});
    EXPECT_EQ(0x00, run.devices[0]->released_last) << later;
    EXPECT_EQ(kBoth, run.devices[0]->held) << later;
    EXPECT_STREQ("is allocated to another master, MAC id 17", run.scanner.status(0).reason.c_str());
  }
}

// It was ours, off for a moment, and came back as the other's: whether that one is heard to be granted it or to poll it, before
// our release, between its two tries, or while the device's own time-out is awaited.
TEST(OtherMaster, OneThatWasOursAndIsTheOthersIsNotReleased) {
  for (const bool polled : {false, true}) {
    for (int later = 20; later < 800; later += 20) {
      ScannerRun run{busConfig(1)};
      ASSERT_TRUE(run.starts());
      run.devices[0]->powerOff();
      run.run(milliseconds{later});
      if (polled) isPolled(run);
      isTaken(run);
      if (polled) run.say("42D#007E040000");
      run.run(seconds{4});
      EXPECT_EQ(0x00, run.devices[0]->released_last) << later << polled;
      EXPECT_EQ(kBoth, run.devices[0]->held) << later << polled;
      EXPECT_EQ(NodeState::kRefused, run.scanner.status(0).state) << later << polled;
    }
  }
}

// The clean exit leaves it as it is, too; also where the release is under way when the other one is heard.
TEST(OtherMaster, AnExitDoesNotReleaseOneThatIsPolled) {
  for (const bool under_way : {false, true}) {
    ScannerRun run{busConfig(1)};
    ASSERT_TRUE(run.starts());
    if (under_way) run.loses = [](const CanFrame& frame) { return frame.id == 0x42E; };
    if (!under_way) run.say("42D#007F040020");
    run.scanner.releaseAll(run.now);
    run.run(milliseconds{100});
    EXPECT_NE(under_way, run.scanner.released());
    run.loses = nullptr;
    run.say("42D#007F040020");
    run.run(seconds{1});
    EXPECT_TRUE(run.scanner.released());
    EXPECT_EQ(0x00, run.devices[0]->released_last) << under_way;
    EXPECT_EQ(NodeState::kReleased, run.scanner.status(0).state);
  }
}

// Who only asks and is refused has nothing of it.
TEST(OtherMaster, OneThatTheOtherWasRefusedIsReleased) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.say("42E#114B03010111");
  run.say("42B#11940B01");
  run.scanner.releaseAll(run.now);
  run.run(milliseconds{100});
  EXPECT_TRUE(run.scanner.released());
  EXPECT_EQ(kBoth, run.devices[0]->released_last);
}

}  // namespace
}  // namespace nord_driver::devicenet
