#include "robot/steered_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/units.h"

namespace nord_driver::robot {

namespace {

constexpr double kRounding = 1e-9;           // rad, at the ends of a range
constexpr double kStands = 1e-3;             // of the fastest axle: where the direction of a motion means nothing
constexpr double kSmallestDistance = 1e-3;   // m
constexpr double kLargestAngle = 6.0 * kPi;  // rad
constexpr int kHalvings = 40;

struct Velocity {
  double x = 0.0;
  double y = 0.0;
  double size() const noexcept { return std::hypot(x, y); }
};

Velocity velocityAt(const SteeredAxle& axle, const Twist2d& twist) noexcept {
  return {twist.linear_x - twist.angular_z * axle.y, twist.linear_y + twist.angular_z * axle.x};
}

double fastestOf(const SteeredAxles& axles, const Twist2d& twist) noexcept {
  double fastest = 0.0;
  for (const SteeredAxle& axle : axles) fastest = std::max(fastest, velocityAt(axle, twist).size());
  return fastest;
}

/// The first angle in the range at which the wheel rolls along this velocity, forward or backward.
double firstAngle(const SteeredAxle& axle, const Velocity& velocity) noexcept {
  const double angle = std::atan2(velocity.y, velocity.x);
  return angle + std::ceil((axle.min_angle - kRounding - angle) / kPi) * kPi;
}

bool hasAngle(const SteeredAxle& axle, const Velocity& velocity) noexcept {
  return firstAngle(axle, velocity) <= axle.max_angle + kRounding;
}

/// Of the angles in the range; nothing without one.
std::optional<double> chosenAngle(const SteeredAxle& axle, const Velocity& velocity, double present,
                                  double last) noexcept {
  std::optional<double> chosen;
  double least = std::numeric_limits<double>::infinity();
  for (double angle = firstAngle(axle, velocity); angle <= axle.max_angle + kRounding; angle += kPi) {
    const bool goes_on = std::abs(angle - last) < kPi / 2.0;
    const double way = std::abs(angle - present) - (goes_on ? SteeredKinematics::kKeep : 0.0);
    if (way >= least) continue;
    least = way;
    chosen = angle;
  }
  return chosen;
}

void refuse(std::size_t axle, const std::string& what) {
  throw std::invalid_argument("axle " + std::to_string(axle + 1) + " of the steered base " + what);
}

void check(const SteeredAxle& axle, std::size_t index) {
  if (!std::isfinite(axle.x) || !std::isfinite(axle.y)) refuse(index, "stands at no finite place");
  if (!std::isfinite(axle.wheel_radius) || !(axle.wheel_radius > 0.0)) {
    refuse(index, "has a wheel radius of " + std::to_string(axle.wheel_radius) + " m, expected more than 0");
  }
  const bool holds_zero = axle.min_angle <= 0.0 && axle.max_angle >= 0.0 && axle.max_angle > axle.min_angle;
  if (!holds_zero || axle.min_angle < -kLargestAngle || axle.max_angle > kLargestAngle) {
    refuse(index, "can be steered from " + std::to_string(axle.min_angle) + " to " + std::to_string(axle.max_angle) +
                      " rad, expected a range that holds 0, three turns to either side at most");
  }
}

}  // namespace

SteeredKinematics::SteeredKinematics(const SteeredAxles& axles) : axles_(axles) {
  if (axles_.size() < 2) {
    throw std::invalid_argument("a steered base has " + std::to_string(axles_.size()) +
                                " axles, expected two at least: one alone does not say how the base turns");
  }
  const auto count = static_cast<double>(axles_.size());
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    check(axles_[i], i);
    center_x_ += axles_[i].x / count;
    center_y_ += axles_[i].y / count;
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = std::hypot(axles_[i].x - axles_[j].x, axles_[i].y - axles_[j].y);
      if (distance < kSmallestDistance) refuse(i, "stands where axle " + std::to_string(j + 1) + " stands");
    }
  }
  for (const SteeredAxle& axle : axles_) {
    const double x = axle.x - center_x_;
    const double y = axle.y - center_y_;
    spread_ += x * x + y * y;
  }
}

bool SteeredKinematics::isPossible(const Twist2d& twist) const noexcept {
  if (!isFinite(twist)) return false;
  const double fastest = fastestOf(axles_, twist);
  return std::all_of(axles_.begin(), axles_.end(), [&](const SteeredAxle& axle) {
    const Velocity velocity = velocityAt(axle, twist);
    return velocity.size() <= kStands * fastest || hasAngle(axle, velocity);
  });
}

Twist2d SteeredKinematics::possible(const Twist2d& twist) const noexcept {
  if (!isFinite(twist)) return {};
  if (isPossible(twist)) return twist;
  // Straight on is always possible: 0 is in every range. Only what was found possible is kept.
  const auto scaled = [&](double part) {
    return Twist2d{twist.linear_x, part * twist.angular_z, part * twist.linear_y};
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2.0;
    (isPossible(scaled(middle)) ? low : high) = middle;
  }
  // What is left of a motion without a forward part is rounding, or another motion than the one asked for.
  return twist.linear_x == 0.0 ? Twist2d{} : scaled(low);
}

SteeredSetpoint SteeredKinematics::solve(const Twist2d& twist, const SteeringAngles& present,
                                         const SteeringAngles& last) const noexcept {
  SteeredSetpoint setpoint;
  setpoint.angles = last;
  setpoint.wheels.resize(axles_.size());
  if (present.size() != axles_.size() || last.size() != axles_.size() || !isFinite(twist)) return setpoint;
  const double fastest = fastestOf(axles_, twist);
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const Velocity velocity = velocityAt(axles_[i], twist);
    if (velocity.size() <= kStands * fastest) continue;
    const auto angle = chosenAngle(axles_[i], velocity, present[i], last[i]);
    const double wanted = angle.value_or(std::atan2(velocity.y, velocity.x));
    setpoint.angles[i] = std::max(axles_[i].min_angle, std::min(axles_[i].max_angle, wanted));
  }
  setpoint.wheels = wheels(twist, setpoint.angles);
  return setpoint;
}

WheelSpeeds SteeredKinematics::wheels(const Twist2d& twist, const SteeringAngles& angles) const noexcept {
  WheelSpeeds wheels;
  wheels.resize(axles_.size());
  if (angles.size() != axles_.size()) return wheels;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const Velocity velocity = velocityAt(axles_[i], twist);
    wheels[i] = (velocity.x * std::cos(angles[i]) + velocity.y * std::sin(angles[i])) / axles_[i].wheel_radius;
  }
  return wheels;
}

// The best fit of a rigid motion to the motions of points: their mean moves the mean of the points, and what is left
// turns about it.
Twist2d SteeredKinematics::twist(const WheelSpeeds& wheels, const SteeringAngles& angles) const noexcept {
  if (wheels.size() != axles_.size() || angles.size() != axles_.size()) return {};
  const auto count = static_cast<double>(axles_.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  double turning = 0.0;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const double speed = wheels[i] * axles_[i].wheel_radius;
    const double x = speed * std::cos(angles[i]);
    const double y = speed * std::sin(angles[i]);
    mean_x += x / count;
    mean_y += y / count;
    turning += (axles_[i].x - center_x_) * y - (axles_[i].y - center_y_) * x;
  }
  const double turn = turning / spread_;
  return {mean_x + turn * center_y_, turn, mean_y - turn * center_x_};
}

double largestDifference(const SteeringAngles& a, const SteeringAngles& b) noexcept {
  double largest = 0.0;
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace nord_driver::robot
