#include "nord_driver/robot/diff_drive_kinematics.h"

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

DiffDriveKinematics::DiffDriveKinematics(const DiffDriveGeometry& geometry)
    : separation_(positive(geometry.wheel_separation, "wheel_separation") *
                  positive(geometry.wheel_separation_multiplier, "wheel_separation_multiplier")),
      left_radius_(positive(geometry.left_wheel_radius, "left_wheel_radius") *
                   positive(geometry.left_wheel_radius_multiplier, "left_wheel_radius_multiplier")),
      right_radius_(positive(geometry.right_wheel_radius, "right_wheel_radius") *
                    positive(geometry.right_wheel_radius_multiplier, "right_wheel_radius_multiplier")) {}

WheelSpeeds DiffDriveKinematics::wheels(const Twist2d& twist) const noexcept {
  const double turn = twist.angular_z * separation_ / 2.0;
  return {(twist.linear_x - turn) / left_radius_, (twist.linear_x + turn) / right_radius_};
}

Twist2d DiffDriveKinematics::twist(const WheelSpeeds& wheels) const noexcept {
  const double left = wheels.left * left_radius_;
  const double right = wheels.right * right_radius_;
  return {(left + right) / 2.0, (right - left) / separation_};
}

}  // namespace nord_driver::robot
