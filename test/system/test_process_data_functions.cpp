// P543 and P546: what actual value 1 and setpoint 1 are. Current in place of the frequency would be the odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

TEST(ProcessDataFunctions, AnActualValue1ThatIsNoFrequencyIsNotEnabled) {
  SimulatedRobot::Options options;
  options.left_parameters = {{543, 0, 0, 3}};
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left: P543 of parameter set 1 is 3"));
  EXPECT_THAT(answer.message.c_str(), HasSubstr("set it to 1"));
}

TEST(ProcessDataFunctions, ASetpoint1ThatIsNoFrequencyIsNotEnabled) {
  SimulatedRobot::Options options;
  options.left_parameters = {{546, 0, 0, 2}};
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left: P546 of parameter set 1 is 2"));
}

// Of a set that is not in force they are no danger yet; when it is chosen, they are.
TEST(ProcessDataFunctions, OfAnotherSetCountWhenItIsInForce) {
  SimulatedRobot::Options options;
  options.left_parameters = {{543, 2, 0, 3}};
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  cycle::Request request;
  request.kind = cycle::RequestKind::kSelectParameterSet;
  request.drive = 0;
  request.parameter_set = 3;
  ASSERT_TRUE(robot.ask(request).success);
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P543 of parameter set 3 is 3"));
}

// SK 1x0E and 2xxE have them as an array (BU 0220 5.1.3).
TEST(ProcessDataFunctions, OfAnArrayAreNamedWithTheirElement) {
  SimulatedRobot::Options options;
  options.one_module = true;
  options.left_parameters = {{543, 0, 0, 8}};
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(robot.ask(cycle::RequestKind::kEnable).message.c_str(),
              HasSubstr("drive left: P543 [-01] of parameter set 1 is 8"));
}

}  // namespace
}  // namespace nord_driver::test
