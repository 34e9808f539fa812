// Four wheels behind one bus module: what has to hold for them on either bus.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "system/driven_robot.h"

namespace nord_driver::test {

inline constexpr DriveIndex kLeft = 0, kRight = 1, kRearLeft = 2, kRearRight = 3;

inline cycle::Completion parameter(DrivenRobot& robot, cycle::RequestKind kind, DriveIndex drive, std::uint16_t number,
                                   std::int32_t raw = 0,
                                   profile::ParameterShape shape = profile::ParameterShape::kPlain) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.parameter.number = number;
  request.parameter.shape = shape;
  request.parameter.raw = raw;
  request.parameter.action = kind == cycle::RequestKind::kReadParameter ? profile::ParameterAction::kRead
                                                                        : profile::ParameterAction::kWritePersistent;
  return robot.ask(request);
}

inline bool allOnline(DrivenRobot& robot) {
  for (const cycle::DriveSnapshot& drive : robot.snapshot().drives) {
    if (!drive.online) return false;
  }
  return true;
}

/// What watches the bus: P151 is the module's, P120 the inverter's; both known from the start.
inline void expectMonitoringKnown(DrivenRobot& robot) {
  for (const cycle::DriveSnapshot& drive : robot.snapshot().drives) {
    EXPECT_EQ(0.0, drive.device.module_timeout.value_or(-9.0)) << "the factory setting";
    EXPECT_EQ(1, drive.device.option_monitoring.value_or(-9));
  }
}

/// P151 is asked for through any drive; it is one and the same.
template <typename Module>
void expectSharedTimeout(DrivenRobot& robot, Module& module) {
  cycle::Completion answer = parameter(robot, cycle::RequestKind::kWriteParameter, kRight, 151, 500);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  answer = parameter(robot, cycle::RequestKind::kReadParameter, kRearLeft, 151);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(500, answer.parameter.raw);
  EXPECT_EQ(500, module.parameters().value(151));
}

/// Parameter sets are each inverter's own.
template <typename Robot>
void expectSetsOfTheirOwn(Robot& robot) {
  cycle::Request request;
  request.kind = cycle::RequestKind::kSelectParameterSet;
  request.drive = kRearRight;
  request.parameter_set = 3;
  EXPECT_STREQ("parameter set 3 is active", robot.ask(request).message.c_str());
  EXPECT_EQ(0x847E, robot.controlWord(kRearRight));
  EXPECT_EQ(2u, robot.unit(kRearRight).inverter().parameterSet());
  EXPECT_EQ(0u, robot.unit(kRearLeft).inverter().parameterSet());
  EXPECT_EQ(0x047E, robot.controlWord(kRearLeft));
}

/// The mains of all four go, the module lives on its 24 V: the idle word goes on, and P151 does not run out.
template <typename Robot, typename Module>
void expectAllOffAreNoTimeout(Robot& robot, Module& module) {
  module.parameters().preset(151, 0, 0, 100);
  for (DriveIndex i = 0; i < 4; ++i) robot.unit(i).setInverterPower(false);
  for (int i = 0; i < 300; ++i) {
    robot.step();
    ASSERT_FALSE(module.timedOut()) << i;
  }
  for (DriveIndex drive = 0; drive < 4; ++drive) {
    EXPECT_FALSE(robot.online(drive));
    EXPECT_EQ(0x047E, robot.controlWord(drive)) << drive;
  }
  for (DriveIndex i = 0; i < 4; ++i) robot.unit(i).setInverterPower(true);
  ASSERT_TRUE(robot.runUntil([&robot] { return allOnline(robot); }, std::chrono::seconds{5}));
  robot.run(std::chrono::seconds{1});
  EXPECT_STREQ("enabled", robot.ask(cycle::RequestKind::kEnable).message.c_str());
}

/// The module stays in its time-out until all its inverters are acknowledged (BU 0220 4.2.3.2): the answer says who is
/// missing, and acknowledging all of them ends it.
template <typename Module>
void expectAcknowledgedTogether(DrivenRobot& robot, Module& module) {
  EXPECT_TRUE(module.timedOut());
  const cycle::Completion one = robot.ask(cycle::RequestKind::kAcknowledge, kLeft);
  EXPECT_TRUE(one.success);
  EXPECT_THAT(one.message.c_str(), ::testing::HasSubstr("drive right behind the same bus module has a fault too"));
  const cycle::Completion all = robot.ask(cycle::RequestKind::kAcknowledge);
  EXPECT_TRUE(all.success) << all.message.c_str();
  EXPECT_THAT(all.message.c_str(), ::testing::Not(::testing::HasSubstr("behind the same")));
  EXPECT_FALSE(module.timedOut());
  EXPECT_STREQ("enabled", robot.ask(cycle::RequestKind::kEnable).message.c_str());
}

}  // namespace nord_driver::test
