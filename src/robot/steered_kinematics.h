// The kinematics of a base whose driven wheels are steered, each by a joint of its own.
#pragma once

#include <cstddef>

#include "robot/steered_geometry.h"
#include "robot/twist.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::robot {

/// Where the wheels have to stand and how fast they have to turn (rad/s, positive: forward at steering angle 0).
struct SteeredSetpoint {
  SteeringAngles angles;
  WheelSpeeds wheels;
};

/// Assumes that
/// - every wheel touches the plane at one point, all the time, and turns about the upright axis through that point when
///   it is steered,
/// - wheels roll without slip where they stand as the motion asks.
///
/// A wheel that stands the other way round and turns backward makes the same motion, so an axle has up to
/// three angles for a motion inside a range of less than a turn and a half; the one near is taken.
class SteeredKinematics {
 public:
  /// Throws std::invalid_argument with a sentence that counts the axles from 1: two to kMaxSteeredAxles of them, at
  /// different places, with a radius greater than 0 and a steering range that holds 0 and is at most three turns.
  explicit SteeredKinematics(const SteeredAxles& axles);

  std::size_t axleCount() const noexcept { return axles_.size(); }
  const SteeredAxles& axles() const noexcept { return axles_; }

  /// Every axle has an angle for this motion.
  bool isPossible(const Twist2d& twist) const noexcept;
  /// The motion, with its sideways and turning parts made smaller by one factor until every axle has an angle for it.
  /// Without a forward part there may be nothing left: zero. A motion that is not finite is zero.
  Twist2d possible(const Twist2d& twist) const noexcept;

  /// Angles and speeds for a motion that `isPossible`. Of the angles that an axle has for it, the one nearest to
  /// `present` is taken; one that goes on from `last` is kept as long as another is not nearer by more than kKeep, so
  /// that between two that are equally near the choice does not swing. An axle that (nearly) stands, because the base
  /// turns about it or is to stand, keeps `last`. Where there is no angle in range, the nearest end of the range.
  SteeredSetpoint solve(const Twist2d& twist, const SteeringAngles& present, const SteeringAngles& last) const noexcept;
  static constexpr double kKeep = 0.2;  ///< rad

  /// How fast the wheels turn while they stand at `angles`: each with the part of its motion that lies along it.
  WheelSpeeds wheels(const Twist2d& twist, const SteeringAngles& angles) const noexcept;
  /// The motion that these wheel speeds (rad/s) at these angles give. Where they contradict each other, the one that
  /// fits the wheels' motions best (least squares). Zero for another number of them than `axleCount`.
  Twist2d twist(const WheelSpeeds& wheels, const SteeringAngles& angles) const noexcept;

 private:
  SteeredAxles axles_;
  double center_x_ = 0.0;  // m, the mean of the contact points
  double center_y_ = 0.0;
  double spread_ = 0.0;  // m^2, the sum of their squared distances from there
};

/// The largest difference between two sets of angles, rad; infinity when they are not of one base or one is NaN.
double largestDifference(const SteeringAngles& a, const SteeringAngles& b) noexcept;

}  // namespace nord_driver::robot
