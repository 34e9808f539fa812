// From the motion of a two-sided base to its wheels and back.
#pragma once

#include "nord_driver/robot/twist.h"
#include "nord_driver/robot/wheel_speeds.h"

namespace nord_driver::robot {

/// What has to be known of the base, named as diff_drive_controller names it.
struct DiffDriveGeometry {
  double wheel_separation = 0.0;    ///< m, between the contact points of the two sides
  double left_wheel_radius = 0.0;   ///< m
  double right_wheel_radius = 0.0;  ///< m
  double wheel_separation_multiplier = 1.0;
  double left_wheel_radius_multiplier = 1.0;
  double right_wheel_radius_multiplier = 1.0;
};

/// Differential and skid-steer kinematics.
///
/// Assumes that
/// - the wheels of both sides turn about axes that are collinear and perpendicular to the direction of travel
///   (skid steer: all wheels of a side turn at one speed, and `wheel_separation_multiplier` stands for the slip in
///   turns),
/// - `base_link` lies midway between the two contact points,
/// - the wheels roll without slip on a plane and touch it all the time,
/// - the radii are those of the loaded wheels and do not change.
class DiffDriveKinematics {
 public:
  /// Throws std::invalid_argument with a sentence naming the field: every length and multiplier is finite and greater
  /// than zero.
  explicit DiffDriveKinematics(const DiffDriveGeometry& geometry);

  /// The wheel speeds (rad/s) that give this motion.
  WheelSpeeds wheels(const Twist2d& twist) const noexcept;
  /// The motion that these wheel speeds (rad/s) give.
  Twist2d twist(const WheelSpeeds& wheels) const noexcept;

  double wheelSeparation() const noexcept { return separation_; }     ///< m, multiplier included
  double leftWheelRadius() const noexcept { return left_radius_; }    ///< m, multiplier included
  double rightWheelRadius() const noexcept { return right_radius_; }  ///< m, multiplier included

 private:
  double separation_;
  double left_radius_;
  double right_radius_;
};

}  // namespace nord_driver::robot
