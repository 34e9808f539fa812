#include "robot/speed_limits.h"

#include <cmath>
#include <sstream>

namespace nord_driver::robot {
namespace {

std::string sentence(const std::string& key, double value, const char* expected) {
  std::ostringstream text;
  text << key << " is " << value << ", expected " << expected;
  return text.str();
}

/// Both bounds of acceleration or jerk: with zero on one side the base could never start, or never stop.
std::string problemOfPair(double max, double min, const std::string& key_of_max, const std::string& key_of_min) {
  if (!std::isfinite(max) || max <= 0.0) return sentence(key_of_max, max, "a finite number greater than 0");
  if (!std::isfinite(min) || min >= 0.0) return sentence(key_of_min, min, "a finite number less than 0");
  return {};
}

}  // namespace

std::string problemOf(const SpeedLimits& limits, const std::string& axis) {
  if (limits.has_velocity_limits) {
    const double max = limits.max_velocity;
    const double min = limits.minVelocity();
    if (!std::isfinite(max) || max < 0.0) {
      return sentence(axis + "/max_velocity", max, "a finite number not less than 0");
    }
    if (!std::isfinite(min) || min > 0.0) {
      return sentence(axis + "/min_velocity", min, "a finite number not greater than 0");
    }
    if (max == 0.0 && min == 0.0) {
      return sentence(axis + "/max_velocity", max, "a number greater than 0 while has_velocity_limits is true");
    }
  }
  if (limits.has_acceleration_limits) {
    std::string problem = problemOfPair(limits.max_acceleration, limits.minAcceleration(), axis + "/max_acceleration",
                                        axis + "/min_acceleration");
    if (!problem.empty()) return problem;
  }
  if (limits.has_jerk_limits) {
    return problemOfPair(limits.max_jerk, limits.minJerk(), axis + "/max_jerk", axis + "/min_jerk");
  }
  return {};
}

}  // namespace nord_driver::robot
