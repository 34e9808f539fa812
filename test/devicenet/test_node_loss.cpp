#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

// Silent process data: lost after four times the rate it answered, let go with the bits that are allocated, and back
// when it answers again.
TEST(NodeLoss, SilentProcessData) {
  ScannerRun run{busConfig(2)};
  ASSERT_TRUE(run.starts());
  run.devices[0]->deaf_to_io = true;
  const Instant silent = run.now;
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  EXPECT_GE(run.now - silent, milliseconds{110});
  EXPECT_LE(run.now - silent, milliseconds{135});
  EXPECT_EQ("gave no answer to our commands for 120 ms", run.eventText(DevicenetEventKind::kNodeLost));
  // Released at once it would have nobody who watches it, if it hears us: it gives up by itself first.
  run.run(milliseconds{210});
  EXPECT_EQ(0x00, run.devices[0]->released_last);
  run.run(milliseconds{20});
  EXPECT_EQ(0x03, run.devices[0]->released_last);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(1).state) << "the other is not concerned";
  run.devices[0]->deaf_to_io = false;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// Who sleeps until the next deadline wakes up for the silence of process data, too: four times the rate it answered.
TEST(NodeLoss, SilenceOfProcessDataIsADeadline) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.devices[0]->deaf_to_io = true;
  const std::size_t polls = run.sentTo("42D");
  ASSERT_TRUE(run.runUntil([&] { return run.sentTo("42D") > polls; }, milliseconds{20}));
  const Instant asked = run.now;
  while (run.scanner.status(0).state == NodeState::kExchanging) {
    const auto deadline = run.scanner.nextDeadline();
    ASSERT_TRUE(deadline);
    ASSERT_LE(*deadline - asked, milliseconds{120}) << "nobody would look in time";
    run.now = std::max(*deadline, run.now);
    run.scanner.poll(run.now);
  }
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
}

// Its answers are lost, and it hears us: nothing it says beside its process data shortens the wait for its own time-out. A
// question for its MAC id may be that of a second device.
TEST(NodeLoss, ASignOfLifeDoesNotReleaseADeviceThatMayStillRun) {
  for (const char* sign : {"42B#05CD010003000000", "42F#00850178563412"}) {
    ScannerConfig config = busConfig(1);
    config.nodes[0].io.expected_packet_rate = seconds{1};
    ScannerRun run{config};
    ASSERT_TRUE(run.starts());
    run.loses = [](const CanFrame& frame) { return frame.id == 0x3C5; };
    ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{5}));
    for (int i = 0; i < 7; ++i) {
      run.run(milliseconds{500});
      run.say(sign);
    }
    run.run(milliseconds{400});
    EXPECT_EQ(0x00, run.devices[0]->released_last) << sign;
    EXPECT_EQ(0u, run.devices[0]->io_deaths);
    run.loses = nullptr;
    run.run(milliseconds{200});
    EXPECT_EQ(0x03, run.devices[0]->released_last);
    EXPECT_EQ(1u, run.devices[0]->io_deaths) << "it gave up by itself, before it was released";
    EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// It is not heard, and counts its time-out from our last output in steps of its own: not released before it has given up,
// wherever in our cycle it fell silent.
TEST(NodeLoss, ADeviceThatCountsInStepsGivesUpBeforeItIsReleased) {
  for (const unsigned step : {0u, 2u, 10u, 100u}) {
    for (unsigned later = 0; later < 10; ++later) {
      ScannerRun run{busConfig(1)};
      run.devices[0]->timeout_step = milliseconds{step};
      ASSERT_TRUE(run.starts());
      run.run(milliseconds{later});
      run.loses = [](const CanFrame& frame) { return frame.id == 0x3C5; };
      ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{2}));
      ASSERT_TRUE(run.runUntil([&] { return run.devices[0]->released_last == 0x03; }, seconds{1}));
      EXPECT_EQ(1u, run.devices[0]->io_deaths) << "steps of " << step << " ms, " << later << " ms later";
    }
  }
}

// The same where our bus was lost and came back.
TEST(NodeLoss, ADeviceThatCountsInStepsGivesUpBeforeARestartReleasesIt) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  run.devices[0]->timeout_step = milliseconds{100};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{50});
  run.scanner.handleBusLost("bus-off", run.now);
  run.scanner.restart(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{6}));
  EXPECT_EQ(1u, run.devices[0]->io_deaths);
}

// The clean exit does not release it either: its own time-out stops it, which a release would take away.
TEST(NodeLoss, AnExitDoesNotReleaseADeviceThatMayStillRun) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.loses = [](const CanFrame& frame) { return frame.id == 0x3C5; };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{5}));
  run.run(milliseconds{500});
  run.scanner.releaseAll(run.now);
  EXPECT_TRUE(run.scanner.released()) << "nothing is waited for";
  run.run(seconds{5});
  EXPECT_EQ(0x00, run.devices[0]->released_last);
  EXPECT_EQ(1u, run.devices[0]->io_deaths);
}

// Our bus was lost and came back: the device's own time-out may be longer than the check for our MAC id takes.
TEST(NodeLoss, ARestartDoesNotReleaseADeviceThatMayStillRun) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{50});
  Sentence why;
  why = "bus-off";
  run.scanner.handleBusLost(why, run.now);
  run.scanner.restart(run.now);
  run.run(milliseconds{3900});
  EXPECT_EQ(0x00, run.devices[0]->released_last);
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{1}));
  EXPECT_EQ(1u, run.devices[0]->io_deaths);
}

// It fell silent, and our bus was opened anew in the time that is left to it: that time goes on.
TEST(NodeLoss, ARestartWhileItsOwnTimeOutIsAwaitedDoesNotReleaseIt) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.loses = [](const CanFrame& frame) { return frame.id == 0x3C5; };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{5}));
  const Instant lost = run.now;
  run.run(milliseconds{200});
  run.loses = nullptr;
  Sentence why;
  why = "bus-off";
  run.scanner.handleBusLost(why, run.now);
  run.scanner.restart(run.now);
  run.run(milliseconds{3900} - (run.now - lost));
  EXPECT_EQ(0x00, run.devices[0]->released_last);
  EXPECT_EQ(0x03, run.devices[0]->held);
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
}

// Switched off and on: it knows nothing of us any more.
TEST(NodeLoss, PowerCycle) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.devices[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.run(seconds{10});
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  EXPECT_EQ(1u, run.scanner.status(0).counters.losses);
  run.devices[0]->powerOn();
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  EXPECT_EQ(0x02, run.devices[0]->allocated_last);
}

// After a loss the outputs of before are not sent: the first poll needs a new value.
TEST(NodeLoss, OutputsAreForgotten) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.sets_outputs = false;
  run.devices[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.devices[0]->powerOn();
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  const std::size_t polls = run.sentTo("42D");
  run.run(milliseconds{50});
  EXPECT_EQ(polls, run.sentTo("42D"));
  EXPECT_EQ(0u, run.scanner.input(0).count);
}

// An idle explicit connection dies after four times its rate (2.5 s): it is kept alive.
TEST(NodeLoss, ExplicitConnectionIsKeptAlive) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.run(std::chrono::minutes{5});
  EXPECT_EQ(0u, run.devices[0]->explicit_deaths);
  EXPECT_THAT(run.scanner.status(0).counters.keep_alives, testing::AllOf(testing::Ge(100u), testing::Le(130u)));
  EXPECT_EQ(1u, run.scanner.status(0).counters.connections);
}

// It died all the same: it is allocated again, beside process data that go on.
TEST(NodeLoss, ExplicitConnectionIsReopened) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.devices[0]->held &= 0xFE;
  run.run(seconds{5});
  EXPECT_EQ(0x03, run.devices[0]->held);
  EXPECT_EQ(1u, run.scanner.status(0).counters.reopened);
  EXPECT_EQ(0u, run.scanner.status(0).counters.losses);
}

// The device says that its connection is not established any more, or has none.
TEST(NodeLoss, ConnectionGoneByItsOwnWord) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.before_cycle = [&] {
    run.devices[0]->say(dataFrame(0x3C5, FixedBytes<8>{0, 0, 0, 0, 0}));  // as if it answered
    run.devices[0]->established = false;
    run.devices[0]->timed_out = true;
  };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{4}));
  EXPECT_EQ("says that its connection for poll is timed out", run.eventText(DevicenetEventKind::kNodeLost));
}

// Another one releases in our name: the device is asked at once.
TEST(NodeLoss, ReleasedByAnother) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const auto foreign = frame("42E#004C030102");
  run.devices[0]->receive(foreign, run.now);
  run.scanner.handleFrame(foreign, run.now);
  ASSERT_EQ(0, run.devices[0]->held & 2);
  ASSERT_TRUE(run.reaches(NodeState::kLost, milliseconds{20})) << "two cycles";
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
}

// Facts 3.5: heartbeat 4Dh and shutdown 4Eh on the identifier of explicit responses, with the device's own MAC id.
TEST(NodeLoss, HeartbeatAndShutdown) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.say("42B#05CD010003000000");
  run.say("42B#05CD010003000000");
  run.step();
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kHeartbeat)) << "told when it changes";
  EXPECT_EQ(2u, run.scanner.status(0).counters.heartbeats);
  EXPECT_EQ(std::uint8_t{3}, run.scanner.status(0).device_state);
  run.events.clear();
  run.say("42B#05CD010004040000");
  run.step();
  EXPECT_EQ("says in its heartbeat that its state is \"major fault, recoverable\" (4), fault flags 04h",
            run.eventText(DevicenetEventKind::kHeartbeat));
  ASSERT_EQ(1u, run.events.size());
  EXPECT_EQ(0x0404u, run.events[0].value) << "state and flags";
  run.events.clear();
  run.say("42B#06CD010003000000");  // the header names another device
  run.step();
  EXPECT_EQ(0u, run.count(DevicenetEventKind::kHeartbeat));
  run.say("42B#05CD0100");
  EXPECT_EQ(1u, run.scanner.status(0).counters.malformed);
  run.say("42B#05CE010001000200");
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  EXPECT_STREQ("says that it shuts down: class 1, instance 1, code 0002h", run.scanner.status(0).reason.c_str());
  run.step();
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kShutdown));
}

// A device that starts is tried at once, not after the rest of the pause.
TEST(NodeLoss, AStartingDeviceIsTriedSoon) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->powerOff();
  run.begin();
  run.run(seconds{20});
  std::size_t asked = run.sentTo("42E");
  ASSERT_TRUE(run.runUntil([&] { return run.sentTo("42E") == asked + 2; }, seconds{3}));
  run.run(milliseconds{300});
  asked = run.sentTo("42E");
  run.devices[0]->powerOn();
  run.say("42F#00850178563412");
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{60}));
}

// The clean exit: process data end at once, what is allocated is released.
TEST(NodeLoss, ReleaseAll) {
  ScannerRun run{busConfig(3)};
  run.devices[2]->powerOff();
  run.begin();
  run.run(seconds{4});
  run.scanner.releaseAll(run.now);
  EXPECT_FALSE(run.scanner.released());
  const std::size_t polls = run.sentTo("42D");
  EXPECT_TRUE(run.runUntil([&] { return run.scanner.released(); }, seconds{1}));
  EXPECT_EQ(0, run.devices[0]->held | run.devices[1]->held);
  EXPECT_EQ(0x03, run.devices[0]->released_last);
  run.run(seconds{5});
  EXPECT_EQ(polls, run.sentTo("42D"));
  EXPECT_EQ(NodeState::kReleased, run.scanner.status(0).state);
  EXPECT_EQ(0u, run.count(DevicenetEventKind::kNodeLost));
}

// This computer stood still for longer than the device waits: it has given up, and the words that were current before
// must not reach anybody. It is connected anew.
TEST(NodeLoss, AfterAStandstillOfOursNothingOldIsSent) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{100});
  const std::size_t polls = run.sentTo("42D");
  run.now += milliseconds{150};
  run.step();
  while (run.scanner.status(0).state == NodeState::kExchanging && run.sentTo("42D") == polls) run.step();
  EXPECT_EQ(polls, run.sentTo("42D"));
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  EXPECT_THAT(run.eventText(DevicenetEventKind::kNodeLost),
              testing::HasSubstr("was sent nothing for more than 120 ms"));
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{500}));
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// State and faults, each for itself; the same again is no news, but after the bus was opened anew.
TEST(NodeLoss, AHeartbeatIsToldWhenEitherPartChanges) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const auto toldAfter = [&run](const char* heartbeat) {
    run.say(heartbeat);
    run.step();
    return run.count(DevicenetEventKind::kHeartbeat);
  };
  EXPECT_EQ(1u, toldAfter("42B#05CD010003000000"));
  EXPECT_EQ(2u, toldAfter("42B#05CD010003010000")) << "a fault";
  EXPECT_EQ(3u, toldAfter("42B#05CD010002010000")) << "another state";
  EXPECT_EQ(3u, toldAfter("42B#05CD010002010000"));
  EXPECT_EQ(std::uint8_t{2}, run.scanner.status(0).device_state);
  EXPECT_EQ(std::uint8_t{1}, run.scanner.status(0).fault_flags);
  run.scanner.handleBusLost("can0: bus-off", run.now);
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{5}));
  EXPECT_FALSE(run.scanner.status(0).device_state);
  EXPECT_EQ(4u, toldAfter("42B#05CD010002010000"));
}

}  // namespace
}  // namespace nord_driver::devicenet
