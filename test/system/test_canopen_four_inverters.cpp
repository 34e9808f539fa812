// Four wheels of decentralised inverters behind one gateway SK CU4/TU4-CAO: what test_four_inverters.cpp says of
// PROFIBUS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/can_robot.h"
#include "system/four_inverters.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Kind {
  const char* series;
  sim::Series simulated;
};

CanRobot::Options fourWheels(const Kind& kind) {
  const auto joints = [](const char* front, const char* rear) { return std::vector<std::string>{front, rear}; };
  CanRobot::Options options;
  options.gateway_inverters = 4;
  options.node = {{"left_wheel", joints("left_wheel_joint", "extra2_wheel_joint")},
                  {"right_wheel", joints("right_wheel_joint", "extra3_wheel_joint")}};
  options.drives = {{"series", std::string{kind.series}}};
  options.each = {{}, {}, {}, {{"inverted", true}}};
  options.simulate = [kind](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.device.series = kind.simulated;
    config.drives[kRearRight].inverted = true;
    config.body = sim::BodyConfig{{kLeft, kRearLeft}, {kRight, kRearRight}, 0.1, 0.5};
  };
  return options;
}

class FourInvertersOnCan : public ::testing::TestWithParam<Kind> {
 protected:
  void SetUp() override { ASSERT_TRUE(robot_.bringUp()); }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.bus().referee().report()); }

  cycle::Completion read(DriveIndex drive, std::uint16_t number,
                         profile::ParameterShape shape = profile::ParameterShape::kPlain) {
    return parameter(robot_, cycle::RequestKind::kReadParameter, drive, number, 0, shape);
  }
  void enableAndDrive() {
    ASSERT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
    robot_.drive(kHalfSpeed, 0.0, seconds{3});
    for (const DriveIndex drive : {kLeft, kRearLeft}) ASSERT_EQ(0x2000, robot_.setpoint(drive));
    for (const DriveIndex drive : {kRight, kRearRight}) ASSERT_EQ(-0x2000, robot_.setpoint(drive));
  }
  bool allStand() {
    for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) {
      if (std::abs(robot_.unit(drive).shaftSpeed()) >= 0.1) return false;
    }
    return true;
  }
  bool comesToRest() {
    return robot_.runUntil([this] { return allStand(); }, seconds{8});
  }

  CanRobot robot_{fourWheels(GetParam())};
};

// One node, a PDO each way for each inverter and cycle, and the base drives as with four nodes.
TEST_P(FourInvertersOnCan, DriveTheBase) {
  enableAndDrive();
  std::vector<std::uint32_t> sent;
  robot_.bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender sender, Instant) {
    if (sender == sim::SimulatedCanBus::Sender::kMaster && frame.id > 0x200 && frame.id < 0x580)
      sent.push_back(frame.id);
  });
  robot_.command(kHalfSpeed);
  robot_.step();
  EXPECT_EQ(4u, sent.size());
  for (const DriveIndex drive : {kLeft, kRearLeft}) EXPECT_NEAR(25.0, robot_.unit(drive).inverter().frequency(), 0.1);
  for (const DriveIndex drive : {kRight, kRearRight}) {
    EXPECT_NEAR(-25.0, robot_.unit(drive).inverter().frequency(), 0.1);
  }
  EXPECT_GT(robot_.snapshot().base.pose.x, 0.5);
  EXPECT_NEAR(kHalfSpeed, robot_.snapshot().base.velocity.linear_x, 0.01);
}

// OFF1 by `disable`, OFF3 by the stop, and a command that is not renewed: all four come to rest.
TEST_P(FourInvertersOnCan, ComeToRestTogether) {
  enableAndDrive();
  EXPECT_TRUE(comesToRest()) << "the last command is too old";
  robot_.drive(kHalfSpeed, 0.0, seconds{2});
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kDisable).success);
  EXPECT_TRUE(comesToRest());
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) EXPECT_EQ(0x047E, robot_.controlWord(drive));
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kEnable).success);
  robot_.drive(kHalfSpeed, 0.0, seconds{2});
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kQuickStop).success);
  EXPECT_TRUE(comesToRest());
}

// P151 is the module's, P120 the inverter's; who stops the motors is known from the start.
TEST_P(FourInvertersOnCan, TellWhatWatchesTheBus) {
  expectMonitoringKnown(robot_);
  for (const auto& drive : robot_.snapshot().drives) EXPECT_EQ(50.0, drive.device.max_frequency[0].value_or(0.0));
  const DriveIdentity identity = robot_.transport().identity(kRearLeft);
  EXPECT_EQ(TimeoutOwner::kModule, identity.timeout_owner);
  EXPECT_EQ("CANopen node 10, inverter 3", identity.address);
  EXPECT_EQ(3, identity.process_values);
  EXPECT_THAT(identity.protected_by, AllOf(HasSubstr("0.3 s"), HasSubstr("E10 and the motor coasts")));
}

TEST_P(FourInvertersOnCan, ShareTheParametersOfTheirModule) {
  expectSharedTimeout(robot_, *robot_.node(kLeft).module());
}

// What is an array here is none in SK 5xxE (P420 .. P423, P543 .. P545): by number and element, each inverter its own.
TEST_P(FourInvertersOnCan, HaveParametersOfTheirOwn) {
  using Shape = profile::ParameterShape;
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) {
    const auto value = static_cast<std::int32_t>(300 + 10 * drive);
    const auto written = parameter(robot_, cycle::RequestKind::kWriteParameter, drive, 103, value, Shape::kPerSet);
    EXPECT_TRUE(written.success) << written.message.c_str();
  }
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) {
    EXPECT_EQ(static_cast<std::int32_t>(300 + 10 * drive), robot_.unit(drive).parameters().value(103, 0));
    EXPECT_EQ(static_cast<std::int32_t>(300 + 10 * drive), read(drive, 103, Shape::kPerSet).parameter.raw);
  }
  robot_.unit(kRearLeft).parameters().preset(420, 0, 1, 10);
  cycle::Request request;
  request.kind = cycle::RequestKind::kReadParameter;
  request.drive = kRearLeft;
  request.parameter.number = 420;
  request.parameter.shape = Shape::kArray;
  request.parameter.index = 2;
  request.parameter.action = profile::ParameterAction::kRead;
  const cycle::Completion answer = robot_.ask(request);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(10, answer.parameter.raw);
  EXPECT_THAT(read(kRearLeft, 508).message.c_str(), HasSubstr("SDO abort 0602 0000h"))
      << "the PROFIBUS address is the module's, not the inverter's";
}

TEST_P(FourInvertersOnCan, HaveParameterSetsOfTheirOwn) {
  expectSetsOfTheirOwn(robot_);
}

// The emergency names the inverter in its byte 3 (BU 0260 p. 78), P700 of that inverter the number; the base stops, and
// is enabled again when it is acknowledged.
TEST_P(FourInvertersOnCan, AFaultOfOneStopsTheBase) {
  enableAndDrive();
  robot_.unit(kRearLeft).inverter().trip(30, true);
  robot_.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_FALSE(robot_.snapshot().base.enabled);
  EXPECT_EQ(30, robot_.snapshot().drives[kRearLeft].fault_number);
  for (const DriveIndex other : {kLeft, kRight, kRearRight}) {
    EXPECT_EQ(0, robot_.snapshot().drives[other].fault_number) << other;
  }
  EXPECT_EQ("drive extra2 reports EMCY 2310h (E3.0, overcurrent at the output (I2t limit))", robot_.busText());
  EXPECT_TRUE(comesToRest());
  robot_.run(milliseconds{600});
  EXPECT_THAT(robot_.ask(cycle::RequestKind::kEnable).message.c_str(), HasSubstr("drive extra2"));
  robot_.unit(kRearLeft).inverter().clearCause();
  EXPECT_TRUE(robot_.ask(cycle::RequestKind::kAcknowledge, kRearLeft).success);
  EXPECT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
}

// Nobody asks the module any more: E10 in all four. It stays in its time-out until all are acknowledged.
TEST_P(FourInvertersOnCan, AreAcknowledgedTogetherAfterATimeout) {
  robot_.run(seconds{1});  // disabled: the end of an enable would acknowledge by itself
  robot_.bus().run(milliseconds{800});
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) {
    EXPECT_EQ(102, robot_.unit(drive).inverter().faultNumber()) << drive;
  }
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{3}));
  robot_.run(seconds{1});
  EXPECT_EQ(0u, robot_.bus().referee().total());
  expectAcknowledgedTogether(robot_, *robot_.node(kLeft).module());
}

TEST_P(FourInvertersOnCan, AllOffAreNoTimeoutOfTheirModule) {
  expectAllOffAreNoTimeout(robot_, *robot_.node(kLeft).module());
}

// The module is gone: four drives at once, and all of them back, at rest.
TEST_P(FourInvertersOnCan, AreLostAndFoundTogether) {
  enableAndDrive();
  robot_.node(kLeft).setMute(true);
  robot_.run(milliseconds{600});
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) EXPECT_FALSE(robot_.online(drive));
  robot_.node(kLeft).setMute(false);
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{2}));
  EXPECT_TRUE(comesToRest());
  EXPECT_FALSE(robot_.snapshot().base.enabled);
  EXPECT_TRUE(robot_.snapshot().base.stopped);
}

TEST_P(FourInvertersOnCan, ACleanEndLeavesNoFault) {
  enableAndDrive();
  robot_.run(milliseconds{600});
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kShutDown).success);
  robot_.transport().close();
  robot_.bus().run(seconds{3});
  for (const DriveIndex drive : {kLeft, kRight, kRearLeft, kRearRight}) {
    EXPECT_EQ(0, robot_.unit(drive).inverter().faultNumber()) << drive;
  }
  EXPECT_FALSE(robot_.node(kLeft).module()->timedOut());
}

INSTANTIATE_TEST_SUITE_P(Series, FourInvertersOnCan,
                         ::testing::Values(Kind{"sk2xxe", sim::Series::kSk2xxe}, Kind{"sk1x0e", sim::Series::kSk1x0e}),
                         [](const auto& kind) { return std::string{kind.param.series}; });

}  // namespace
}  // namespace nord_driver::test
