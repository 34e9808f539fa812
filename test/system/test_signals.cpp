// Signals and further setpoints over PROFIBUS: SK 2xxE behind one SK CU4-PBR, PPO 2, its own byte in slot 1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/signals_of_a_drive.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

SimulatedRobot::Options withSignals(bool may_move = false) {
  SimulatedRobot::Options options;
  options.one_module = true;
  options.drives = signalSettings(may_move);
  options.drives["ppo_type"] = 2;
  options.parameters = signalParameters();
  return options;
}

TEST(ProfibusSignals, ALampFollowsItsTopicAndGoesOffByTimeOut) {
  SimulatedRobot robot{withSignals()};
  expectALampThatFollows(robot);
}

TEST(ProfibusSignals, ABitThatMayMoveStaysLow) {
  for (const unsigned seed : {1u, 2u}) {
    SimulatedRobot robot{withSignals()};
    expectNoBitThatMayMove(robot, seed);
  }
}

// What the refusal is for: accepted, "enable right" turns the motor past ~enable.
TEST(ProfibusSignals, AnAcceptedBitMoves) {
  SimulatedRobot robot{withSignals(true)};
  ASSERT_TRUE(robot.bringUp());
  sim::Terminals terminals;
  terminals.frequency = 20.0;
  robot.unit(0).inverter().setTerminals(terminals);
  EXPECT_TRUE(robot.runUntil(
      [&] {
        commandOutput(robot, 0, true);
        return robot.unit(0).shaftSpeed() > 10.0;
      },
      std::chrono::seconds{5}));
  EXPECT_TRUE(robot.runUntil([&] { return robot.unit(0).inverter().busInBits() == 0; }, std::chrono::seconds{1}))
      << "without a new command it goes low";
}

TEST(ProfibusSignals, InputsAreSeen) {
  SimulatedRobot robot{withSignals()};
  expectInputs(robot);
}

TEST(ProfibusSignals, ATorqueLimitGoesToItsWord) {
  SimulatedRobot robot{withSignals()};
  expectATorqueLimit(robot);
}

}  // namespace
}  // namespace nord_driver::test
