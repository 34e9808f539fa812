#include "sim/robot/body.h"

#include <cmath>

namespace nord_driver::sim {

void Body::moveTo(const Wheels& angles) noexcept {
  if (started_) {
    const Motion moved = motionOf({angles.front_left - last_.front_left, angles.rear_left - last_.rear_left,
                                   angles.front_right - last_.front_right, angles.rear_right - last_.rear_right});
    const double heading = pose_.theta + 0.5 * moved.yaw;  // the chord of a short arc
    pose_.x += moved.x * std::cos(heading) - moved.y * std::sin(heading);
    pose_.y += moved.x * std::sin(heading) + moved.y * std::cos(heading);
    pose_.theta += moved.yaw;
  }
  last_ = angles;
  started_ = true;
}

Motion DiffDriveBody::motionOf(const Wheels& wheels) const noexcept {
  const double left = wheels.front_left * wheel_radius_;
  const double right = wheels.front_right * wheel_radius_;
  return {0.5 * (left + right), 0.0, (right - left) / wheel_separation_};
}

Motion MecanumBody::motionOf(const Wheels& wheels) const noexcept {
  const double left = wheels.front_left + wheels.rear_left;
  const double right = wheels.front_right + wheels.rear_right;
  const double to_the_left = wheels.front_right + wheels.rear_left;
  const double to_the_right = wheels.front_left + wheels.rear_right;
  const double quarter = 0.25 * wheel_radius_;
  return {quarter * (left + right), quarter * (to_the_left - to_the_right), quarter * (right - left) / lever_};
}

}  // namespace nord_driver::sim
