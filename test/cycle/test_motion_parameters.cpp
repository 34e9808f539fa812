// Parameters that decide whether and how a motor follows: when they are written, and what enabling waits for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/parameter_requests.h"

namespace nord_driver::cycle {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Request write(int number, std::int32_t raw) {
  return test::writeRequest(CycleBench::kLift, static_cast<std::uint16_t>(number), raw);
}

class MotionParameters : public ::testing::Test, protected CycleBench {
 protected:
  void bringUp() {
    run(80);
    ASSERT_TRUE(snapshot().drives[kLift].device.complete);
  }
};

TEST_F(MotionParameters, AreNotWrittenWhileEnabled) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  for (const int number :
       {104, 105, 113, 114, 300, 301, 325, 465, 480, 507, 509, 510, 543, 544, 545, 546, 547, 548, 551}) {
    const Completion answer = ask(write(number, 1));
    EXPECT_FALSE(answer.success);
    EXPECT_THAT(answer.message.c_str(),
                AllOf(HasSubstr("P" + std::to_string(number)), HasSubstr("disable drive lift first")));
    EXPECT_TRUE(decidesMotion(write(number, 1)));
  }
  EXPECT_THAT(ask(write(104, 1)).message.c_str(),
              HasSubstr("P104 (Minimum frequency) decides whether and how the motor turns"));
  EXPECT_THAT(ask(write(300, 1)).message.c_str(), HasSubstr("P300 decides whether and how the motor turns"));
  for (const int number : {102, 103, 310, 426}) {
    EXPECT_FALSE(decidesMotion(write(number, 1)));
    EXPECT_THAT(ask(write(number, 1)).message.c_str(), Not(HasSubstr("disable"))) << number;
  }
  Request read = write(104, 1);
  read.kind = RequestKind::kReadParameter;
  EXPECT_FALSE(decidesMotion(read));
}

// What stands at a terminal acts at once: "enable right", a fixed frequency, "remote control" (P420 to P425, P470), a voltage
// as "frequency addition" (P400, P405), and a brake at an output (P434, P441, P443, P450, P455, P541; the module's relay, P150,
// and its terminals, P154).
TEST_F(MotionParameters, AreTheFunctionsOfTheTerminalsToo) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  for (const int number :
       {150, 154, 400, 405, 420, 421, 422, 423, 424, 425, 434, 441, 443, 450, 455, 470, 480, 481, 541}) {
    EXPECT_THAT(ask(write(number, 1)).message.c_str(), HasSubstr("disable drive lift first")) << number;
  }
}

// A module's relay may be the brake of another inverter behind it.
TEST_F(MotionParameters, TheRelayOfAModuleIsLeftAloneWhileAnyDriveIsEnabled) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  Request relay = write(150, 1);
  relay.drive = 0;
  EXPECT_THAT(ask(relay).message.c_str(), HasSubstr("disable drive lift first"));
  relay.parameter.number = 154;
  EXPECT_THAT(ask(relay).message.c_str(), HasSubstr("disable drive lift first"));
  relay.parameter.number = 420;
  EXPECT_THAT(ask(relay).message.c_str(), Not(HasSubstr("disable")));
}

// A drive that was lost a moment ago may turn still: what stops it is sent on.
TEST_F(MotionParameters, TheRelayOfAModuleIsLeftAloneWhileALostDriveIsStopped) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  transport.inverters[kLift].silent = true;
  run(30);
  ASSERT_FALSE(snapshot().drives[kLift].online);
  Request relay = write(150, 1);
  relay.drive = 0;
  EXPECT_THAT(ask(relay).message.c_str(), HasSubstr("disable drive lift first"));
}

// The write was allowed while all were at rest; carried out later it must not meet one that turns meanwhile.
TEST_F(MotionParameters, NoDriveIsEnabledWhileTheRelayOfAModuleIsWritten) {
  for (const int number : {150, 154}) {
    CycleBench bench;
    bench.run(80);
    bench.transport.hold_answers = true;
    Request relay = write(number, 1);
    relay.drive = 0;
    const std::uint32_t written = bench.submit(relay);
    bench.run(3);
    ASSERT_EQ(0u, bench.completions.count(written)) << number;
    const std::uint32_t enable = bench.submit(RequestKind::kEnable, kLift);
    bench.run(60);
    EXPECT_EQ(0u, bench.completions.count(enable)) << number;
    EXPECT_EQ(0x047E, bench.controlWord(kLift)) << number;
    bench.transport.answerAll();
    bench.run(60);
    EXPECT_EQ(1u, bench.completions.count(written)) << number;
    ASSERT_EQ(1u, bench.completions.count(enable)) << number;
    EXPECT_TRUE(bench.completions[enable].success) << bench.completions[enable].message.c_str();
  }
}

// A time-out shorter than the bus cycle, or another address: one wheel coasts.
TEST_F(MotionParameters, AreWhatTheDriveIsReachedByAndWhenItTripsToo) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  for (const int number : {120, 502, 503, 508, 511, 512, 513, 514, 515, 523, 550, 552}) {
    EXPECT_THAT(ask(write(number, 1)).message.c_str(), HasSubstr("disable drive lift first")) << number;
  }
  for (const int number : {121, 501, 504, 506, 516, 560}) EXPECT_FALSE(decidesMotion(write(number, 1))) << number;
}

// What stops the wheels when this computer dies is told as it is now, not as it was when the drive came.
TEST_F(MotionParameters, TheTimeOutThatWasWrittenIsReadAgain) {
  transport.parameters[513] = 5;
  bringUp();
  EXPECT_DOUBLE_EQ(0.5, snapshot().drives[kLift].device.telegram_timeout.value());
  transport.parameters[513] = -1;  // the scripted inverter stores nothing
  ask(write(513, -1));
  run(5);
  EXPECT_DOUBLE_EQ(-0.1, snapshot().drives[kLift].device.telegram_timeout.value());
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success) << "it waits for what decides motion alone";
}

// P600 to P631 but for the positions themselves (BU 0020 7.3.5: P613 is the array).
TEST_F(MotionParameters, DecideThePositionToo) {
  for (const int number : {600, 610, 612, 614, 631}) EXPECT_TRUE(changesProcessData(write(number, 1))) << number;
  for (const int number : {599, 613, 632}) EXPECT_FALSE(changesProcessData(write(number, 1))) << number;
}

// P543 to P548, not those beside them.
TEST_F(MotionParameters, DecideWhatTheWordsMean) {
  for (int number = 543; number <= 548; ++number) EXPECT_TRUE(changesProcessData(write(number, 1))) << number;
  for (const int number : {542, 549}) {
    EXPECT_FALSE(changesProcessData(write(number, 1))) << number;
    EXPECT_FALSE(decidesMotion(write(number, 1))) << number;
  }
}

TEST_F(MotionParameters, AMinimumFrequencyRefusesToEnable) {
  transport.parameters[1104] = 25;
  transport.parameters[2104] = 80;
  bringUp();
  EXPECT_THAT(ask(RequestKind::kEnable, kLift).message.c_str(),
              HasSubstr("drive lift: P104 of parameter set 1 is 2.5 Hz"));
}

TEST_F(MotionParameters, AnotherFunctionRefusesToEnable) {
  transport.parameters[1543] = 3;
  bringUp();
  EXPECT_THAT(ask(RequestKind::kEnable, kLift).message.c_str(),
              HasSubstr("drive lift: P543 of parameter set 1 is 3, so that actual value 1 is not the frequency"));
}

// P105 is there, P104 not yet: it may be anything.
TEST_F(MotionParameters, NothingIsEnabledBeforeTheyHaveBeenAskedFor) {
  transport.hold_answers = true;
  int answered = 0;
  while (answered < 3 * 15) {
    step();
    while (!transport.submitted.empty() && answered < 3 * 15) {
      transport.answerFirst();
      ++answered;
    }
  }
  step();
  ASSERT_TRUE(snapshot().drives[kLift].device.max_frequency[3]);
  const Completion early = ask(RequestKind::kEnable, kLift);
  EXPECT_FALSE(early.success);
  EXPECT_THAT(early.message.c_str(), HasSubstr("P104, P105, P509, P510, P543, P546 and P600 are still being read"));
  transport.answerAll();
  run(5);
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
}

// It is a matter of a second: whoever asked waits for it, and need not ask again.
TEST_F(MotionParameters, EnablingWaitsForThem) {
  transport.hold_answers = true;
  run(5);
  submit(RequestKind::kEnable, kLift);
  run(100);
  EXPECT_EQ(0u, completions.count(last_id));
  EXPECT_EQ(0x047E, controlWord(kLift));
  transport.answerAll();
  run(60);
  ASSERT_EQ(1u, completions.count(last_id));
  EXPECT_TRUE(completions[last_id].success) << completions[last_id].message.c_str();
}

// A command that comes meanwhile ends the waiting for good: who was told no must not see it succeed when the parameters
// are there and the command is over.
TEST_F(MotionParameters, ACommandEndsTheWaitingForThem) {
  transport.hold_answers = true;
  run(5);
  Request request;
  request.kind = RequestKind::kEnable;
  request.id = ++last_id;
  request.patience = std::chrono::seconds{10};
  ports.submit(request);
  run(5);
  EXPECT_EQ(0u, completions.count(last_id));
  commandBase(0.2);
  run(2);
  ASSERT_EQ(1u, completions.count(last_id));
  EXPECT_FALSE(completions[last_id].success);
  transport.answerAll();
  run(200);
  ASSERT_TRUE(snapshot().drives[kLift].device.complete);
  EXPECT_FALSE(snapshot().base.enabled);
  EXPECT_EQ(0x047E, controlWord(kLeft));
  EXPECT_TRUE(ask(RequestKind::kEnable).success) << "asked anew, it is";
}

// Each answer makes room for the next access.
TEST_F(MotionParameters, AccessesLeaveNothingBehind) {
  bringUp();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(ask(write(105, 500)).success) << i;
}

// A write is checked when it is asked for and carried out later: until its answer the motor stays without torque.
TEST_F(MotionParameters, EnablingWaitsForAWriteUnderWay) {
  for (const int number : {113, 300, 301, 325, 507, 551}) {
    CycleBench bench;
    bench.run(80);
    bench.transport.hold_answers = true;
    Request change = write(number, 1);
    change.id = ++bench.last_id;
    change.patience = std::chrono::seconds{10};
    bench.ports.submit(change);
    bench.step();
    Request enable;
    enable.kind = RequestKind::kEnable;
    enable.drive = kLift;
    enable.id = ++bench.last_id;
    enable.patience = std::chrono::seconds{10};
    bench.ports.submit(enable);
    for (int i = 0; i < 100; ++i) {
      bench.step();
      ASSERT_EQ(0x047E, bench.controlWord(kLift)) << number;
    }
    ASSERT_EQ(0u, bench.completions.count(enable.id)) << number;
    bench.transport.answerAll();
    bench.run(20);
    EXPECT_EQ(1u, bench.completions.count(change.id)) << number;
    ASSERT_EQ(1u, bench.completions.count(enable.id)) << number;
    EXPECT_TRUE(bench.completions[enable.id].success) << bench.completions[enable.id].message.c_str();
  }
}

// Its asker has given up; what was sent may still be carried out.
TEST_F(MotionParameters, EnablingWaitsForAnOverdueWriteToo) {
  bringUp();
  transport.hold_answers = true;
  Request change = write(301, 1);
  change.id = ++last_id;
  change.patience = std::chrono::milliseconds{100};
  ports.submit(change);
  run(30);
  ASSERT_EQ(1u, completions.count(change.id));
  const Completion refused = ask(RequestKind::kEnable, kLift);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message.c_str(), HasSubstr("drive lift"));
  transport.answerAll();
  run(5);
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
}

// What cannot be read refuses nothing.
TEST_F(MotionParameters, ThatCannotBeReadRefuseNothing) {
  bringUp();
  EXPECT_FALSE(snapshot().drives[kLift].device.min_frequency[0]);
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
}

// It says "not now", and a moment later that it is 5 Hz.
TEST_F(MotionParameters, EnablingWaitsForWhatIsRefusedForTheMoment) {
  transport.not_now[{kLift, 1104}] = 1;
  transport.of_drive[kLift][104] = 50;
  bringUp();
  const Completion answer = ask(RequestKind::kEnable, kLift);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive lift: P104 of parameter set 1 is 5.0 Hz"));
}

// Not for ever: what cannot be read refuses nothing. But what it turns out to be later stops the drive.
TEST_F(MotionParameters, WhatIsReadLateStopsTheDrive) {
  for (const int number : {104, 509, 543, 546, 600}) {
    CycleBench bench;
    for (const int set : {0, 1000}) bench.transport.not_now[{kLift, number + set}] = 1000;
    bench.transport.of_drive[kLift][number] = number == 509 ? 9 : 50;
    bench.run(1000);
    ASSERT_TRUE(bench.ask(RequestKind::kEnable, kLift).success) << number;
    bench.transport.not_now.clear();
    for (int i = 0; i < 300; ++i) {
      bench.commandLift(0.0);
      bench.step();
    }
    EXPECT_EQ(0x047E, bench.controlWord(kLift)) << number;
    EXPECT_EQ(drive::StopCause::kUnsuitable, bench.snapshot().drives[kLift].stop_cause) << number;
    EXPECT_FALSE(bench.ask(RequestKind::kEnable, kLift).success) << number;
  }
}

// It may be another inverter that answers now, or this one with other parameters.
TEST_F(MotionParameters, AreReadAgainAfterAnInterruptionWithinACycle) {
  bringUp();
  transport.interrupted[kLift] = true;
  transport.hold_answers = true;
  run(3);
  EXPECT_TRUE(snapshot().drives[kLift].online);
  const std::uint32_t enable = submit(RequestKind::kEnable, kLift);
  run(20);
  EXPECT_EQ(0u, completions.count(enable));
  transport.of_drive[kLift][105] = 800;
  transport.answerAll();
  run(80);
  ASSERT_EQ(1u, completions.count(enable));
  EXPECT_TRUE(completions[enable].success) << completions[enable].message.c_str();
  EXPECT_EQ(80.0, snapshot().drives[kLift].device.max_frequency[0]);
}

TEST_F(MotionParameters, ARefusedWriteWithoutBusControlNamesP509) {
  bringUp();
  EXPECT_THAT(ask(write(102, 1)).message.c_str(), Not(HasSubstr("P509")));
  transport.inverters[kLift].local = true;
  run(5);
  EXPECT_THAT(ask(write(102, 1)).message.c_str(), AllOf(HasSubstr("drive lift refuses P102"), HasSubstr("P509")));
}

}  // namespace
}  // namespace nord_driver::cycle
