#include "robot/diff_drive_kinematics.h"

#include <stdexcept>
#include <string>

namespace nord_driver::robot {

DiffDriveKinematics::DiffDriveKinematics(const BaseGeometry& geometry, std::size_t left_wheels,
                                         std::size_t right_wheels)
    : separation_(separationOf(geometry)),
      left_radius_(leftRadiusOf(geometry)),
      right_radius_(rightRadiusOf(geometry)),
      left_wheels_(left_wheels),
      right_wheels_(right_wheels) {
  if (left_wheels >= 1 && right_wheels >= 1 && left_wheels <= kMaxWheels && right_wheels <= kMaxWheels - left_wheels) {
    return;
  }
  throw std::invalid_argument("the base has " + std::to_string(left_wheels) + " wheels in left_wheel and " +
                              std::to_string(right_wheels) + " in right_wheel, expected at least one in each and " +
                              std::to_string(kMaxWheels) + " in all at most");
}

WheelSpeeds DiffDriveKinematics::wheels(const Twist2d& twist) const noexcept {
  const double turn = twist.angular_z * separation_ / 2.0;
  WheelSpeeds wheels;
  for (std::size_t i = 0; i < left_wheels_; ++i) wheels.push_back((twist.linear_x - turn) / left_radius_);
  for (std::size_t i = 0; i < right_wheels_; ++i) wheels.push_back((twist.linear_x + turn) / right_radius_);
  return wheels;
}

Twist2d DiffDriveKinematics::twist(const WheelSpeeds& wheels) const noexcept {
  if (wheels.size() != wheelCount()) return {};
  double left = 0.0;
  double right = 0.0;
  for (std::size_t i = 0; i < wheels.size(); ++i) (i < left_wheels_ ? left : right) += wheels[i];
  left *= left_radius_ / static_cast<double>(left_wheels_);
  right *= right_radius_ / static_cast<double>(right_wheels_);
  return {(left + right) / 2.0, (right - left) / separation_};
}

bool DiffDriveKinematics::setGeometry(const BaseGeometry& geometry) noexcept {
  try {
    *this = DiffDriveKinematics(geometry, left_wheels_, right_wheels_);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace nord_driver::robot
