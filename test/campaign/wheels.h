// The wheels of a layout as settings of a robot that knows a base of two: which joints, which way round, which body,
// how often it cycles, how fast it changes its speed and how it stops.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "campaign/scenario.h"
#include "sim/sim_config.h"
#include "support/map_settings.h"

namespace nord_driver::test {

using Values = std::map<std::string, MapSettings::Value>;

/// Even drives left, odd ones right; as the robots name them.
inline std::string nameOfDrive(std::size_t i) {
  return i == 0 ? "left" : i == 1 ? "right" : "extra" + std::to_string(i);
}

/// doc/safety.md, "The way of each stop".
inline Values stopSettings(const Layout& layout) {
  struct Ways {
    const char *command_timeout, *disable, *drive_stopped;
  };
  static constexpr Ways kWays[] = {{"setpoint_zero", "off1", "setpoint_zero"},
                                   {"off1", "quick_stop", "coast"},
                                   {"quick_stop", "coast", "off1"},
                                   {"coast", "off1", "quick_stop"}};
  const Ways& ways = kWays[layout.ways()];
  return {{"stop/command_timeout", std::string{ways.command_timeout}},
          {"stop/disable", std::string{ways.disable}},
          {"stop/drive_stopped", std::string{ways.drive_stopped}}};
}

/// Where acceleration is limited: m/s^2 and rad/s^2 of a base, rad/s^2 of the joint of a single drive. Together the ones
/// of a base turn a wheel up faster than the 25 Hz/s of an inverter, each by itself more slowly.
constexpr double kLinearLimit = 0.3, kAngularLimit = 0.8, kJointLimit = 2.0;
/// Where jerk is limited: m/s^3, rad/s^3, rad/s^3. From rest it takes that long to the limit of acceleration.
constexpr double kTimeToLimit = 0.3;  // s
constexpr double kLinearJerk = kLinearLimit / kTimeToLimit, kAngularJerk = kAngularLimit / kTimeToLimit,
                 kJointJerk = kJointLimit / kTimeToLimit;
constexpr std::int32_t kSlowest = 30;  ///< P104, 0.1 Hz

/// Of the node, whatever its wheels are.
inline Values nodeSettings(const Layout& layout) {
  Values node = stopSettings(layout);
  if (layout.pace() != 0) node["cycle_rate"] = layout.cycleRate();
  if (!layout.limitsAcceleration() || layout.wheels == 0) return node;
  node["linear/x/has_acceleration_limits"] = node["angular/z/has_acceleration_limits"] = true;
  node["linear/x/max_acceleration"] = kLinearLimit;
  node["angular/z/max_acceleration"] = kAngularLimit;
  if (!layout.limitsJerk()) return node;
  node["linear/x/has_jerk_limits"] = node["angular/z/has_jerk_limits"] = true;
  node["linear/x/max_jerk"] = kLinearJerk;
  node["angular/z/max_jerk"] = kAngularJerk;
  return node;
}

/// Of a drive that is told speeds.
inline Values wheelSettings(const Layout& layout) {
  if (!layout.hasSlowest()) return {};
  return {{"allow_minimum_frequency", true}};
}

/// Of one of them that belongs to no base.
inline Values singleSettings(const Layout& layout) {
  Values single = wheelSettings(layout);
  if (layout.limitsAcceleration()) single["max_acceleration"] = kJointLimit;
  if (layout.limitsJerk()) single["max_jerk"] = kJointJerk;
  return single;
}

/// Of the node, with four wheels as well.
inline Values baseSettings(const Layout& layout) {
  Values node = nodeSettings(layout);
  if (layout.wheels != 4) return node;
  const auto joint = [](std::size_t i) { return nameOfDrive(i) + "_wheel_joint"; };
  node["left_wheel"] = std::vector<std::string>{joint(0), joint(2)};
  node["right_wheel"] = std::vector<std::string>{joint(1), joint(3)};
  return node;
}

/// Of each drive: a single drive turns as its motor does.
inline std::vector<Values> driveSettingsOf(const Layout& layout) {
  std::vector<Values> each;
  for (std::size_t i = 0; i < layout.drives(); ++i) {
    each.push_back(i < layout.wheels        ? wheelSettings(layout)
                   : i < layout.firstAxis() ? singleSettings(layout)
                                            : Values{});
    each.back()["inverted"] = i < layout.wheels && i % 2 == 1;
  }
  return each;
}

inline void simulateWheels(const Layout& layout, sim::SimConfig& config) {
  for (std::size_t i = 0; i < layout.drives(); ++i) config.drives[i].inverted = i < layout.wheels && i % 2 == 1;
  if (layout.wheels == 4) config.body = sim::BodyConfig{{0, 2}, {1, 3}, 0.1, 0.5};
}

}  // namespace nord_driver::test
