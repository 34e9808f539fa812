// The configuration of a base with two wheels, for tests of what it may say.
#pragma once

#include <string>

#include "cycle/base_config.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {

inline test::MapSettings wheelsOfABase(const std::string& left, const std::string& right) {
  test::MapSettings settings{"~"};
  settings.set("left_wheel", left).set("right_wheel", right);
  settings.set("wheel_separation", 0.5).set("wheel_radius", 0.1);
  return settings;
}

/// The sentence it is refused with; "accepted" when it is not.
inline std::string refusalOfABase(const Settings& settings, const JointNames& joints) {
  try {
    readBaseConfig(settings, joints);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace nord_driver::cycle
