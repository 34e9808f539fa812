// A master without a watchdog of its own, which comes for parameters and goes, and a slave that a master with our address
// has left in data exchange: the watchdog of that one is all that stops its drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr const char* kOperate = "68 07 07 68 FF 81 46 3A 3E 00 00 3E 16";
// Of a diagnosis: 08h in the second byte is WD_On, the fourth byte is the master.
constexpr const char* kWatched = kReady;
constexpr const char* kUnwatched = "68 0B 0B 68 81 88 08 3E 3C 00 04 00 01 75 31 36 16";
constexpr const char* kWatchedOther = "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 0B A8 4B 16";
constexpr const char* kSetPrmUnwatched = "68 0C 0C 68 88 81 5D 3D 3E 80 01 01 0B 75 31 00 14 16";

SlaveConfig guest() {
  SlaveConfig slave = nordModule(8);
  slave.watchdog = Duration::zero();
  return slave;
}

/// The longest time a slave can be told, and what its clock may be behind ours.
constexpr Duration kLeftAlone = 650'250ms + 250ms;

/// Nothing goes out until then, looked at twice a second.
void expectSilence(Wire& wire, Instant until) {
  for (; wire.now < until; wire.advance(500ms)) {
    wire.startCycle();
    ASSERT_EQ("", toHex(wire.master.pollTransmit(wire.now)))
        << "so long before: " << toSeconds(until - wire.now) << " s";
    wire.cycleEnds();
  }
}

// Set_Prm would switch its watchdog off and leave the drive as it was told last: it is left to run out, and every request
// would start it anew.
TEST(LeftRunning, IsLeftToItsWatchdog) {
  NordWire wire{quietBus(), guest()};
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  wire.cycle(kDiag6D, kWatched);
  const Instant asked = wire.now;
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_THAT(wire.status().note, HasSubstr("was left in data exchange by its master, and its watchdog runs"));
  EXPECT_STREQ(wire.status().note, wire.tells(DpEventKind::kLeftRunning).text);
  expectSilence(wire, asked + kLeftAlone - 1s);
  wire.now = asked + kLeftAlone;
  wire.cycle(kDiag6D, kWantsPrm);
  wire.cycle(kSetPrmUnwatched, kShortAcknowledge);
  wire.tellsNothing();
}

// It wanted parameters, and took ours without a watchdog: what runs now is no killed master's. Going on would feed it.
TEST(LeftRunning, AWatchdogBehindOurOwnParametersIsNamedAsOne) {
  NordWire wire{quietBus(), guest()};
  wire.isFound();
  wire.isFree();
  wire.cycle(kSetPrmUnwatched, kShortAcknowledge);
  wire.takesConfiguration();
  wire.forgetEvents();
  wire.cycle(kDiag5D, kWatched);
  const Instant asked = wire.now;
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_THAT(wire.status().note, HasSubstr("shows a running watchdog (WD_On) though it was told none"));
  EXPECT_STREQ(wire.status().note, wire.tells(DpEventKind::kLeftRunning).text);
  expectSilence(wire, asked + kLeftAlone - 1s);
  // Later, too, it was not left by a master: it may show that bit for ever.
  wire.now = asked + kLeftAlone;
  wire.cycle(kDiag6D, kWatched);
  EXPECT_THAT(wire.status().note, HasSubstr("though it was told none"));
  expectSilence(wire, wire.now + kLeftAlone - 1s);
  // Run out.
  wire.advance(kLeftAlone);
  wire.cycle(kDiag6D, kWantsPrm);
  wire.cycle(kSetPrmUnwatched, kShortAcknowledge);
}

// One that still runs then has been fed by somebody else: once more, and told once.
TEST(LeftRunning, IsLeftAloneAgain) {
  NordWire wire{quietBus(), guest()};
  wire.isFound();
  wire.cycle(kDiag6D, kWatched);
  wire.forgetEvents();
  wire.advance(kLeftAlone);
  wire.cycle(kDiag6D, kWatched);
  expectSilence(wire, wire.now + kLeftAlone - 1s);
  wire.tellsNothing();
}

// Global_Control is a request of its master, too.
TEST(LeftRunning, IsSentNoBroadcast) {
  BusParameters bus = quietBus();
  bus.operate_interval = 1s;
  bus.sync_outputs = true;
  NordWire wire{bus, guest()};
  wire.startCycle();
  wire.sends(kOperate);
  EXPECT_FALSE(wire.master.cycleDone());
  while (wire.status().phase != SlavePhase::kBackOff && wire.now < Instant{std::chrono::hours{1}} + 10s) {
    const std::string request = toHex(wire.master.pollTransmit(wire.now));
    if (request == kFdlStatus8) {
      wire.receives(kHere8);
    } else if (request == kDiag6D) {
      wire.receives(kWatched);
    } else if (const auto deadline = wire.master.nextDeadline()) {
      wire.now = std::max(wire.now, *deadline);
      wire.master.handleTimeout(wire.now);
    } else {
      wire.startCycle();
    }
  }
  ASSERT_EQ(SlavePhase::kBackOff, wire.status().phase);
  while (!wire.master.cycleDone()) wire.staysSilent();
  expectSilence(wire, wire.now + 60s);
}

// Polled as a stranger it would be kept running just as well.
TEST(LeftRunning, AnotherDeviceThanConfiguredIsLeftAloneToo) {
  NordWire wire{quietBus(), guest()};
  wire.isFound();
  wire.cycle(kDiag6D, kWatchedOther);
  expectSilence(wire, wire.now + 60s);
}

// As the run before has left it: nothing in it will ever stop its drive, and it is parameterised.
TEST(LeftRunning, OneWithoutAWatchdogIsParameterised) {
  NordWire wire{quietBus(), guest()};
  wire.isFound();
  wire.cycle(kDiag6D, kUnwatched);
  wire.cycle(kSetPrmUnwatched, kShortAcknowledge);
}

// Who brings a watchdog of its own takes the drive over.
TEST(LeftRunning, ADriverParameterisesItAtOnce) {
  NordWire wire;
  wire.isFound();
  wire.cycle(kDiag6D, kWatched);
  wire.takesParameters();
}

}  // namespace
}  // namespace nord_driver::profibus
