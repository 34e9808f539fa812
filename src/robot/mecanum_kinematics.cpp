#include "robot/mecanum_kinematics.h"

#include <stdexcept>

namespace nord_driver::robot {

MecanumKinematics::MecanumKinematics(const BaseGeometry& geometry)
    : lever_(mecanumLeverOf(geometry)), left_radius_(leftRadiusOf(geometry)), right_radius_(rightRadiusOf(geometry)) {}

// A roller lets its wheel slide along one diagonal, so the wheel rolls off what the motion at its contact point has in
// the other two: forward, plus or minus sideways.
WheelSpeeds MecanumKinematics::wheels(const Twist2d& twist) const noexcept {
  const double x = twist.linear_x;
  const double y = twist.linear_y;
  const double turn = twist.angular_z * lever_;
  return {(x - y - turn) / left_radius_, (x + y - turn) / left_radius_, (x + y + turn) / right_radius_,
          (x - y + turn) / right_radius_};
}

Twist2d MecanumKinematics::twist(const WheelSpeeds& wheels) const noexcept {
  if (wheels.size() != wheelCount()) return {};
  const double front_left = wheels[0] * left_radius_;
  const double rear_left = wheels[1] * left_radius_;
  const double front_right = wheels[2] * right_radius_;
  const double rear_right = wheels[3] * right_radius_;
  return {(front_left + rear_left + front_right + rear_right) / 4.0,
          (-front_left - rear_left + front_right + rear_right) / (4.0 * lever_),
          (-front_left + rear_left + front_right - rear_right) / 4.0};
}

bool MecanumKinematics::setGeometry(const BaseGeometry& geometry) noexcept {
  try {
    *this = MecanumKinematics(geometry);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace nord_driver::robot
