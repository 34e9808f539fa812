// A drive that positions, the whole driver against the simulated POSICON, on every bus: every layout of the words, and what
// becomes of a target when something stops it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "system/lift.h"

namespace nord_driver::test {
namespace {

using cycle::RequestKind;
using ::testing::HasSubstr;

template <typename Robot>
struct BusWords;
template <>
struct BusWords<SimulatedRobot> {
  static constexpr LiftWords kWords = kSk53x;
};
template <>
struct BusWords<CanRobot> {
  static constexpr LiftWords kWords = kSk53x;
};
template <>
struct BusWords<InterbusRobot> {
  static constexpr LiftWords kWords = kSk53x;
};
template <>
struct BusWords<DevicenetRobot> {
  static constexpr LiftWords kWords = kSk2xx;
};

template <typename Robot>
class Positions : public ::testing::Test {
 protected:
  static typename Robot::Options options(double position = 0.0) {
    return liftOptions<Robot>(BusWords<Robot>::kWords, position);
  }
};
TYPED_TEST_SUITE(Positions, EveryLift, BusName);

/// Without a step, so that each can be looked at.
template <typename Robot>
void submit(Robot& robot, RequestKind kind) {
  cycle::Request request;
  request.kind = kind;
  request.drive = 0;
  robot.ports().submit(request);
}

// The thin slice of the matter: a command in, words out, the position back.
TYPED_TEST(Positions, ALiftGoesToThreeHeights) {
  TypeParam robot{TestFixture::options(70.0)};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_NEAR(0.7, robot.snapshot().drives[0].position.value_or(0.0), 1e-5) << "also before it is enabled";
  const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  EXPECT_TRUE(staysWhereItIs(robot)) << "enabling moves nothing";
  for (const double height : {1.0, 0.25, -0.5}) {
    ASSERT_TRUE(goTo(robot, height)) << height << ", at " << heightOf(robot);
    EXPECT_NEAR(height, heightOf(robot), 1.01e-5) << "0.001 revolutions";
    EXPECT_NEAR(height, robot.snapshot().drives[0].position.value_or(9.0), 1.01e-5);
    EXPECT_EQ(robot.snapshot().drives[0].position, robot.snapshot().drives[0].joint_position);
  }
}

// What stops an axis on its way; after each nothing moves until somebody enables it, and then it is held where it is.
TYPED_TEST(Positions, WhatStopsAnAxisLeavesNoTargetBehind) {
  struct Cause {
    const char* name;
    std::function<void(TypeParam&)> begin;
    std::function<void(TypeParam&)> end;
  };
  const std::vector<Cause> causes{
      {"enable false", [](TypeParam& robot) { submit(robot, RequestKind::kDisable); }, [](TypeParam&) {}},
      {"quick stop", [](TypeParam& robot) { submit(robot, RequestKind::kQuickStop); }, [](TypeParam&) {}},
      {"fault", [](TypeParam& robot) { robot.unit(0).inverter().trip(30, false); },
       [](TypeParam& robot) { robot.ask(RequestKind::kAcknowledge, 0); }},
      {"local control", [](TypeParam& robot) { robot.unit(0).inverter().setLocalControl(true); },
       [](TypeParam& robot) { robot.unit(0).inverter().setLocalControl(false); }},
      {"coasting at terminals",
       [](TypeParam& robot) {
         sim::Terminals terminals;
         terminals.coast = true;
         robot.unit(0).inverter().setTerminals(terminals);
       },
       [](TypeParam& robot) { robot.unit(0).inverter().setTerminals({}); }},
      {"mains off and on", [](TypeParam& robot) { robot.unit(0).setInverterPower(false); },
       [](TypeParam& robot) { robot.unit(0).setInverterPower(true); }},
      {"silence", [](TypeParam& robot) { robot.unit(0).setPlugged(false); },
       [](TypeParam& robot) { robot.unit(0).setPlugged(true); }},
  };
  for (const Cause& cause : causes) {
    SCOPED_TRACE(cause.name);
    TypeParam robot{TestFixture::options(10.0)};
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.ports().commandPosition(0, 3.0);
    robot.run(std::chrono::seconds{3});
    ASSERT_GT(robot.unit(0).shaftSpeed(), 10.0) << "half-way";
    double before = robot.snapshot().drives[0].joint_position;
    cause.begin(robot);
    bool jumped = false;
    const auto smooth = [&] {
      const double now = robot.snapshot().drives[0].joint_position;
      jumped = jumped || std::abs(now - before) > 0.1;  // 10 revolutions
      before = now;
    };
    ASSERT_TRUE(robot.runUntil(
        [&] {
          smooth();
          return !robot.snapshot().drives[0].enabled && standsStill(robot);
        },
        std::chrono::seconds{20}));
    robot.run(std::chrono::milliseconds{500});
    cause.end(robot);
    robot.run(std::chrono::seconds{1});
    EXPECT_LT(heightOf(robot), 2.9) << "stopped on its way";
    EXPECT_TRUE(staysWhereItIs(robot)) << "nothing moves unasked";
    EXPECT_FALSE(jumped);
    if (robot.snapshot().drives[0].fault_latched) robot.ask(RequestKind::kAcknowledge, 0);
    const cycle::Completion again = robot.ask(RequestKind::kEnable);
    ASSERT_TRUE(again.success) << again.message.c_str();
    EXPECT_TRUE(staysWhereItIs(robot)) << "the target from before the stop is forgotten";
    EXPECT_TRUE(goTo(robot, 0.2)) << "a new one is followed";
  }
}

// All drives or none: one that refuses takes the other back, in the cycle in which that one was enabled. Where its fault
// is heard only after both have been, they are drives of their own.
TYPED_TEST(Positions, WhoIsNotEnabledHasNoTargetAndReachesNone) {
  TypeParam robot{TestFixture::options(10.0)};
  ASSERT_TRUE(robot.bringUp());
  cycle::Request request;
  request.kind = RequestKind::kEnable;
  request.patience = std::chrono::seconds{3};
  robot.ports().submit(request);
  bool tripped = false;
  for (int i = 0; i < 400; ++i) {
    const bool enabled = robot.unit(0).inverter().state() == sim::InverterState::kOperationEnabled;
    if (enabled && !tripped) robot.unit(1).inverter().trip(30, true);
    tripped = tripped || enabled;
    robot.step();
    const cycle::DriveSnapshot& drive = robot.snapshot().drives[0];
    if (drive.enabled) continue;
    EXPECT_FALSE(drive.position_reached) << "cycle " << i;
    EXPECT_FALSE(drive.position_target) << "cycle " << i;
  }
  EXPECT_TRUE(tripped);
}

// The new one finds it moving, and knows no target: it brings it to rest, and tells its position without a jump.
TYPED_TEST(Positions, ANewDriverOverAMovingAxisForgetsItsTarget) {
  TypeParam robot{TestFixture::options(10.0)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.ports().commandPosition(0, 3.0);
  robot.run(std::chrono::seconds{3});
  ASSERT_GT(robot.unit(0).shaftSpeed(), 10.0);
  robot.restartDriver();
  for (int i = 0; i < 1000; ++i) {
    robot.step();
    const cycle::DriveSnapshot& drive = robot.snapshot().drives[0];
    if (!drive.joint_known) continue;
    ASSERT_NEAR(heightOf(robot), drive.joint_position, 0.02) << "after " << i << " cycles";
  }
  EXPECT_TRUE(robot.snapshot().drives[0].joint_known);
  EXPECT_TRUE(standsStill(robot));
  EXPECT_LT(heightOf(robot), 2.9);
  ASSERT_TRUE(robot.bringUpAndEnable());
  EXPECT_TRUE(staysWhereItIs(robot));
  EXPECT_TRUE(goTo(robot, 0.2));
}

// --- reference run ---------------------------------------------------------------------------------------------------

/// Bit 8 of the control word asks for it (P480 [-11]), bit 10 of the status word says that the reference is known (P481
/// [-09]). The encoder counts from 0 at mains on, and the switch is 20 revolutions below.
template <typename Robot>
typename Robot::Options homingOptions(const LiftWords& words, std::int32_t function = 22) {
  auto options = liftOptions<Robot>(words);
  options.drives["position/home"] = std::string{"control_bit_8"};
  options.drives["position/referenced"] = std::string{"status_bit_10"};
  options.drives["position/homing_timeout"] = 20.0;
  options.simulate = [words, function](sim::SimConfig& config) {
    simulateLift(words, 0.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      drive.inverter.posicon.encoder = sim::EncoderKind::kIncremental;
      drive.inverter.posicon.reference_switch = -20.0;
      drive.inverter.posicon.reference_speed = -20.0;
      drive.parameters.push_back({480, 0, 10, function});
      drive.parameters.push_back({481, 0, 8, 20});
    }
  };
  return options;
}

template <typename Robot>
cycle::Completion home(Robot& robot) {
  cycle::Request request;
  request.kind = RequestKind::kHome;
  request.drive = 0;
  return robot.ask(request);
}

TYPED_TEST(Positions, ALiftHomes) {
  TypeParam robot{homingOptions<TypeParam>(BusWords<TypeParam>::kWords)};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_FALSE(robot.snapshot().drives[0].homed);
  EXPECT_THAT(home(robot).message.str(), HasSubstr("not enabled"));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  ASSERT_TRUE(goTo(robot, 0.1));
  submit(robot, RequestKind::kHome);
  robot.run(std::chrono::milliseconds{500});
  robot.ports().commandPosition(0, 0.5);
  robot.run(std::chrono::milliseconds{100});
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("a reference run is under way"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.snapshot().drives[0].homed; }));
  robot.run(std::chrono::seconds{2});
  EXPECT_TRUE(robot.snapshot().drives[0].enabled) << robot.snapshot().drives[0].text.c_str();
  EXPECT_NEAR(0.0, robot.snapshot().drives[0].position.value_or(9.0), 1e-4);
  EXPECT_NEAR(-20.0, robot.unit(0).shaftAngle() / (2.0 * 3.14159265358979), 0.5) << "at the switch";
  EXPECT_TRUE(staysWhereItIs(robot));
  EXPECT_TRUE(goTo(robot, 0.05));
}

TYPED_TEST(Positions, AReferenceRunIsAskedForAgainAndAnswered) {
  TypeParam robot{homingOptions<TypeParam>(BusWords<TypeParam>::kWords)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  cycle::Request request;
  request.kind = RequestKind::kHome;
  request.drive = 0;
  request.id = 900;
  request.patience = std::chrono::seconds{30};
  robot.ports().submit(request);
  const auto answered = [&] {
    for (const cycle::Completion& answer : robot.completions()) {
      if (answer.id == 900) return std::optional<cycle::Completion>{answer};
    }
    return std::optional<cycle::Completion>{};
  };
  ASSERT_TRUE(robot.runUntil([&] { return answered().has_value(); }, std::chrono::seconds{30}));
  EXPECT_TRUE(answered()->success) << answered()->message.c_str();
  EXPECT_TRUE(robot.snapshot().drives[0].homed);
}

// The bit of the status word would tell something else, and the run never end by it.
TYPED_TEST(Positions, AReferenceRunIsRefusedWhereNobodyTellsItsEnd) {
  auto options = homingOptions<TypeParam>(BusWords<TypeParam>::kWords);
  const auto simulate = options.simulate;
  options.simulate = [simulate](sim::SimConfig& config) {
    simulate(config);
    for (sim::DriveConfig& drive : config.drives) drive.parameters.push_back({481, 0, 8, 9});
  };
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  const cycle::Completion answer = home(robot);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("P481[-09] is 9; set it to 20 (reference known), or "
                                              "position/referenced_function"));
  EXPECT_FALSE(robot.snapshot().drives[0].homed);
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
}

// The switch never comes.
TYPED_TEST(Positions, AReferenceRunThatDoesNotEndIsStopped) {
  auto options = homingOptions<TypeParam>(BusWords<TypeParam>::kWords);
  options.drives["position/homing_timeout"] = 2.0;
  const auto simulate = options.simulate;
  options.simulate = [simulate](sim::SimConfig& config) {
    simulate(config);
    for (sim::DriveConfig& drive : config.drives) drive.inverter.posicon.reference_switch.reset();
  };
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  const cycle::Completion answer = home(robot);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("the reference run did not end within position/homing_timeout"));
  robot.run(std::chrono::seconds{2});
  EXPECT_TRUE(standsStill(robot));
  EXPECT_FALSE(robot.snapshot().drives[0].enabled);
  EXPECT_FALSE(robot.snapshot().drives[0].homed);
  EXPECT_TRUE(staysWhereItIs(robot));
}

TYPED_TEST(Positions, AReferenceRunEndsWithAStop) {
  TypeParam robot{homingOptions<TypeParam>(BusWords<TypeParam>::kWords)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  submit(robot, RequestKind::kHome);
  robot.run(std::chrono::milliseconds{700});
  ASSERT_LT(robot.unit(0).shaftSpeed(), -5.0);
  ASSERT_TRUE(robot.ask(RequestKind::kDisable).success);
  ASSERT_TRUE(robot.runUntil([&] { return standsStill(robot); }));
  EXPECT_TRUE(staysWhereItIs(robot));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  EXPECT_TRUE(staysWhereItIs(robot)) << "nor does it go on with it";
}

// Trap 35: a bit whose function is another one would do something else.
TYPED_TEST(Positions, ABitWithAnotherFunctionIsNotTakenForHoming) {
  TypeParam robot{homingOptions<TypeParam>(BusWords<TypeParam>::kWords, 1)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  const cycle::Completion answer = home(robot);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("P480[-11] is 1; set it to 22 (reference run)"));
  EXPECT_TRUE(staysWhereItIs(robot));
}

TYPED_TEST(Positions, TargetsThatCannotBeAreRefusedInWords) {
  auto options = TestFixture::options(0.0);
  options.drives["position/lower"] = -0.5;
  options.drives["position/upper"] = 2.0;
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUp());
  const auto told = [&] {
    std::string all;
    while (const auto event = robot.ports().pollBusEvent()) all += event->text.str() + "\n";
    return all;
  };
  told();
  robot.ports().commandPosition(0, 1.0);
  robot.run(std::chrono::milliseconds{50});
  EXPECT_THAT(told(), HasSubstr("the target 1 is not taken: the drive is not enabled"));
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  EXPECT_TRUE(staysWhereItIs(robot)) << "not kept for later";
  robot.ports().commandPosition(0, 2.001);
  robot.run(std::chrono::milliseconds{50});
  EXPECT_THAT(told(), HasSubstr("the target 2.001 is not taken: it is above the joint's upper limit"));
  EXPECT_THAT(robot.snapshot().drives[0].position_refused.str(), HasSubstr("upper limit"));
  EXPECT_FALSE(robot.ports().commandPosition(0, std::nan("")));
  EXPECT_TRUE(staysWhereItIs(robot, std::chrono::seconds{1}));
  EXPECT_TRUE(goTo(robot, 1.999));
  EXPECT_TRUE(robot.snapshot().drives[0].position_refused.empty());
}

// P600 = 0: it would follow setpoint 1 as a frequency.
TYPED_TEST(Positions, ADriveThatDoesNotPositionIsNotEnabled) {
  auto options = TestFixture::options(0.0);
  const LiftWords words = BusWords<TypeParam>::kWords;
  options.simulate = [words](sim::SimConfig& config) {
    simulateLift(words, 0.0, config);
    for (sim::DriveConfig& drive : config.drives) {
      for (auto& preset : drive.parameters) preset.raw = preset.number == 600 ? 0 : preset.raw;
    }
  };
  TypeParam robot{options};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion enabled = robot.ask(RequestKind::kEnable);
  EXPECT_FALSE(enabled.success);
  EXPECT_THAT(enabled.message.str(), HasSubstr("set P600 to what its manual"));
}

// A gateway that splits the words: high ones are a telegram older.
TYPED_TEST(Positions, TornWordsMakeNoJump) {
  TypeParam robot{TestFixture::options(0.0)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.unit(0).inverter().setTornWords(true);
  robot.ports().commandPosition(0, 2.0);  // over three borders of the low word
  double before = heightOf(robot);
  for (int i = 0; i < 4000; ++i) {
    robot.step();
    const double now = robot.snapshot().drives[0].joint_position;
    ASSERT_LT(std::abs(now - before), 0.05) << "after " << i << " cycles, at " << heightOf(robot);
    before = now;
  }
  EXPECT_NEAR(2.0, heightOf(robot), 1e-4);
}

}  // namespace
}  // namespace nord_driver::test
