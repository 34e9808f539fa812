// The kinematics of a two-sided base: differential drive and skid steer.
#pragma once

#include "robot/base_kinematics.h"

namespace nord_driver::robot {

/// Differential and skid-steer kinematics.
///
/// Assumes that
/// - the wheels of both sides turn about axes that are collinear and perpendicular to the direction of travel
///   (skid steer: all wheels of a side turn at one speed, and `wheel_separation_multiplier` stands for the slip in
///   turns),
/// - `base_link` lies midway between the two contact points,
/// - the wheels roll without slip on a plane and touch it all the time,
/// - the radii are those of the loaded wheels and do not change.
///
/// From measured wheels, a side moves with the mean of its wheels.
class DiffDriveKinematics final : public BaseKinematics {
 public:
  /// Throws std::invalid_argument with a sentence naming the field or the number of wheels: at least one a side, at
  /// most kMaxWheels in all.
  explicit DiffDriveKinematics(const BaseGeometry& geometry, std::size_t left_wheels = 1, std::size_t right_wheels = 1);

  std::size_t wheelCount() const noexcept override { return left_wheels_ + right_wheels_; }
  bool movesSideways() const noexcept override { return false; }
  WheelSpeeds wheels(const Twist2d& twist) const noexcept override;
  Twist2d twist(const WheelSpeeds& wheels) const noexcept override;
  bool setGeometry(const BaseGeometry& geometry) noexcept override;

 private:
  double separation_;
  double left_radius_;
  double right_radius_;
  std::size_t left_wheels_;
  std::size_t right_wheels_;
};

}  // namespace nord_driver::robot
