// Further setpoints through the whole cycle: which word they go to, from when, and what they are without a command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cycle/cycle_bench.h"
#include "cycle/parameter_requests.h"

namespace nord_driver::cycle {
namespace {

using profile::WordUse;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int16_t kFull = 16384, kHalf = 8192;

SetpointSetup torqueLimit(std::optional<double> limit = std::nullopt) {
  SetpointSetup setpoint;
  setpoint.name = "grip";
  setpoint.use = WordUse::kTorqueLimit;
  setpoint.nominal = 100.0;
  setpoint.limit = limit;
  setpoint.timeout = std::chrono::milliseconds{300};
  return setpoint;
}

// In Hz, of P105 = 50 Hz.
SetpointSetup addition(double limit = 10.0) {
  SetpointSetup setpoint;
  setpoint.name = "boost";
  setpoint.use = WordUse::kFrequencyAddition;
  setpoint.limit = limit;
  setpoint.neutral = 0.0;
  setpoint.timeout = std::chrono::milliseconds{300};
  setpoint.moves = true;
  setpoint.is_signed = true;
  return setpoint;
}

CycleConfig configured(const std::vector<SetpointSetup>& setpoints) {
  CycleConfig config = CycleBench::config();
  config.drives[CycleBench::kLift].words.setpoints = setpoints;
  return config;
}

class FurtherSetpoints : public CycleBench {
 public:
  explicit FurtherSetpoints(const std::vector<SetpointSetup>& setpoints) : CycleBench{configured(setpoints)} {
    for (const int number : {543, 546}) transport.parameters[number] = 1;
    for (const int number : {544, 545, 548}) transport.parameters[number] = 0;
    functionOfWord2(2);
  }
  /// P547 of every parameter set.
  void functionOfWord2(std::int32_t code) {
    for (int set = 1; set <= 4; ++set) transport.parameters[1000 * set + 547] = code;
  }
  bool command(double value) { return ports.commandSetpoint(kLift, 0, value, transport.time); }
  std::int16_t word(std::size_t place) const { return transport.outputs[kLift].setpoints[place - 1]; }
};

TEST(FurtherSetpointsTest, GoToTheWordWithTheirFunction) {
  FurtherSetpoints bench{{torqueLimit()}};
  bench.run(120);
  EXPECT_EQ(kFull, bench.word(2)) << "P547 = 2; before a command it is what P112 allows";
  EXPECT_EQ(0, bench.word(3));
  bench.command(50.0);
  bench.step();
  EXPECT_EQ(kHalf, bench.word(2));
  EXPECT_EQ(kHalf, bench.snapshot().drives[CycleBench::kLift].output.setpoints[1]) << "as users see it";
  FurtherSetpoints other{{torqueLimit()}};
  other.functionOfWord2(0);
  other.transport.parameters[548] = 2;
  other.run(120);
  EXPECT_EQ(0, other.word(2));
  EXPECT_EQ(kFull, other.word(3));
}

TEST(FurtherSetpointsTest, ATimeOutGoesBackToTheLimitAndNotToNone) {
  FurtherSetpoints bench{{torqueLimit(75.0)}};
  bench.run(120);
  EXPECT_EQ(12288, bench.word(2)) << "75 %";
  bench.command(25.0);
  bench.run(2);
  EXPECT_EQ(4096, bench.word(2));
  bench.run(40);
  EXPECT_EQ(12288, bench.word(2));
  bench.command(300.0);
  bench.step();
  EXPECT_EQ(12288, bench.word(2)) << "saturated";
  bench.command(-300.0);
  bench.step();
  EXPECT_EQ(0, bench.word(2)) << "a limit has no other direction";
}

TEST(FurtherSetpointsTest, WhatIsNoNumberIsNoCommand) {
  FurtherSetpoints bench{{torqueLimit()}};
  bench.run(120);
  bench.command(50.0);
  EXPECT_FALSE(bench.command(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(bench.command(std::numeric_limits<double>::infinity()));
  bench.step();
  EXPECT_EQ(kHalf, bench.word(2));
}

// The words of the parameter set that is commanded count: P547 may be another in each.
TEST(FurtherSetpointsTest, HeedTheParameterSet) {
  FurtherSetpoints bench{{torqueLimit()}};
  bench.transport.parameters[2547] = 0;
  bench.transport.parameters[2548] = 2;
  bench.run(120);
  Request request;
  request.kind = RequestKind::kSelectParameterSet;
  request.drive = CycleBench::kLift;
  request.parameter_set = 2;
  ASSERT_TRUE(bench.ask(request).success);
  EXPECT_EQ(0, bench.word(2));
  EXPECT_EQ(kFull, bench.word(3));
}

TEST(FurtherSetpointsTest, AreRefusedAtEnableWithTheParameterToSet) {
  FurtherSetpoints bench{{torqueLimit()}};
  bench.functionOfWord2(4);  // frequency addition
  bench.transport.parameters[1548] = 0;
  bench.run(120);
  EXPECT_EQ(0, bench.word(2)) << "nothing is sent to a word of another function";
  const Completion answer = bench.ask(RequestKind::kEnable, CycleBench::kLift);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(),
              AllOf(HasSubstr("set P548 of drive lift to 2 (Torque current limit) in parameter set 1"),
                    HasSubstr("P548 is 0")));
  FurtherSetpoints unread{{torqueLimit()}};
  for (int set = 1; set <= 4; ++set) unread.transport.parameters.erase(1000 * set + 547);
  unread.transport.parameters.erase(547);
  unread.transport.parameters[548] = 4;
  unread.run(120);
  EXPECT_THAT(unread.ask(RequestKind::kEnable, CycleBench::kLift).message.c_str(), HasSubstr("P547 could not be read"));
}

// What can turn the motor: nothing before the drive follows its own command, and nothing after.
TEST(FurtherSetpointsTest, AnAdditionIsACommand) {
  FurtherSetpoints bench{{addition()}};
  bench.functionOfWord2(4);
  bench.run(120);
  bench.command(5.0);
  bench.step();
  EXPECT_EQ(0, bench.word(2)) << "not enabled";
  EXPECT_THAT(bench.ask(RequestKind::kEnable, CycleBench::kLift).message.c_str(),
              AllOf(HasSubstr("the newest setpoint boost of drive lift is not zero"), HasSubstr("send zero first")));
  bench.command(0.0);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.command(5.0);
  bench.run(2);
  EXPECT_EQ(0, bench.word(2)) << "no velocity command to add to";
  bench.commandLift(0.0);
  bench.command(5.0);
  bench.run(2);
  EXPECT_EQ(1638, bench.word(2)) << "5 Hz of 50 Hz";
  bench.command(-20.0);
  bench.run(2);
  EXPECT_EQ(-3277, bench.word(2)) << "its limit";
  for (int i = 0; i < 33; ++i) {
    bench.commandLift(0.0);
    bench.step();
  }
  EXPECT_EQ(0, bench.word(2)) << "grown old";
  bench.command(5.0);
  bench.run(2);
  EXPECT_EQ(1638, bench.word(2));
  Request stop;
  stop.kind = RequestKind::kQuickStop;
  bench.ports.submit(stop);
  bench.step();
  EXPECT_EQ(0, bench.word(2)) << "stopped";
}

// While it is brought down the ramp it is enabled still, and follows no command any more.
TEST(FurtherSetpointsTest, AnAdditionEndsWithTheWayDown) {
  FurtherSetpoints bench{{addition()}};
  bench.functionOfWord2(4);
  bench.run(120);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  for (int i = 0; i < 100; ++i) {
    bench.commandLift(50.0);
    bench.command(5.0);
    bench.step();
  }
  ASSERT_EQ(1638, bench.word(2));
  Request stop;
  stop.kind = RequestKind::kDisable;
  stop.drive = CycleBench::kLift;
  bench.ports.submit(stop);
  int on_the_ramp = 0;
  for (int i = 0; i < 300; ++i) {
    bench.commandLift(50.0);
    bench.command(5.0);
    bench.step();
    EXPECT_EQ(0, bench.word(2)) << i;
    on_the_ramp += bench.controlWord(CycleBench::kLift) == 0x047F ? 1 : 0;
  }
  EXPECT_GT(on_the_ramp, 0);
}

// The velocity command is too old: the base stops, and so does what was added to it.
TEST(FurtherSetpointsTest, AnAdditionEndsWithTheVelocityCommand) {
  FurtherSetpoints bench{{addition()}};
  bench.functionOfWord2(4);
  bench.run(120);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.commandLift(0.0);
  for (int i = 0; i < 60; ++i) {
    bench.command(5.0);
    bench.step();
  }
  EXPECT_EQ(0, bench.word(2));
}

// A wheel of a base that brakes because more than one node commands it does not turn alone by what is added.
TEST(FurtherSetpointsTest, AnAdditionToAWheelEndsWhereTheBaseObeysNobody) {
  CycleConfig config = CycleBench::config();
  config.drives[CycleBench::kLeft].words.setpoints = {addition()};
  CycleBench bench{config};
  for (const int number : {543, 546}) bench.transport.parameters[number] = 1;
  for (const int number : {544, 545, 548}) bench.transport.parameters[number] = 0;
  bench.transport.parameters[547] = 4;
  bench.run(120);
  const Completion enabled = bench.ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  const auto command = [&bench](bool held) {
    TwistCommand newest{{0.5, 0.0}, bench.transport.time, true};
    newest.held = held;
    bench.ports.commandBase(newest);
    bench.ports.commandSetpoint(CycleBench::kLeft, 0, 5.0, bench.transport.time);
    bench.run(2);
    return bench.transport.outputs[CycleBench::kLeft].setpoints[1];
  };
  EXPECT_EQ(1638, command(false));
  EXPECT_EQ(0, command(true));
  EXPECT_EQ(1638, command(false));
}

// A limit stays in its word while the drive is silent and stopped unheard, and while it is asked anew; what can turn
// the motor does not.
TEST(FurtherSetpointsTest, ALimitOutlivesALossAndAnAdditionDoesNot) {
  FurtherSetpoints bench{{torqueLimit(75.0)}};
  bench.run(120);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.commandLift(50.0);
  bench.run(20);
  bench.transport.inverters[CycleBench::kLift].silent = true;
  bench.run(20);
  EXPECT_EQ(0x047E, bench.controlWord(CycleBench::kLift));
  EXPECT_EQ(12288, bench.word(2));
  bench.transport.hold_answers = true;
  bench.transport.inverters[CycleBench::kLift].silent = false;
  bench.run(20);
  EXPECT_EQ(0x047E, bench.controlWord(CycleBench::kLift));
  EXPECT_EQ(12288, bench.word(2)) << "asked anew, not known yet";
}

TEST(FurtherSetpointsTest, ChangeNothingWhereNoneAreConfigured) {
  FurtherSetpoints bench{{}};
  bench.run(120);
  EXPECT_EQ((std::array<std::int16_t, 3>{0, 0, 0}), bench.transport.outputs[CycleBench::kLift].setpoints);
  EXPECT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success) << "whatever P547 is";
}

}  // namespace
}  // namespace nord_driver::cycle
