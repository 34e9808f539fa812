// A drive that positions takes its position into its array (P613), on every bus: the whole driver against the simulated
// POSICON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cycle/taught_position.h"
#include "system/lift.h"

namespace nord_driver::test {
namespace {

using cycle::RequestKind;
using ::testing::HasSubstr;

// Low and high word, and bus I/O in bits: it travels at P105.
constexpr LiftWords kSk53xBits{"SK 53xE", "sk5xxe", sim::Series::kSk5xxe, {21, 22, 17}, {1, 10, 15}, 32};
constexpr LiftWords kSk2xxBits{"SK 2xxE", "sk2xxe", sim::Series::kSk2xxe, {23, 24, 20}, {1, 10, 15}, 32};

/// Element 3: its number has two bits. P480 by element, from 0.
constexpr std::pair<unsigned, std::int32_t> kFunctions[] = {{0, 24}, {1, 25}, {4, 55}, {5, 56}, {10, 22}};

using SimParameters = std::vector<sim::ParameterPreset>;

template <typename Robot>
typename Robot::Options teachOptions(const std::function<void(SimParameters&)>& change = {}) {
  const LiftWords words = std::is_same_v<Robot, DevicenetRobot> ? kSk2xxBits : kSk53xBits;
  auto options = liftOptions<Robot>(words, 70.0);
  options.drives["position/home"] = std::string{"control_bit_8"};
  options.drives["position/teach_in"] = std::string{"bus_in_bit_0"};
  options.drives["position/quit_teach_in"] = std::string{"bus_in_bit_1"};
  options.drives["position/array_bit"] = std::string{"bus_in_bit_4"};
  options.drives["position/element"] = 3;
  options.simulate = [words, change](sim::SimConfig& config) {
    simulateLift(words, 70.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (auto& preset : drive.parameters) preset.raw = preset.number == 600 ? 1 : preset.raw;
      for (const auto& [element, function] : kFunctions) drive.parameters.push_back({480, 0, element, function});
      if (change) change(drive.parameters);
    }
  };
  return options;
}

template <typename Robot>
cycle::Completion teach(Robot& robot) {
  return robot.ask(RequestKind::kTeach, 0);
}

/// P613 of parameter set 1, as the simulated inverter has it.
template <typename Robot>
std::vector<std::int32_t> array(Robot& robot) {
  std::vector<std::int32_t> all;
  for (unsigned element = 0; element < 5; ++element) {
    all.push_back(robot.unit(0).parameters().value(613, 0, element));
  }
  return all;
}

template <typename Robot>
class TeachPosition : public ::testing::Test {};
TYPED_TEST_SUITE(TeachPosition, EveryLift, BusName);

TYPED_TEST(TeachPosition, IsInTheArrayAfterwards) {
  TypeParam robot{teachOptions<TypeParam>()};
  ASSERT_TRUE(robot.bringUp());
  cycle::PositionSetup setup;
  setup.teach = cycle::TeachSetup{{}, {}, cycle::PositionBit{}, 3};
  const cycle::Completion answer =
      cycle::withTaughtElement(teach(robot), setup, [&robot](const profile::ParameterRequest& element) {
        cycle::Request request;
        request.kind = RequestKind::kReadParameter;
        request.drive = 0;
        request.parameter = element;
        return robot.ask(request);
      });
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ("drive left was told to take its position, 0.7, into its array; P613[-03] is 70.000 revolutions",
            answer.message.str());
  EXPECT_EQ((std::vector<std::int32_t>{0, 0, 70'000, 0, 0}), array(robot));
  EXPECT_FALSE(robot.unit(0).inverter().posicon().teaching()) << "the bits are low";
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
  const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
  ASSERT_TRUE(goTo(robot, 0.25));
  EXPECT_THAT(teach(robot).message.str(), HasSubstr("disable it first"));
  EXPECT_EQ(70'000, array(robot)[2]);
  robot.run(std::chrono::milliseconds{500});  // it comes to rest, and OFF1 leaves it where it is
  ASSERT_TRUE(robot.ask(RequestKind::kDisable).success);
  EXPECT_TRUE(teach(robot).success);
  EXPECT_NEAR(25'000, array(robot)[2], 1);
  EXPECT_NEAR(robot.unit(0).inverter().posicon().position() * 1000.0, array(robot)[2], 1.0);
}

TYPED_TEST(TeachPosition, IsRefusedInWords) {
  TypeParam robot{teachOptions<TypeParam>()};
  ASSERT_TRUE(robot.bringUp());
  const auto expectRefused = [&](const char* why) {
    const cycle::Completion answer = teach(robot);
    EXPECT_FALSE(answer.success);
    EXPECT_THAT(answer.message.str(), HasSubstr(why));
    EXPECT_EQ(std::vector<std::int32_t>(5, 0), array(robot)) << why;
  };
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  cycle::Request home;
  home.kind = RequestKind::kHome;
  home.drive = 0;
  robot.ports().submit(home);
  robot.run(std::chrono::milliseconds{300});
  expectRefused("a reference run is under way");
  ASSERT_TRUE(robot.ask(RequestKind::kDisable).success);
  robot.unit(0).inverter().setLocalControl(true);
  robot.run(std::chrono::milliseconds{300});
  expectRefused("local control");
  robot.unit(0).inverter().setLocalControl(false);
  robot.unit(0).inverter().trip(30, false);
  robot.run(std::chrono::milliseconds{300});
  expectRefused("reports a fault");
  robot.unit(0).setPlugged(false);
  robot.run(std::chrono::seconds{2});
  expectRefused("does not answer");
}

TYPED_TEST(TeachPosition, IsRefusedWhereItsBitsAreSomethingElse) {
  const auto answer = [](const std::function<void(SimParameters&)>& change) {
    TypeParam robot{teachOptions<TypeParam>(change)};
    EXPECT_TRUE(robot.bringUp());
    const cycle::Completion told = teach(robot);
    EXPECT_FALSE(told.success);
    EXPECT_EQ(std::vector<std::int32_t>(5, 0), array(robot));
    EXPECT_FALSE(robot.unit(0).inverter().posicon().teaching());
    return told.message.str();
  };
  const auto with = [](unsigned element, std::int32_t function) {
    return [=](SimParameters& parameters) { parameters.push_back({480, 0, element, function}); };
  };
  EXPECT_THAT(answer(with(0, 1)), HasSubstr("P480[-01] is 1; set it to 24 (teach-in), or position/teach_in_function"));
  EXPECT_THAT(answer(with(1, 24)), HasSubstr("P480[-02] is 24; set it to 25 (quit teach-in)"));
  EXPECT_THAT(answer(with(5, 0)), HasSubstr("P480[-06] is 0; set it to 56 (bit 1 of the position array)"));
  EXPECT_THAT(answer([](SimParameters& parameters) {
                const bool is_array = std::is_same_v<TypeParam, DevicenetRobot>;
                parameters.push_back({static_cast<std::uint16_t>(is_array ? 546 : 548), 0, is_array ? 2u : 0u, 0});
              }),
              HasSubstr("no setpoint carries the bit of position/teach_in"));
}

TYPED_TEST(TeachPosition, IsRefusedWithoutItsKeys) {
  auto options = teachOptions<TypeParam>();
  options.drives.erase("position/teach_in");
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(teach(robot).message.str(), HasSubstr("position/teach_in is not configured"));
  EXPECT_EQ(std::vector<std::int32_t>(5, 0), array(robot));
}

// A stop in the middle is a stop, and the bits are low with it.
TYPED_TEST(TeachPosition, EndsWithAStop) {
  TypeParam robot{teachOptions<TypeParam>()};
  ASSERT_TRUE(robot.bringUp());
  cycle::Request request;
  request.kind = RequestKind::kTeach;
  request.drive = 0;
  request.id = 900;
  request.patience = std::chrono::seconds{3};
  robot.ports().submit(request);
  ASSERT_TRUE(robot.runUntil([&] { return robot.unit(0).inverter().posicon().teaching(); }));
  EXPECT_TRUE(robot.ask(RequestKind::kQuickStop).success);
  robot.run(std::chrono::milliseconds{300});
  EXPECT_FALSE(robot.unit(0).inverter().posicon().teaching());
  std::string told;
  for (const cycle::Completion& answer : robot.completions()) {
    if (answer.id == 900) told = answer.message.str();
  }
  EXPECT_THAT(told, HasSubstr("something else was asked of the drive"));
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
}

// The POSICON control bits of SK 700E: setpoint 2 with code 12, beside 32 bits (BU 0020 6.1.2, 7.3.5).
TEST(TeachPositionOfSk700e, GoesByThePosiconBits) {
  constexpr LiftWords kWords{"SK 700E", "sk700e", sim::Series::kSk700e, {3, 12, 0}, {6, 1, 0}, 32};
  auto options = liftOptions<SimulatedRobot>(kWords, 12.0);
  options.drives["position/teach_in"] = std::string{"posicon_bits"};
  options.drives["position/element"] = 37;
  options.simulate = [kWords](sim::SimConfig& config) {
    simulateLift(kWords, 12.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (auto& preset : drive.parameters) preset.raw = preset.number == 600 ? 1 : preset.raw;
    }
  };
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = teach(robot);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(12'000, robot.unit(0).parameters().value(613, 0, 36));
  EXPECT_FALSE(robot.unit(0).inverter().posicon().teaching());
}

}  // namespace
}  // namespace nord_driver::test
