#include "sim/robot/body.h"

#include <cmath>

namespace nord_driver::sim {

void Body::moveTo(const Wheels& angles, const Steering& steering) noexcept {
  if (started_) {
    const Motion moved = motionOf({angles.front_left - last_.front_left, angles.rear_left - last_.rear_left,
                                   angles.front_right - last_.front_right, angles.rear_right - last_.rear_right},
                                  steering);
    const double heading = pose_.theta + 0.5 * moved.yaw;  // the chord of a short arc
    pose_.x += moved.x * std::cos(heading) - moved.y * std::sin(heading);
    pose_.y += moved.x * std::sin(heading) + moved.y * std::cos(heading);
    pose_.theta += moved.yaw;
  }
  last_ = angles;
  started_ = true;
}

Motion DiffDriveBody::motionOf(const Wheels& wheels, const Steering&) const noexcept {
  const double left = wheels.front_left * wheel_radius_;
  const double right = wheels.front_right * wheel_radius_;
  return {0.5 * (left + right), 0.0, (right - left) / wheel_separation_};
}

Motion MecanumBody::motionOf(const Wheels& wheels, const Steering&) const noexcept {
  const double left = wheels.front_left + wheels.rear_left;
  const double right = wheels.front_right + wheels.rear_right;
  const double to_the_left = wheels.front_right + wheels.rear_left;
  const double to_the_right = wheels.front_left + wheels.rear_right;
  const double quarter = 0.25 * wheel_radius_;
  return {quarter * (left + right), quarter * (to_the_left - to_the_right), quarter * (right - left) / lever_};
}

// Each wheel wants its point of the robot to move its own way. Two points of a rigid body keep their distance: along the
// line between them they move alike, with the mean of what they want, and across it each its own way.
Motion SteeredBody::motionOf(const Wheels& wheels, const Steering& steering) const noexcept {
  const double distance = std::hypot(front_.x - rear_.x, front_.y - rear_.y);
  const double line_x = (front_.x - rear_.x) / distance;
  const double line_y = (front_.y - rear_.y) / distance;
  const auto along = [&](double size, double angle) {
    return size * (std::cos(angle) * line_x + std::sin(angle) * line_y);
  };
  const auto across = [&](double size, double angle) {
    return size * (std::sin(angle) * line_x - std::cos(angle) * line_y);
  };
  const double front = wheels.front_left * front_.radius;
  const double rear = wheels.rear_left * rear_.radius;
  const double both_along = 0.5 * (along(front, steering.front) + along(rear, steering.rear));
  const double front_across = across(front, steering.front);
  const double yaw = (front_across - across(rear, steering.rear)) / distance;
  const double front_x = both_along * line_x - front_across * line_y;
  const double front_y = both_along * line_y + front_across * line_x;
  return {front_x + yaw * front_.y, front_y - yaw * front_.x, yaw};
}

}  // namespace nord_driver::sim
