// A lift on whichever bus: drive 0 goes to positions, drive 1 stands beside it. The real driver below ROS against the
// simulated POSICON.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "sim/drive_unit.h"
#include "sim/inverter/inverter_model.h"
#include "sim/inverter/posicon.h"
#include "support/map_settings.h"
#include "system/every_robot.h"
#include "system/lift_words.h"

namespace nord_driver::test {

/// Positions go over every bus; over InterBus with Compact PCP, which tells what the words mean.
using EveryLift = EveryBusRobot;

/// 0.2 m a turn, gear 20: 100 revolutions are a metre, 0.001 of one is 10 um.
constexpr double kRevolutionsPerMetre = 100.0;

inline std::map<std::string, MapSettings::Value> liftSettings(const LiftWords& words) {
  return {{"series", std::string{words.series}},
          {"mode", std::string{"position"}},
          {"lead", 0.2},
          {"inverted", false},
          {"position/bits", words.bits}};
}

inline void simulateLift(const LiftWords& words, double position, sim::SimConfig& config) {
  config.body.reset();
  for (sim::DriveConfig& drive : config.drives) {
    drive.device.series = words.simulated;
    drive.inverted = false;
    drive.inverter.posicon.position = position;
    const auto parameters = liftParameters(words);
    drive.parameters.insert(drive.parameters.end(), parameters.begin(), parameters.end());
  }
}

/// The lift of a bus, whose encoder shows `position` revolutions at first.
template <typename Robot>
typename Robot::Options liftOptions(const LiftWords& words, double position = 0.0) {
  typename Robot::Options options;
  options.base = false;
  options.drives = liftSettings(words);
  options.simulate = [words, position](sim::SimConfig& config) { simulateLift(words, position, config); };
  if constexpr (std::is_same_v<Robot, SimulatedRobot>) {
    options.drives["ppo_type"] = 2;
    options.ppo_type = 2;
  } else if constexpr (std::is_same_v<Robot, DevicenetRobot>) {
    options.assembly = 101;
    options.on_inverter = words.simulated != sim::Series::kSk2xxe;
  } else if constexpr (std::is_same_v<Robot, InterbusRobot>) {
    options.ppo_type = 2;
    options.pcp = true;
  } else {
    options.drives["process_values"] = 3;
  }
  return options;
}

template <typename Robot>
double heightOf(Robot& robot) {
  return robot.unit(0).inverter().posicon().position() / kRevolutionsPerMetre;
}

/// Sends the target once, and runs until the drive is there.
template <typename Robot>
bool goTo(Robot& robot, double height, Duration limit = std::chrono::seconds{120}) {
  robot.ports().commandPosition(0, height);
  robot.run(std::chrono::milliseconds{30});
  return robot.runUntil([&] { return robot.snapshot().drives[0].position_reached; }, limit);
}

template <typename Robot>
bool standsStill(Robot& robot) {
  return std::abs(robot.unit(0).shaftSpeed()) < 0.01;
}

/// Nothing turns for `span`.
template <typename Robot>
bool staysWhereItIs(Robot& robot, Duration span = std::chrono::seconds{2}) {
  const double before = robot.unit(0).inverter().posicon().position();
  bool still = true;
  const Instant end = robot.transport().now() + span;
  while (robot.transport().now() < end) {
    robot.step();
    still = still && std::abs(robot.unit(0).inverter().posicon().position() - before) < 0.002;
  }
  return still;
}

}  // namespace nord_driver::test
