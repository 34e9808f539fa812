// Elements of the position array (P613) and increments as targets, on every bus: the whole driver against the simulated
// POSICON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "system/lift.h"

namespace nord_driver::test {
namespace {

using cycle::RequestKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Frequency and bus I/O in bits; no word carries a target.
constexpr LiftWords kSk53xBits{"SK 53xE", "sk5xxe", sim::Series::kSk5xxe, {1, 17, 0}, {1, 10, 15}, 32};
constexpr LiftWords kSk2xxBits{"SK 2xxE", "sk2xxe", sim::Series::kSk2xxe, {1, 20, 0}, {1, 10, 15}, 32};
/// P613 [-01] to [-15], 0.001 revolutions: 0.3 m, 1.2 m, beyond the upper limit, below the lower one.
constexpr std::int32_t kArray[] = {30'000, 120'000, 251'000, -51'000};

using Simulate = std::function<void(sim::SimConfig&)>;

template <typename Robot>
constexpr LiftWords bitsOf() {
  return std::is_same_v<Robot, DevicenetRobot> ? kSk2xxBits : kSk53xBits;
}
template <typename Robot>
constexpr LiftWords wordsOf() {
  return std::is_same_v<Robot, DevicenetRobot> ? kSk2xx : kSk53x;
}

template <typename Robot>
typename Robot::Options liftWithArray(const LiftWords& words, const Simulate& change = {}) {
  auto options = liftOptions<Robot>(words, 70.0);
  options.drives["position/lower"] = -0.5;
  options.drives["position/upper"] = 2.5;
  options.simulate = [words, change](sim::SimConfig& config) {
    simulateLift(words, 70.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (unsigned bit = 0; bit < 4; ++bit) {
        drive.parameters.push_back({480, 0, 4 + bit, static_cast<std::int32_t>(55 + bit)});
      }
      for (unsigned set = 0; set < 4; ++set) {
        for (unsigned element = 0; element < 4; ++element) {
          drive.parameters.push_back({613, set, element, kArray[element]});
        }
      }
    }
    if (change) change(config);
  };
  return options;
}

/// By bits 4 to 7 of the bus I/O in bits.
template <typename Robot>
typename Robot::Options byBits(const Simulate& change = {}) {
  auto options = liftWithArray<Robot>(bitsOf<Robot>(), change);
  options.drives["position/targets"] = std::string{"array"};
  options.drives["position/array_bit"] = std::string{"bus_in_bit_4"};
  options.drives["position/setpoint_mode"] = 0;
  return options;
}

template <typename Robot>
bool goToElement(Robot& robot, std::uint8_t element, Duration limit = seconds{60}) {
  robot.ports().commandElement(0, element);
  robot.run(milliseconds{300});
  return robot.runUntil([&] { return robot.snapshot().drives[0].position_reached; }, limit);
}

template <typename Robot>
std::string refusalOf(Robot& robot, std::uint8_t element) {
  robot.ports().commandElement(0, element);
  robot.run(milliseconds{500});
  return robot.snapshot().drives[0].position_refused.str();
}

template <typename Robot>
class ElementTargets : public ::testing::Test {};
TYPED_TEST_SUITE(ElementTargets, EveryLift, BusName);

TYPED_TEST(ElementTargets, AreChosenByTheirBits) {
  TypeParam robot{byBits<TypeParam>()};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  EXPECT_TRUE(staysWhereItIs(robot)) << "enabling moves nothing";
  ASSERT_TRUE(goToElement(robot, 2)) << robot.snapshot().drives[0].position_refused.c_str();
  EXPECT_NEAR(1.2, heightOf(robot), 1.01e-5);
  EXPECT_EQ(1.2, robot.snapshot().drives[0].position_target);
  robot.ports().commandElement(0, 1);
  robot.run(seconds{1});
  ASSERT_GT(std::abs(robot.unit(0).shaftSpeed()), 10.0);
  ASSERT_TRUE(goToElement(robot, 2)) << "turned round on its way: " << robot.snapshot().drives[0].text.c_str();
  EXPECT_NEAR(1.2, heightOf(robot), 1.01e-5);
  ASSERT_TRUE(goToElement(robot, 1));
  EXPECT_NEAR(0.3, heightOf(robot), 1.01e-5);
  EXPECT_TRUE(staysWhereItIs(robot));
}

TYPED_TEST(ElementTargets, AreTargetsInWordsOtherwise) {
  TypeParam robot{liftWithArray<TypeParam>(wordsOf<TypeParam>())};
  ASSERT_TRUE(robot.bringUpAndEnable());
  ASSERT_TRUE(goToElement(robot, 1)) << robot.snapshot().drives[0].position_refused.c_str();
  EXPECT_NEAR(0.3, heightOf(robot), 1.01e-5);
  robot.unit(0).parameters().write(613, 0, 0, 40'000, sim::Storage::kRam);
  ASSERT_TRUE(goToElement(robot, 1)) << "read anew";
  EXPECT_NEAR(0.4, heightOf(robot), 1.01e-5);
  EXPECT_THAT(refusalOf(robot, 3), HasSubstr("P613[-03], 251.000 revolutions or 2.51 of the joint, is not taken: it "
                                             "is above the joint's upper limit"));
  EXPECT_TRUE(staysWhereItIs(robot));
}

// Nothing moves, and the sentence names parameter and value.
TYPED_TEST(ElementTargets, AreRefusedInWords) {
  TypeParam robot{byBits<TypeParam>()};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(refusalOf(robot, 1), HasSubstr("the drive is not enabled"));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  EXPECT_TRUE(staysWhereItIs(robot)) << "not kept for later";
  EXPECT_THAT(refusalOf(robot, 3), HasSubstr("P613[-03], 251.000 revolutions or 2.51 of the joint, is not taken: it "
                                             "is above the joint's upper limit"));
  EXPECT_THAT(refusalOf(robot, 4), HasSubstr("P613[-04], -51.000 revolutions or -0.51 of the joint, is not taken: it "
                                             "is below the joint's lower limit"));
  EXPECT_THAT(refusalOf(robot, 0), HasSubstr("of its array elements 1 to 15 are used (position/elements)"));
  EXPECT_THAT(refusalOf(robot, 16), HasSubstr("elements 1 to 15"));
  robot.ports().commandPosition(0, 1.0);
  robot.run(milliseconds{100});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("elements of its array only"));
  robot.ports().commandIncrement(0, 0.1);
  robot.run(milliseconds{100});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("elements of its array only"));
  EXPECT_TRUE(staysWhereItIs(robot));
  EXPECT_TRUE(goToElement(robot, 1));
}

TYPED_TEST(ElementTargets, AreRefusedWhereTheirBitsAreSomethingElse) {
  const auto wrong = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.parameters.push_back({480, 0, 5, 1});
  };
  TypeParam robot{byBits<TypeParam>(wrong)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  EXPECT_THAT(refusalOf(robot, 2), HasSubstr("P480[-06] is 1; set it to 56 (bit 1 of the position array)"));
  EXPECT_TRUE(staysWhereItIs(robot));
  EXPECT_TRUE(goToElement(robot, 1)) << "that bit is as it should be";
}

// What stops the axis takes the element away; after the next enable it is held.
TYPED_TEST(ElementTargets, AreForgottenWithEveryStop) {
  for (const RequestKind stop : {RequestKind::kDisable, RequestKind::kQuickStop}) {
    TypeParam robot{byBits<TypeParam>()};
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.ports().commandElement(0, 2);
    robot.run(seconds{1});
    ASSERT_GT(std::abs(robot.unit(0).shaftSpeed()), 10.0);
    ASSERT_TRUE(robot.ask(stop).success);
    ASSERT_TRUE(robot.runUntil([&] { return standsStill(robot); }, seconds{20}));
    robot.run(seconds{1});
    EXPECT_LT(heightOf(robot), 1.1);
    ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
    EXPECT_TRUE(staysWhereItIs(robot));
    EXPECT_TRUE(goToElement(robot, 2));
  }
}

// Chosen, and stopped before the drive has told where it is; enabled at once again.
TYPED_TEST(ElementTargets, AreForgottenWhileTheyAreRead) {
  TypeParam robot{byBits<TypeParam>()};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.ports().commandElement(0, 2);
  cycle::Request stop;
  stop.kind = RequestKind::kDisable;
  stop.drive = 0;
  robot.step();
  robot.ports().submit(stop);
  robot.run(milliseconds{200});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("was stopped before P613[-02] was read"));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  EXPECT_TRUE(staysWhereItIs(robot));
}

// An inverter that takes bits 0 for an element, or counts them from 0: BU 0510, which says it, is not at hand.
TYPED_TEST(ElementTargets, AnInverterThatCountsOtherwiseIsStopped) {
  const auto from_zero = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.inverter.posicon.array_from_zero = true;
  };
  TypeParam robot{byBits<TypeParam>(from_zero)};
  ASSERT_TRUE(robot.bringUp());
  robot.ask(RequestKind::kEnable);
  ASSERT_TRUE(robot.runUntil([&] { return !robot.snapshot().drives[0].enabled && standsStill(robot); }, seconds{5}));
  EXPECT_NEAR(0.7, heightOf(robot), 0.02) << "two revolutions";
  EXPECT_THAT(robot.snapshot().drives[0].text.str(), HasSubstr("left the way to the element"));
  EXPECT_TRUE(staysWhereItIs(robot));
}

// --- increments ---

TYPED_TEST(ElementTargets, IncrementsGoOnFromTheTarget) {
  TypeParam robot{liftWithArray<TypeParam>(wordsOf<TypeParam>())};
  ASSERT_TRUE(robot.bringUp());
  robot.ports().commandIncrement(0, 0.5);
  robot.run(milliseconds{50});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("increment 0.5 is not taken: the drive is"));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  EXPECT_TRUE(staysWhereItIs(robot)) << "not kept for later";
  robot.ports().commandIncrement(0, 0.25);
  robot.ports().commandIncrement(0, 0.25);
  robot.run(seconds{1});
  robot.ports().commandIncrement(0, -0.1);
  robot.run(milliseconds{50});
  ASSERT_TRUE(robot.runUntil([&] { return robot.snapshot().drives[0].position_reached; }, seconds{30}));
  EXPECT_NEAR(1.1, heightOf(robot), 1.01e-5);
  robot.ports().commandIncrement(0, 1.5);
  robot.run(milliseconds{50});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(),
              HasSubstr("the increment 1.5, to 2.6, is not taken: it is above the joint's upper limit"));
  EXPECT_TRUE(staysWhereItIs(robot));
  robot.ports().commandPosition(0, 2.0);
  robot.run(seconds{1});
  ASSERT_TRUE(robot.ask(RequestKind::kDisable).success);
  ASSERT_TRUE(robot.runUntil([&] { return standsStill(robot); }, seconds{20}));
  robot.run(seconds{1});
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  const double held = heightOf(robot);
  robot.ports().commandIncrement(0, 0.1);
  robot.run(milliseconds{50});
  ASSERT_TRUE(robot.runUntil([&] { return robot.snapshot().drives[0].position_reached; }, seconds{30}));
  EXPECT_NEAR(held + 0.1, heightOf(robot), 3e-5) << "from where it was held, not from the target before";
}

// --- the POSICON control bits of SK 700E -----------------------------------------------------------------------------

// In setpoint 1 (P546 = 4) with a position of 16 bits; in setpoint 2 (P547 = 12) beside 32 bits, which carry the same
// target.
TEST(ElementTargetsOfSk700e, GoByThePosiconBits) {
  const LiftWords layouts[] = {
      {"P546 = 4", "sk700e", sim::Series::kSk700e, {4, 1, 0}, {6, 1, 0}, 16},
      {"P547 = 12", "sk700e", sim::Series::kSk700e, {3, 12, 0}, {6, 1, 0}, 32},
  };
  for (const LiftWords& words : layouts) {
    SCOPED_TRACE(words.name);
    auto options = liftOptions<SimulatedRobot>(words, 12.0);
    options.drives["position/targets"] = std::string{"array"};
    options.drives["position/array_bit"] = std::string{"posicon_bits"};
    options.drives["position/setpoint_mode"] = 0;
    options.simulate = [words](sim::SimConfig& config) {
      simulateLift(words, 12.0, config);
      for (sim::DriveConfig& drive : config.drives) {
        for (auto& preset : drive.parameters) preset.raw = preset.number == 600 ? 1 : preset.raw;
        drive.parameters.push_back({613, 0, 36, 20'000});
        drive.parameters.push_back({613, 0, 62, -5'000});
      }
    };
    SimulatedRobot robot{options};
    ASSERT_TRUE(robot.bringUp());
    const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
    ASSERT_TRUE(enabled.success) << enabled.message.c_str();
    EXPECT_TRUE(staysWhereItIs(robot));
    ASSERT_TRUE(goToElement(robot, 37)) << robot.snapshot().drives[0].position_refused.c_str();
    EXPECT_NEAR(0.2, heightOf(robot), 1.01e-5);
    ASSERT_TRUE(goToElement(robot, 63));
    EXPECT_NEAR(-0.05, heightOf(robot), 1.01e-5);
  }
}

}  // namespace
}  // namespace nord_driver::test
