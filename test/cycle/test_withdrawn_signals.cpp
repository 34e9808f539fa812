// A signal that may move a drive, through its stops: none leaves it high, and nothing but "off" or an enabling brings it
// back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "cycle/signals_bench.h"

namespace nord_driver::cycle {
namespace {

// Bits of the control word that terminals can take away as well (BU 2700 6.4.1).
constexpr Word kOff2 = 0x0002, kOff3 = 0x0004;

/// What happens at an inverter by itself.
struct Incident {
  const char* name;
  void (*set)(drive::FakeInverter&, bool stands);
  void begin(drive::FakeInverter& inverter) const { set(inverter, true); }
  void end(drive::FakeInverter& inverter) const { set(inverter, false); }
};
const Incident kIncidents[] = {
    {"fault", [](drive::FakeInverter& inverter, bool stands) { inverter.fault = stands; }},
    {"local control", [](drive::FakeInverter& inverter, bool stands) { inverter.local = stands; }},
    {"OFF2", [](drive::FakeInverter& inverter, bool stands) { inverter.taken = stands ? kOff2 : Word{0}; }},
    {"OFF3", [](drive::FakeInverter& inverter, bool stands) { inverter.taken = stands ? kOff3 : Word{0}; }},
};

/// Control bit 8 with P480 = 1, "enable right", accepted by may_move: at the standard rate of its publisher, 10 Hz.
class MovingSignal : public Signals {
 public:
  explicit MovingSignal(int function = 1, std::uint8_t signals = 1, DriveIndex drive = kLift,
                        std::optional<DriveIndex> absent = std::nullopt)
      : Signals{accepted(signals), drive} {
    transport.parameters[480] = function;
    if (absent) transport.inverters[*absent].silent = true;
    run(120);
  }
  static std::vector<SignalSetup> accepted(std::uint8_t count) {
    std::vector<SignalSetup> signals;
    for (std::uint8_t i = 0; i < count; ++i) signals.push_back(output(SignalSource::kControlBit, 8 + i));
    for (SignalSetup& signal : signals) signal.may_move = true;
    return signals;
  }
  bool bit() const { return (sent().control_word & 0x0100) != 0; }
  /// `cycles` of 10 ms with fresh commands; how many of them had the bit high.
  int refresh(int cycles, bool on = true) {
    int high = 0;
    for (int i = 0; i < cycles; ++i) {
      if (i % 10 == 0) command(on);
      commandLift(velocity);
      step();
      high += bit() ? 1 : 0;
    }
    return high;
  }
  void drive() {
    ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
    velocity = 50.0;
    ASSERT_GT(refresh(30), 25);
  }
  /// It is lost and comes back with the incident; what P480 says is not read before answerAll().
  void comeBackUnread(const Incident& incident) {
    transport.inverters[kLift].silent = true;
    run(50);
    transport.hold_answers = true;
    transport.inverters[kLift].silent = false;
    incident.begin(transport.inverters[kLift]);
    run(10);
  }
  void submit(RequestKind kind, DriveIndex drive = kLift) {
    Request request;
    request.kind = kind;
    request.drive = drive;
    ports.submit(request);
  }
  /// Back by "off" and "on" of its own.
  void expectOffAndOnBringItBack() {
    EXPECT_EQ(0, refresh(10, false));
    EXPECT_EQ(10, refresh(10));
  }
  void expectOffAndOnInVain() {
    EXPECT_EQ(0, refresh(10, false));
    EXPECT_EQ(0, refresh(50));
  }
  double velocity = 0.0;
};

TEST(WithdrawnSignalsTest, AFaultOfItsOwnTakesItAwayUntilItWasOff) {
  MovingSignal bench;
  bench.drive();
  bench.transport.inverters[CycleBench::kLift].fault = true;
  bench.step();  // its word went out before the fault was told
  EXPECT_EQ(0, bench.refresh(50));
  ASSERT_TRUE(bench.ask(RequestKind::kAcknowledge, CycleBench::kLift).success);
  EXPECT_EQ(0, bench.refresh(300)) << "an acknowledged fault moves nothing";
  bench.expectOffAndOnBringItBack();
}

// Disabled, its motor was turned by the bit alone.
TEST(WithdrawnSignalsTest, AFaultOfADisabledDriveTakesItAway) {
  MovingSignal bench;
  ASSERT_EQ(20, bench.refresh(20));
  bench.transport.inverters[CycleBench::kLift].fault = true;
  bench.step();
  EXPECT_EQ(0, bench.refresh(50));
  bench.expectOffAndOnInVain();
  ASSERT_TRUE(bench.ask(RequestKind::kAcknowledge, CycleBench::kLift).success);
  EXPECT_EQ(0, bench.refresh(300));
  bench.expectOffAndOnBringItBack();
}

TEST(WithdrawnSignalsTest, LocalControlTakesItAway) {
  for (const bool enabled : {true, false}) {
    MovingSignal bench;
    if (enabled) bench.drive();
    ASSERT_GT(bench.refresh(20), 0);
    bench.transport.inverters[CycleBench::kLift].local = true;
    bench.step();
    EXPECT_EQ(0, bench.refresh(20)) << enabled;
    bench.transport.inverters[CycleBench::kLift].local = false;
    EXPECT_EQ(0, bench.refresh(300)) << enabled;
    bench.expectOffAndOnBringItBack();
  }
}

// Disabled, nothing but bits 4 and 5 of the status word tell of them: the drive has no motion of its own to stop.
TEST(WithdrawnSignalsTest, Off2AndOff3AtTheTerminalsTakeItAway) {
  for (const bool enabled : {true, false}) {
    for (const Word bit : {kOff2, kOff3}) {
      MovingSignal bench;
      if (enabled) bench.drive();
      ASSERT_GT(bench.refresh(20), 0);
      bench.transport.inverters[CycleBench::kLift].taken = bit;
      bench.step();
      EXPECT_EQ(0, bench.refresh(20)) << enabled << bit;
      bench.transport.inverters[CycleBench::kLift].taken = 0;
      EXPECT_EQ(0, bench.refresh(300)) << enabled << bit;
      bench.expectOffAndOnBringItBack();
    }
  }
}

TEST(WithdrawnSignalsTest, OffAndOnDoNotBringItBackWhileAStopStands) {
  for (const Incident& incident : kIncidents) {
    MovingSignal bench;
    incident.begin(bench.transport.inverters[CycleBench::kLift]);
    bench.step();
    bench.expectOffAndOnInVain();
    incident.end(bench.transport.inverters[CycleBench::kLift]);
    EXPECT_EQ(0, bench.refresh(300)) << incident.name;
    bench.expectOffAndOnBringItBack();
  }
}

TEST(WithdrawnSignalsTest, WhatStopsAnotherDriveOfItsBaseTakesItAwayUntilThatHasEnded) {
  for (const Incident& incident : kIncidents) {
    for (const bool enabled : {true, false}) {
      MovingSignal bench{1, 1, CycleBench::kLeft};
      ASSERT_TRUE(!enabled || bench.ask(RequestKind::kEnable).success);
      ASSERT_EQ(20, bench.refresh(20));
      incident.begin(bench.transport.inverters[CycleBench::kRight]);
      bench.step();
      EXPECT_EQ(0, bench.refresh(300)) << incident.name << enabled;
      bench.expectOffAndOnInVain();
      incident.end(bench.transport.inverters[CycleBench::kRight]);
      EXPECT_EQ(0, bench.refresh(300)) << incident.name << enabled;
      bench.expectOffAndOnBringItBack();
    }
  }
}

// Nobody has told that it has ended.
TEST(WithdrawnSignalsTest, AStopStandsWhereItsDriveIsNoLongerHeard) {
  MovingSignal bench{1, 1, CycleBench::kLeft};
  drive::FakeInverter& right = bench.transport.inverters[CycleBench::kRight];
  right.taken = kOff3;
  bench.step();
  right.silent = true;
  EXPECT_EQ(0, bench.refresh(50));
  bench.expectOffAndOnInVain();
}

TEST(WithdrawnSignalsTest, ADriveThatWasNeverHeardStopsNoOther) {
  MovingSignal bench{1, 1, CycleBench::kLeft, CycleBench::kRight};
  EXPECT_EQ(50, bench.refresh(50));
}

// 10 and 11, low, are OFF2 and OFF3; 12 acknowledges; 14, low, is local control.
constexpr int kEndStops[] = {10, 11, 12, 14};

TEST(WithdrawnSignalsTest, OffAndOnBringBackWhatMayEndAStopThatStands) {
  for (const int function : kEndStops) {
    for (const Incident& incident : kIncidents) {
      MovingSignal bench{function};
      incident.begin(bench.transport.inverters[CycleBench::kLift]);
      bench.step();
      EXPECT_EQ(0, bench.refresh(50)) << function << incident.name;
      bench.expectOffAndOnBringItBack();
    }
  }
}

// A drive that comes online with one, say under local control for this very bit: nobody knows at first what the bit is.
TEST(WithdrawnSignalsTest, WhatMayEndAStopThatStandsNeedsNoSecondOnOnceItsFunctionIsRead) {
  for (const int function : kEndStops) {
    for (const Incident& incident : kIncidents) {
      for (const bool on_before : {false, true}) {
        MovingSignal bench{function};
        if (on_before) bench.refresh(10);
        bench.comeBackUnread(incident);
        if (on_before) bench.refresh(10, false);
        EXPECT_EQ(0, bench.refresh(20)) << "not known";
        bench.transport.answerAll();
        bench.refresh(100);
        EXPECT_EQ(10, bench.refresh(10)) << function << incident.name << on_before;
      }
    }
  }
}

// What was told before its end is no order for afterwards, though the stop ends before anybody knows the function.
TEST(WithdrawnSignalsTest, AStopThatEndsBeforeTheFunctionIsReadTakesItAwayAllTheSame) {
  for (const Incident& incident : kIncidents) {
    MovingSignal bench;
    bench.comeBackUnread(incident);
    bench.expectOffAndOnInVain();
    incident.end(bench.transport.inverters[CycleBench::kLift]);
    EXPECT_EQ(0, bench.refresh(20));
    bench.transport.answerAll();
    EXPECT_EQ(0, bench.refresh(300)) << incident.name;
    bench.expectOffAndOnBringItBack();
  }
}

// Nor does a stop that another drive of the base has had all along hide its own. Both may have to be ended by a signal of
// their own.
TEST(WithdrawnSignalsTest, EachIncidentOfABaseTakesItAwayAnew) {
  for (const int function : kEndStops) {
    for (const Incident& incident : kIncidents) {
      MovingSignal bench{function, 1, CycleBench::kLeft};
      incident.begin(bench.transport.inverters[CycleBench::kRight]);
      bench.step();
      bench.expectOffAndOnBringItBack();
      incident.begin(bench.transport.inverters[CycleBench::kLeft]);
      bench.step();
      EXPECT_EQ(0, bench.refresh(100)) << function << incident.name;
      bench.expectOffAndOnBringItBack();
    }
  }
}

TEST(WithdrawnSignalsTest, WhatStopsADriveBesideTheBaseLeavesIt) {
  for (const Incident& incident : kIncidents) {
    MovingSignal bench{1, 1, CycleBench::kLeft};
    ASSERT_EQ(20, bench.refresh(20));
    incident.begin(bench.transport.inverters[CycleBench::kLift]);
    EXPECT_EQ(100, bench.refresh(100)) << incident.name;
  }
}

TEST(WithdrawnSignalsTest, AQuickStopTakesItAwayUntilItWasOff) {
  for (const bool enabled : {true, false}) {
    MovingSignal bench;
    if (enabled) bench.drive();
    ASSERT_GT(bench.refresh(20), 0);
    bench.submit(RequestKind::kQuickStop, kAllDrives);
    EXPECT_EQ(0, bench.refresh(500)) << enabled;
    bench.expectOffAndOnBringItBack();
  }
}

// From the first word of the ramp on, and of a drive that was not enabled, too.
TEST(WithdrawnSignalsTest, DisablingTakesItAwayUntilItWasOff) {
  for (const bool enabled : {true, false}) {
    MovingSignal bench;
    if (enabled) bench.drive();
    ASSERT_GT(bench.refresh(20), 0);
    bench.submit(RequestKind::kDisable);
    EXPECT_EQ(0, bench.refresh(500)) << enabled;
    bench.expectOffAndOnBringItBack();
  }
}

TEST(WithdrawnSignalsTest, ALossTakesItAwayUntilItWasOff) {
  MovingSignal bench;
  ASSERT_EQ(20, bench.refresh(20));
  bench.transport.inverters[CycleBench::kLift].silent = true;
  bench.refresh(50);
  bench.transport.inverters[CycleBench::kLift].silent = false;
  EXPECT_EQ(0, bench.refresh(300)) << "a drive that comes back moves nothing";
  bench.expectOffAndOnBringItBack();
}

TEST(WithdrawnSignalsTest, AnInterruptionWithinACycleTakesItAway) {
  MovingSignal bench;
  ASSERT_EQ(20, bench.refresh(20));
  bench.transport.interrupted[CycleBench::kLift] = true;
  bench.step();
  EXPECT_EQ(0, bench.refresh(300));
  bench.expectOffAndOnBringItBack();
}

TEST(WithdrawnSignalsTest, EnablingGivesItBack) {
  MovingSignal bench;
  bench.drive();
  bench.submit(RequestKind::kQuickStop);
  ASSERT_EQ(0, bench.refresh(200));
  bench.velocity = 0.0;
  bench.refresh(10);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  EXPECT_EQ(20, bench.refresh(20));
}

// "On" again before the stop has ended is no order for afterwards; "off" of a cycle nobody has seen is one.
TEST(WithdrawnSignalsTest, OffCountsFromTheEndOfTheStopOn) {
  MovingSignal bench;
  bench.drive();
  bench.submit(RequestKind::kDisable);
  bench.refresh(2);
  bench.refresh(2, false);
  EXPECT_EQ(0, bench.refresh(500));
  bench.command(false);
  bench.command(true);
  bench.step();
  EXPECT_TRUE(bench.bit());
}

// Each by itself; what P480 gives no function stays where it is.
TEST(WithdrawnSignalsTest, EverySignalIsGivenBackByItself) {
  MovingSignal bench{1, 2};
  bench.command(true, 1);
  ASSERT_EQ(20, bench.refresh(20));
  bench.submit(RequestKind::kQuickStop);
  ASSERT_EQ(0, bench.refresh(100));
  bench.command(false, 1);
  bench.step();
  bench.command(true, 1);
  bench.refresh(2);
  EXPECT_EQ(0x0200, bench.sent().control_word & 0x0300);
  MovingSignal harmless{0};
  ASSERT_EQ(20, harmless.refresh(20));
  harmless.submit(RequestKind::kQuickStop);
  EXPECT_EQ(100, harmless.refresh(100));
}

}  // namespace
}  // namespace nord_driver::cycle
