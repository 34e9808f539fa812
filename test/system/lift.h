// A lift on whichever bus: drive 0 goes to positions, drive 1 stands beside it. The real driver below ROS against the
// simulated POSICON.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/drive_unit.h"
#include "sim/inverter/inverter_model.h"
#include "sim/inverter/posicon.h"
#include "support/map_settings.h"
#include "system/every_robot.h"
#include "system/interbus_robot.h"

namespace nord_driver::test {

/// Positions go over every bus; over InterBus with Compact PCP, which tells what the words mean.
using EveryLift = ::testing::Types<SimulatedRobot, CanRobot, DevicenetRobot, InterbusRobot>;
struct LiftBusName {
  template <typename Robot>
  static std::string GetName(int index) {
    return std::is_same_v<Robot, InterbusRobot> ? "Interbus" : BusName::GetName<Robot>(index);
  }
};

/// The functions of the words, as P546 to P548 and P543 to P545 have them.
struct LiftWords {
  const char* name;
  const char* series;
  sim::Series simulated;
  std::array<std::int32_t, 3> setpoints;
  std::array<std::int32_t, 3> actual_values;
  int bits;
};

/// 0.2 m a turn, gear 20: 100 revolutions are a metre, 0.001 of one is 10 um.
constexpr double kRevolutionsPerMetre = 100.0;

inline std::map<std::string, MapSettings::Value> liftSettings(const LiftWords& words) {
  return {{"series", std::string{words.series}},
          {"mode", std::string{"position"}},
          {"lead", 0.2},
          {"inverted", false},
          {"position/bits", words.bits}};
}

inline std::vector<sim::ParameterPreset> liftParameters(const LiftWords& words, std::int32_t control = 2) {
  const bool is_array = words.simulated == sim::Series::kSk2xxe || words.simulated == sim::Series::kSk54xe;
  std::vector<sim::ParameterPreset> parameters;
  for (unsigned set = 0; set < 4; ++set) {
    for (unsigned place = 0; place < 3; ++place) {
      const auto number = [&](unsigned first) { return static_cast<std::uint16_t>(is_array ? first : first + place); };
      parameters.push_back({number(546), set, is_array ? place : 0, words.setpoints[place]});
      parameters.push_back({number(543), set, is_array ? place : 0, words.actual_values[place]});
    }
    parameters.push_back({600, set, 0, control});
    parameters.push_back({102, set, 0, 100});  // 1.0 s to 50 Hz
    parameters.push_back({103, set, 0, 100});
  }
  return parameters;
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

constexpr LiftWords kSk53x{"SK 53xE", "sk5xxe", sim::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 32};
constexpr LiftWords kSk2xx{"SK 2xxE", "sk2xxe", sim::Series::kSk2xxe, {1, 23, 24}, {1, 10, 15}, 32};
constexpr LiftWords kSk700{"SK 700E", "sk700e", sim::Series::kSk700e, {3, 1, 0}, {6, 1, 0}, 32};

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
