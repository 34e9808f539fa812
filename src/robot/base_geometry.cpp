#include "robot/base_geometry.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace nord_driver::robot {
namespace {

double positive(double value, const char* field) {
  if (std::isfinite(value) && value > 0.0) return value;
  throw std::invalid_argument(std::string(field) + " is " + std::to_string(value) +
                              ", expected a finite number greater than 0");
}

}  // namespace

double separationOf(const BaseGeometry& geometry) {
  return positive(geometry.wheel_separation, "wheel_separation") *
         positive(geometry.wheel_separation_multiplier, "wheel_separation_multiplier");
}

double leftRadiusOf(const BaseGeometry& geometry) {
  return positive(geometry.left_wheel_radius, "left_wheel_radius") *
         positive(geometry.left_wheel_radius_multiplier, "left_wheel_radius_multiplier");
}

double rightRadiusOf(const BaseGeometry& geometry) {
  return positive(geometry.right_wheel_radius, "right_wheel_radius") *
         positive(geometry.right_wheel_radius_multiplier, "right_wheel_radius_multiplier");
}

double mecanumLeverOf(const BaseGeometry& geometry) {
  return (positive(geometry.wheel_separation, "wheel_separation") + positive(geometry.wheel_base, "wheel_base")) / 2.0 *
         positive(geometry.wheel_separation_multiplier, "wheel_separation_multiplier");
}

}  // namespace nord_driver::robot
