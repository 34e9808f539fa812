#include "robot/odometry.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/units.h"

namespace nord_driver::robot {
namespace {

double normalized(double angle) noexcept {
  const double rest = std::remainder(angle, 2.0 * kPi);
  return rest <= -kPi ? kPi : rest;
}

/// sin(x) / x, and 1 at zero.
double sinc(double x) noexcept {
  return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x;
}

std::size_t checkedWindow(std::size_t size) {
  if (size >= 1 && size <= Odometry::kMaxWindow) return size;
  throw std::invalid_argument("velocity_rolling_window_size is " + std::to_string(size) + ", expected 1 to " +
                              std::to_string(Odometry::kMaxWindow));
}

}  // namespace

Odometry::Odometry(std::size_t velocity_rolling_window_size) : window_(checkedWindow(velocity_rolling_window_size)) {}

void Odometry::update(const Twist2d& twist, Duration dt) noexcept {
  if (!isFinite(twist)) return;
  const double time = toSeconds(dt);
  if (has_last_ && time > 0.0) {
    const double forward = (last_.linear_x + twist.linear_x) / 2.0 * time;
    const double angle = (last_.angular_z + twist.angular_z) / 2.0 * time;
    const double left = (last_.linear_y + twist.linear_y) / 2.0 * time;
    moveAlongArc(forward, angle, left);
    window_[next_] = {forward, angle, left, time};
    next_ = (next_ + 1) % window_.size();
    if (filled_ < window_.size()) ++filled_;
  }
  last_ = twist;
  has_last_ = true;
}

void Odometry::moveAlongArc(double forward, double angle, double left) noexcept {
  if (!std::isfinite(forward) || !std::isfinite(angle) || !std::isfinite(left)) return;
  // The chord of the arc is the way seen at half the angle; its length is the arc's times sinc of that half.
  const double half = angle / 2.0;
  const double x = std::cos(pose_.heading + half) * sinc(half);
  const double y = std::sin(pose_.heading + half) * sinc(half);
  pose_.x += forward * x - left * y;
  pose_.y += forward * y + left * x;
  pose_.heading = normalized(pose_.heading + angle);
}

void Odometry::reset(const Pose2d& pose) noexcept {
  pose_ = {pose.x, pose.y, normalized(pose.heading)};
  rebase();
}

void Odometry::rebase() noexcept {
  last_ = {};
  has_last_ = false;
  next_ = 0;
  filled_ = 0;
}

Twist2d Odometry::velocity() const noexcept {
  Step sum;
  for (std::size_t i = 0; i < filled_; ++i) {
    sum.forward += window_[i].forward;
    sum.angle += window_[i].angle;
    sum.left += window_[i].left;
    sum.dt += window_[i].dt;
  }
  if (!(sum.dt > 0.0)) return {};
  return {sum.forward / sum.dt, sum.angle / sum.dt, sum.left / sum.dt};
}

}  // namespace nord_driver::robot
