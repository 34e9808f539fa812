#include "nord_driver/sim/diff_drive_body.h"

#include <cmath>

namespace nord_driver::sim {

void DiffDriveBody::moveTo(double left_angle, double right_angle) noexcept {
  if (started_) {
    const double left = (left_angle - left_) * wheel_radius_;
    const double right = (right_angle - right_) * wheel_radius_;
    const double distance = 0.5 * (left + right);
    const double turn = (right - left) / wheel_separation_;
    const double heading = pose_.theta + 0.5 * turn;  // the chord of a short arc
    pose_.x += distance * std::cos(heading);
    pose_.y += distance * std::sin(heading);
    pose_.theta += turn;
  }
  left_ = left_angle;
  right_ = right_angle;
  started_ = true;
}

void DiffDriveBody::setSpeeds(double left, double right) noexcept {
  linear_ = 0.5 * (left + right) * wheel_radius_;
  angular_ = (right - left) * wheel_radius_ / wheel_separation_;
}

}  // namespace nord_driver::sim
