// One cycle: newest command in, process data out, newest state out; parameters beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

constexpr double kFullSpeed = 157.07963267948966;  // rad/s: 50 Hz, two pole pairs

class BusCycleTest : public ::testing::Test, protected CycleBench {
 protected:
  void bringUp() {
    run(60);
    ASSERT_TRUE(snapshot().drives[kLift].device.complete);
  }
  void enable() {
    const Completion answer = ask(RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
};

TEST_F(BusCycleTest, SendsTheIgnoredWordFirstThenTheIdleWord) {
  step();
  EXPECT_EQ(0x0000, controlWord(kLeft));
  step();
  EXPECT_EQ(0x047E, controlWord(kLeft));
}

TEST_F(BusCycleTest, HandsTheNewestCommandsToTheDrives) {
  bringUp();
  enable();
  commandBase(0.1 * kFullSpeed / 2);
  commandLift(-kFullSpeed / 4);
  step();
  EXPECT_EQ(0x2000, setpoint(kLeft));
  EXPECT_EQ(0x2000, setpoint(kRight));
  EXPECT_EQ(-0x1000, setpoint(kLift));
}

// An old command of one drive alone is none, as cmd_vel's.
TEST_F(BusCycleTest, CommandsOfSingleDrivesTimeOutToo) {
  bringUp();
  enable();
  commandLift(kFullSpeed / 2);
  run(50);
  EXPECT_EQ(0x2000, setpoint(kLift));
  run(2);
  EXPECT_EQ(0, setpoint(kLift));
  EXPECT_EQ(0x047F, controlWord(kLift)) << "the time-out ramps down and stays enabled";
}

TEST_F(BusCycleTest, RefusesToEnableUnderACommandThatMovesAndNamesIt) {
  bringUp();
  commandBase(0.25, 0.5);
  Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("the newest cmd_vel is not zero (0.250 m/s, 0.500 rad/s, 0.0"));
  commandBase(0.0);
  commandLift(1.0);
  answer = ask(RequestKind::kEnable, kLift);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("the newest command of drive lift is not zero (1.000 rad/s)"));
  run(51);  // now it is older than cmd_vel_timeout
  EXPECT_TRUE(ask(RequestKind::kEnable).success);
}

// The driver's idle word may acknowledge a fault at once; what it looked like is kept for those who look less often.
TEST_F(BusCycleTest, AFaultIsKeptAsItWasWhenItRose) {
  bringUp();
  enable();
  commandBase(0.05 * kFullSpeed);
  run(30);
  EXPECT_EQ(0u, snapshot().drives[kRight].faults);
  transport.inverters[kRight].fault = true;
  run(3);
  transport.inverters[kRight].fault = false;
  run(3);
  const DriveSnapshot& drive = snapshot().drives[kRight];
  EXPECT_FALSE(drive.fault);
  EXPECT_EQ(1u, drive.faults) << "once, however long it stood";
  EXPECT_EQ(0u, snapshot().drives[kLeft].faults);
  EXPECT_TRUE(profile::StatusWord{drive.at_fault.input.status_word}.fault());
  EXPECT_EQ(profile::DriveState::kFault, drive.at_fault.state);
  EXPECT_EQ(0x047F, drive.at_fault.output.control_word) << "as sent before it was seen";
  EXPECT_NE(0, drive.at_fault.fault_number);
  transport.inverters[kRight].fault = true;
  run(3);
  transport.inverters[kRight].silent = true;
  run(30);
  transport.inverters[kRight].silent = false;
  run(3);
  EXPECT_EQ(2u, snapshot().drives[kRight].faults) << "the same one when the drive is back";
}

// A drive that stopped is idle, but its base is still on its way to rest: no drive of it gets another ramp or P105 now.
TEST_F(BusCycleTest, NoSetIsSwitchedWhileTheBaseComesToRest) {
  bringUp();
  enable();
  commandBase(0.05 * kFullSpeed);
  run(30);
  transport.inverters[kLeft].ramp = 16;  // takes its time
  transport.inverters[kRight].fault = true;
  run(3);
  transport.inverters[kRight].fault = false;
  run(1);
  ASSERT_EQ(0x047F, controlWord(kLeft));
  Request request;
  request.kind = RequestKind::kSelectParameterSet;
  request.drive = kRight;
  request.parameter_set = 2;
  const Completion answer = ask(request);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("parameter sets are switched at standstill only: disable drive right first", answer.message.c_str());
  EXPECT_EQ(0x047E, controlWord(kRight));
}

// The bus was held up for longer than the asker waited: it was told that it failed, and must not see it succeed now.
TEST_F(BusCycleTest, WhatNobodyWaitsForAnyMoreIsNotBegun) {
  bringUp();
  Request enable;
  enable.kind = RequestKind::kEnable;
  enable.asked = transport.time - std::chrono::seconds{5};
  Completion answer = ask(enable);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("the bus cycle was held up for too long: not carried out", answer.message.c_str());
  run(20);
  EXPECT_EQ(0x047E, controlWord(kLeft));
  enable.asked = transport.time - std::chrono::seconds{1};
  EXPECT_TRUE(ask(enable).success) << "in time";
  // A stop is never too late.
  Request stop;
  stop.kind = RequestKind::kQuickStop;
  stop.asked = transport.time - std::chrono::seconds{5};
  ask(stop);
  run(20);
  EXPECT_EQ(0x047E, controlWord(kLeft));
  EXPECT_FALSE(snapshot().base.enabled);
}

TEST_F(BusCycleTest, PatienceCountsFromTheAsking) {
  bringUp();
  transport.inverters[kLift].stuck = true;
  Request enable;
  enable.kind = RequestKind::kEnable;
  enable.asked = transport.time - std::chrono::milliseconds{2900};
  const Instant begin = transport.time;
  EXPECT_FALSE(ask(enable).success);
  EXPECT_LT(transport.time - begin, std::chrono::milliseconds{200});
}

// Two things a user may ask for at the same time, each with its own way to the inverter.
TEST_F(BusCycleTest, AParameterIsReadWhileAFaultIsAcknowledged) {
  bringUp();
  transport.inverters[kLift].fault = true;
  transport.parameters[700] = 21;
  transport.parameters[102] = 100;
  run(5);
  Request acknowledge, read;
  acknowledge.kind = RequestKind::kAcknowledge;
  read.kind = RequestKind::kReadParameter;
  acknowledge.drive = read.drive = kLift;
  acknowledge.id = 501;
  read.id = 502;
  acknowledge.patience = read.patience = std::chrono::seconds{3};
  read.parameter.number = 102;
  ASSERT_TRUE(ports.submit(acknowledge));
  ASSERT_TRUE(ports.submit(read));
  run(60);
  EXPECT_TRUE(completions[501].success) << completions[501].message.c_str();
  EXPECT_TRUE(completions[502].success) << completions[502].message.c_str();
  EXPECT_EQ(100, completions[502].parameter.raw);
  EXPECT_EQ(0x047E, controlWord(kLift)) << "the acknowledge bit does not stay";
}

TEST_F(BusCycleTest, AnInverterThatIsOffBehindItsModuleIsOffline) {
  bringUp();
  transport.module_only[kLeft] = true;
  run(7);  // drive_timeout is 50 ms
  EXPECT_TRUE(snapshot().drives[kLeft].module_answers);
  EXPECT_FALSE(snapshot().drives[kLeft].online);
  EXPECT_STREQ("the note of the bus", snapshot().drives[kLeft].text.c_str());
  EXPECT_FALSE(ask(RequestKind::kEnable).success);
}

TEST_F(BusCycleTest, PassesTheStateOfTheBusOn) {
  transport.bus_text = "the wire is cut";
  transport.bus_counters.add(bus_counter::kRetries, 7);
  transport.is_connected = false;
  step();
  EXPECT_STREQ("the wire is cut", snapshot().bus_text.c_str());
  EXPECT_EQ(7u, snapshot().counters.value(bus_counter::kRetries));
  EXPECT_FALSE(snapshot().connected);
  EXPECT_EQ(0x7531u, snapshot().drives[kLeft].device.ident);
}

TEST_F(BusCycleTest, TheBaseIsKnownWhenAllItsDrivesHaveAnsweredOnce) {
  transport.inverters[kRight].silent = true;
  run(3);
  EXPECT_FALSE(snapshot().base.known);
  transport.inverters[kRight].silent = false;
  run(1);
  EXPECT_TRUE(snapshot().base.known);
  transport.inverters[kRight].silent = true;
  run(10);
  EXPECT_TRUE(snapshot().base.known) << "once is enough";
}

// The speed a base had when a wheel of it was last seen is not the one it has.
TEST_F(BusCycleTest, NoVelocityIsToldOfABaseWithAWheelThatIsNotSeen) {
  bringUp();
  enable();
  for (int i = 0; i < 30; ++i) {
    commandBase(0.05 * kFullSpeed);
    step();
  }
  ASSERT_GT(snapshot().base.velocity.linear_x, 0.04 * kFullSpeed);
  const double x = snapshot().base.pose.x;
  transport.inverters[kLeft].silent = true;
  run(7);  // drive_timeout is 50 ms
  EXPECT_EQ(0.0, snapshot().base.velocity.linear_x);
  EXPECT_GE(snapshot().base.pose.x, x);
  const double last_seen = snapshot().base.pose.x;
  run(50);
  EXPECT_EQ(last_seen, snapshot().base.pose.x);
}

TEST_F(BusCycleTest, ResetOdometryAnswers) {
  EXPECT_TRUE(ask(RequestKind::kResetOdometry).success);
}

// --- Max frequency: what a setpoint means ----------------------------------------------------------------------------

// SW1 is a share of P105: while nobody knows it, nothing is enabled.
TEST_F(BusCycleTest, NothingIsEnabledBeforeP105IsKnown) {
  transport.hold_answers = true;
  run(10);
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P104, P105, P509, P510, P543, P546 and P600 are still being read"));
}

// A typed max_frequency that is wrong would move the base at another speed until P105 is read, and then step.
TEST(BusCycleTypedFrequency, IsNoLeaveToEnableBeforeP105WasAskedFor) {
  CycleBench bench{100.0};
  bench.transport.hold_answers = true;
  bench.run(10);
  EXPECT_FALSE(bench.ask(RequestKind::kEnable).success);
}

TEST(BusCycleTypedFrequency, GivesWayToP105) {
  CycleBench bench{100.0};  // P105 says 50 Hz
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  bench.commandLift(kFullSpeed / 2);
  bench.step();
  EXPECT_EQ(0x2000, bench.setpoint(CycleBench::kLift));
}

TEST(BusCycleTypedFrequency, ServesADriveThatDoesNotTellP105) {
  CycleBench bench{100.0};
  bench.transport.parameters.clear();
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  bench.commandLift(kFullSpeed / 2);
  bench.step();
  EXPECT_EQ(0x1000, bench.setpoint(CycleBench::kLift));
}

// A drive that was away may be another one now: what P105 said before does not count any more.
TEST_F(BusCycleTest, ADriveThatWasAwayIsAskedForP105AgainBeforeItIsEnabled) {
  bringUp();
  transport.inverters[kLift].silent = true;
  run(10);
  transport.inverters[kLift].silent = false;
  transport.hold_answers = true;
  run(5);
  EXPECT_FALSE(ask(RequestKind::kEnable, kLift).success);
  transport.hold_answers = false;
  transport.answerFirst();
  transport.parameters[105] = 1000;  // 100 Hz
  run(30);
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
}

// An answer to a question from before the loss must not pass for the answer to a new one: P105 of another set, say.
TEST_F(BusCycleTest, AnAnswerFromBeforeALossIsNotTakenForANewOne) {
  transport.parameters = {{1105, 500}, {2105, 1000}, {3105, 500}, {4105, 500}};
  run(2);
  transport.hold_answers = true;
  for (int i = 0; transport.submitted.size() < 3; ++i) {  // each drive has asked for one
    ASSERT_LT(i, 300) << transport.submitted.size() << " of 3 drives have asked for a parameter within 3 s";
    step();
  }
  ASSERT_EQ(kLeft, transport.submitted.front().drive);
  const auto old = transport.submitted.front();
  transport.submitted.clear();
  for (auto& inverter : transport.inverters) inverter.silent = true;
  run(10);
  for (auto& inverter : transport.inverters) inverter.silent = false;
  run(2);
  ASSERT_EQ(kLeft, transport.submitted.front().drive);
  ASSERT_EQ(105, transport.submitted.front().request.number);
  ASSERT_EQ(1, transport.submitted.front().request.parameter_set);
  profile::ParameterResult late;
  late.id = old.request.id;
  late.outcome = profile::ParameterOutcome::kDone;
  late.raw = 1000;  // what the old question was answered with
  transport.results.push_back(late);
  run(1);
  EXPECT_FALSE(snapshot().drives[kLeft].device.max_frequency[0].has_value());
}

// A full queue is no answer: the question is put again until it is taken.
TEST_F(BusCycleTest, AFullQueueDoesNotCostAParameter) {
  transport.queue_full = true;
  run(100);
  transport.queue_full = false;
  run(30);
  EXPECT_TRUE(snapshot().drives[kLeft].device.max_frequency[0].has_value());
}

// --- Parameters for callers ------------------------------------------------------------------------------------------

Request read(DriveIndex drive, std::uint16_t number, std::uint8_t set = 1, bool active = false) {
  Request request;
  request.kind = RequestKind::kReadParameter;
  request.drive = drive;
  request.parameter.number = number;
  request.parameter.shape = profile::ParameterShape::kPerSet;
  request.parameter.parameter_set = active ? std::uint8_t{0} : set;
  return request;
}

TEST_F(BusCycleTest, ReadsAParameterForACaller) {
  bringUp();
  transport.parameters[102] = 250;
  const Completion answer = ask(read(kRight, 102));
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(250, answer.parameter.raw);
}

TEST_F(BusCycleTest, TellsWhyAParameterCannotBeRead) {
  bringUp();
  Completion answer = ask(read(kRight, 102));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(),
              HasSubstr("drive right refuses P102: scripted error 0, the transport's own words"));
  transport.queue_full = true;
  EXPECT_THAT(ask(read(kRight, 102)).message.c_str(), HasSubstr("too many parameter requests waiting"));
  transport.queue_full = false;
  transport.inverters[kRight].silent = true;
  run(10);
  EXPECT_STREQ("drive right does not answer", ask(read(kRight, 102)).message.c_str());
}

TEST_F(BusCycleTest, ReadsTheSetInForceWhenNoneIsNamed) {
  bringUp();
  transport.hold_answers = true;
  ports.submit(read(kRight, 102, 3, true));
  step();
  ASSERT_FALSE(transport.submitted.empty());
  EXPECT_EQ(1, transport.submitted.front().request.parameter_set) << "the inverter reports set 1";
}

// Eight wait; the ninth is refused at once, and none of the others is mixed up.
TEST_F(BusCycleTest, AnswersEachParameterRequestWithItsOwnResult) {
  bringUp();
  transport.hold_answers = true;
  for (std::uint16_t i = 0; i < 9; ++i) {
    Request request = read(kLeft, static_cast<std::uint16_t>(200 + i));
    request.id = 500u + i;
    transport.parameters[200 + i] = 9000 + i;
    ports.submit(request);
  }
  step();
  EXPECT_FALSE(completions.at(508).success);
  EXPECT_EQ(drive::ParameterSession::kLanes, transport.submitted.size())
      << "the running one, and reads ahead of their turn";
  for (int i = 0; i < 8; ++i) {
    ASSERT_FALSE(transport.submitted.empty()) << i;
    transport.answerFirst();
    step();
    step();
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    ASSERT_TRUE(completions.at(500 + i).success);
    EXPECT_EQ(9000 + static_cast<int>(i), completions.at(500 + i).parameter.raw);
  }
}

}  // namespace
}  // namespace nord_driver::cycle
