// The wheels of a layout as settings of a robot that knows a base of two: which joints, which way round, which body,
// and how it stops.
#pragma once

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

/// Of the node.
inline Values wheelSettings(const Layout& layout) {
  Values node = stopSettings(layout);
  if (layout.wheels != 4) return node;
  const auto joint = [](std::size_t i) { return nameOfDrive(i) + "_wheel_joint"; };
  node["left_wheel"] = std::vector<std::string>{joint(0), joint(2)};
  node["right_wheel"] = std::vector<std::string>{joint(1), joint(3)};
  return node;
}

/// Of each drive: a single drive turns as its motor does.
inline std::vector<Values> driveSettingsOf(const Layout& layout) {
  std::vector<Values> each;
  for (std::size_t i = 0; i < layout.drives(); ++i) each.push_back({{"inverted", i < layout.wheels && i % 2 == 1}});
  return each;
}

inline void simulateWheels(const Layout& layout, sim::SimConfig& config) {
  for (std::size_t i = 0; i < layout.drives(); ++i) config.drives[i].inverted = i < layout.wheels && i % 2 == 1;
  if (layout.wheels == 4) config.body = sim::BodyConfig{{0, 2}, {1, 3}, 0.1, 0.5};
}

}  // namespace nord_driver::test
