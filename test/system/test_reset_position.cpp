// A drive that positions sets its count anew where it stands, on every bus: the whole driver against the simulated POSICON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "system/lift.h"

namespace nord_driver::test {
namespace {

using cycle::RequestKind;
using ::testing::HasSubstr;

// Low and high word, and bus I/O in bits: it travels at P105.
constexpr LiftWords kSk53xBits{"SK 53xE", "sk5xxe", sim::Series::kSk5xxe, {21, 22, 17}, {1, 10, 15}, 32};
constexpr LiftWords kSk2xxBits{"SK 2xxE", "sk2xxe", sim::Series::kSk2xxe, {23, 24, 20}, {1, 10, 15}, 32};

/// The lift stands at 0.7 m, and bus_in_bit_2 has `function` in P480.
template <typename Robot>
typename Robot::Options resetOptions(std::int32_t function) {
  const LiftWords words = std::is_same_v<Robot, DevicenetRobot> ? kSk2xxBits : kSk53xBits;
  auto options = liftOptions<Robot>(words, 70.0);
  options.drives["position/reset"] = std::string{"bus_in_bit_2"};
  options.simulate = [words, function](sim::SimConfig& config) {
    simulateLift(words, 70.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (auto& preset : drive.parameters) preset.raw = preset.number == 600 ? 1 : preset.raw;
      drive.parameters.push_back({480, 0, 2, function});
    }
  };
  return options;
}

template <typename Robot>
cycle::Completion reset(Robot& robot) {
  return robot.ask(RequestKind::kResetPosition, 0);
}

template <typename Robot>
double shaftTurns(Robot& robot) {
  return robot.unit(0).inverter().posicon().position();
}

template <typename Robot>
class ResetPosition : public ::testing::Test {};
TYPED_TEST_SUITE(ResetPosition, EveryLift, BusName);

TYPED_TEST(ResetPosition, IsZeroAfterwardsAndNothingMoves) {
  TypeParam robot{resetOptions<TypeParam>(61)};
  ASSERT_TRUE(robot.bringUp());
  ASSERT_NEAR(0.7, *robot.snapshot().drives[0].position, 1e-5);
  const cycle::Completion answer = reset(robot);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ("drive left: its count was set anew, its position is 0", answer.message.str());
  EXPECT_NEAR(0.0, shaftTurns(robot), 0.001);
  EXPECT_NEAR(0.0, *robot.snapshot().drives[0].position, 1e-5);
  EXPECT_FALSE(robot.snapshot().drives[0].stopped);
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
  const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
  ASSERT_TRUE(goTo(robot, 0.25));
  EXPECT_NEAR(25.0, shaftTurns(robot), 0.003);
  EXPECT_THAT(reset(robot).message.str(), HasSubstr("disable it first"));
  EXPECT_NEAR(25.0, shaftTurns(robot), 0.003);
  ASSERT_TRUE(robot.ask(RequestKind::kDisable).success);
  EXPECT_TRUE(reset(robot).success) << "a second edge";
  EXPECT_NEAR(0.0, shaftTurns(robot), 0.001);
}

TYPED_TEST(ResetPosition, IsRefusedWhereItsBitIsSomethingElse) {
  TypeParam robot{resetOptions<TypeParam>(1)};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(reset(robot).message.str(), HasSubstr("P480[-03] is 1; set it to 61 (reset position)"));
  EXPECT_NEAR(70.0, shaftTurns(robot), 0.001);
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
}

// The function that the configuration expects does something else in this drive: it answers, and keeps its count.
TYPED_TEST(ResetPosition, FailsInWordsWhereTheDriveKeepsItsCount) {
  auto options = resetOptions<TypeParam>(9);
  options.drives["position/reset_function"] = 9;
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = reset(robot);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("its position did not become position/reset_to in time"));
  EXPECT_NEAR(0.7, *robot.snapshot().drives[0].position, 1e-5);
  EXPECT_TRUE(robot.ask(RequestKind::kEnable).success);
}

// The POSICON control bits of SK 700E: bit 10 of setpoint 2 with code 12, beside 32 bits (BU 0020 6.1.2, 7.3.5).
TEST(ResetPositionOfSk700e, GoesByThePosiconBits) {
  constexpr LiftWords kWords{"SK 700E", "sk700e", sim::Series::kSk700e, {3, 12, 0}, {6, 1, 0}, 32};
  auto options = liftOptions<SimulatedRobot>(kWords, 12.0);
  options.drives["position/reset"] = std::string{"posicon_bits"};
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = reset(robot);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_NEAR(0.0, shaftTurns(robot), 0.001);
}

}  // namespace
}  // namespace nord_driver::test
