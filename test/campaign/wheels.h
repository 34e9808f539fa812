// The wheels of a layout as settings of a robot that knows a base of two: which joints, which way round, which body.
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

inline Values wheelSettings(const Layout& layout) {
  if (layout.wheels != 4) return {};
  const auto joint = [](std::size_t i) { return nameOfDrive(i) + "_wheel_joint"; };
  return {{"left_wheel", std::vector<std::string>{joint(0), joint(2)}},
          {"right_wheel", std::vector<std::string>{joint(1), joint(3)}}};
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
