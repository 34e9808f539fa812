// Every target in range arrives, with every layout of the words, on every bus that carries it.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "system/lift.h"

namespace nord_driver::test {
namespace {

using cycle::RequestKind;
using Series = sim::Series;

constexpr LiftWords kSk700Short{"SK 700E, 16 bits", "sk700e", Series::kSk700e, {2, 1, 0}, {6, 1, 0}, 16};

constexpr LiftWords kLayouts[] = {
    kSk53x,
    {"SK 53xE, 23 and 24", "sk5xxe", Series::kSk5xxe, {1, 23, 24}, {1, 10, 15}, 32},
    {"SK 53xE, high before low", "sk5xxe", Series::kSk5xxe, {1, 22, 21}, {1, 15, 10}, 32},
    {"SK 53xE, in words 1 and 2", "sk5xxe", Series::kSk5xxe, {21, 22, 0}, {10, 15, 1}, 32},
    {"SK 53xE, in words 3 and 1", "sk5xxe", Series::kSk5xxe, {22, 1, 21}, {15, 1, 10}, 32},
    {"SK 54xE", "sk54xe", Series::kSk54xe, {1, 21, 22}, {1, 15, 10}, 32},
    kSk2xx,
    {"SK 2xxE, in words 3 and 1", "sk2xxe", Series::kSk2xxe, {24, 1, 23}, {15, 1, 10}, 32},
    kSk700,
    {"SK 750E without a speed", "sk750e", Series::kSk750e, {3, 0, 0}, {6, 0, 0}, 32},
    {"SK 700E, increments", "sk700e", Series::kSk700e, {6, 1, 0}, {10, 1, 0}, 32},
    {"SK 53xE, 16 bits", "sk5xxe", Series::kSk5xxe, {1, 21, 0}, {1, 10, 0}, 16},
    {"SK 2xxE, 16 bits", "sk2xxe", Series::kSk2xxe, {1, 23, 0}, {1, 10, 0}, 16},
    {"SK 700E, 16 bits, without a speed", "sk700e", Series::kSk700e, {2, 0, 0}, {6, 0, 0}, 16},
    kSk700Short,
};

/// By the units there are: PROFIBUS of these tests is SK TU3-PBR and the CANopen one SK TU3-CAO, which SK 2xxE do not
/// take; an InterBus one is made for SK 300E, 5xxE, 700E and 750E (BU 0070 2).
template <typename Robot>
bool carries(const LiftWords& words) {
  if (words.simulated == Series::kSk2xxe) return std::is_same_v<Robot, DevicenetRobot>;
  return words.simulated != Series::kSk54xe || !std::is_same_v<Robot, InterbusRobot>;
}

template <typename Robot>
typename Robot::Options optionsOf(const LiftWords& words) {
  auto options = liftOptions<Robot>(words, 3.0);
  const bool little_endian = std::is_same_v<Robot, CanRobot> || std::is_same_v<Robot, DevicenetRobot>;
  // Low bytes first, and so the low word (BU 0280 4.2.1.1).
  if (little_endian) options.drives["position/word_order"] = std::string{"low_first"};
  const bool with_speed = words.setpoints[0] == 1 || words.setpoints[1] == 1;
  options.simulate = [words, with_speed](sim::SimConfig& config) {
    simulateLift(words, 3.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (auto& preset : drive.parameters) preset.raw = preset.number == 600 && !with_speed ? 1 : preset.raw;
    }
  };
  return options;
}

template <typename Robot>
class PositionLayouts : public ::testing::Test {};
TYPED_TEST_SUITE(PositionLayouts, EveryLift, BusName);

TYPED_TEST(PositionLayouts, EveryTargetArrivesWithinAThousandthOfARevolution) {
  for (const LiftWords& words : kLayouts) {
    if (!carries<TypeParam>(words)) continue;
    for (const unsigned seed : {1u, 2u}) {
      SCOPED_TRACE(std::string(words.name) + ", seed " + std::to_string(seed));
      TypeParam robot{optionsOf<TypeParam>(words)};
      ASSERT_TRUE(robot.bringUp());
      const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
      ASSERT_TRUE(enabled.success) << enabled.message.c_str();
      ASSERT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
      std::mt19937 random{seed};
      const double most = words.bits == 16 ? 0.3276 : 2.0;  // m
      std::uniform_real_distribution<double> heights{-most, most};
      for (int i = 0; i < 3; ++i) {
        const double height = heights(random);
        ASSERT_TRUE(goTo(robot, height)) << height << ", at " << heightOf(robot);
        robot.run(std::chrono::milliseconds{500});
        EXPECT_NEAR(height * kRevolutionsPerMetre, robot.unit(0).inverter().posicon().position(), 0.0015);
        EXPECT_NEAR(heightOf(robot), robot.snapshot().drives[0].position.value_or(9.0), 1e-5);
      }
    }
  }
}

// Nobody says whether setpoint 2 of SK 700E comes before setpoint 3 on DeviceNet or after it (BU 0280 is about others, BU
// 0080 is not at hand): by the series, as on the other buses, or in order. Whichever it is can be driven.
TEST(PositionLayoutsOfDevicenet, WordsOfSk700eInOrder) {
  for (const LiftWords& words : {kSk700Short, kSk700}) {
    SCOPED_TRACE(words.name);
    auto options = optionsOf<DevicenetRobot>(words);
    options.drives["value_order"] = std::string{"in_order"};
    const auto simulate = options.simulate;
    options.simulate = [simulate](sim::SimConfig& config) {
      simulate(config);
      for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::DnDriveConfig>().values_in_order = true;
    };
    DevicenetRobot robot{options};
    ASSERT_TRUE(robot.bringUp());
    ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
    for (const double height : {0.3, -0.2}) {
      ASSERT_TRUE(goTo(robot, height)) << height << ", at " << heightOf(robot);
      EXPECT_NEAR(height * kRevolutionsPerMetre, robot.unit(0).inverter().posicon().position(), 0.0015);
    }
  }
}

// A driver that takes the other order sends the speed where the inverter takes nothing: it stands, and goes nowhere else.
TEST(PositionLayoutsOfDevicenet, TheWrongOrderOfSk700eMovesNothing) {
  auto options = optionsOf<DevicenetRobot>(kSk700Short);
  options.drives["value_order"] = std::string{"in_order"};
  DevicenetRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.ask(RequestKind::kEnable);
  EXPECT_FALSE(goTo(robot, 0.3, std::chrono::seconds{5}));
  EXPECT_NEAR(3.0, robot.unit(0).inverter().posicon().position(), 0.01);
}

// P607 and P608, which position/gear_ratio has to include: here three counted revolutions for two of the motor. Nobody says
// whether they have sets; of the simulated ones they have none, and all four were asked for.
TYPED_TEST(PositionLayouts, TheGearOfTheCountIsReadAndIncluded) {
  auto options = optionsOf<TypeParam>(kSk53x);
  options.drives["position/gear_ratio"] = 30.0;
  const auto simulate = options.simulate;
  options.simulate = [simulate](sim::SimConfig& config) {
    simulate(config);
    for (sim::DriveConfig& drive : config.drives) {
      drive.parameters.push_back({607, 0, 0, 3});
      drive.parameters.push_back({608, 0, 0, 2});
    }
  };
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  EXPECT_EQ(3, robot.snapshot().drives[0].device.speed_ratio[0]);
  EXPECT_EQ(2, robot.snapshot().drives[0].device.reduction[0]);
  const double before = robot.unit(0).shaftAngle();
  ASSERT_TRUE(goTo(robot, 0.3));
  EXPECT_NEAR(0.3 * 150.0, robot.unit(0).inverter().posicon().position(), 0.0015);
  EXPECT_NEAR(30.0 - 3.0, (robot.unit(0).shaftAngle() - before) / 6.283185307, 0.5) << "100 of the motor are a metre";
}

// The wrong one of the two orders is no position: the axis would jump by 65.536 revolutions, or not be heard at all.
TYPED_TEST(PositionLayouts, TheOrderOfTheHalvesIsHeeded) {
  auto options = optionsOf<TypeParam>(kSk700);
  const bool low_first = options.drives.count("position/word_order") != 0;
  options.drives["position/word_order"] = std::string{low_first ? "high_first" : "low_first"};
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_GT(std::abs(robot.snapshot().drives[0].position.value_or(1e3) - heightOf(robot)), 0.6);
}

}  // namespace
}  // namespace nord_driver::test
