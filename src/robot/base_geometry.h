// What has to be known of a wheeled base to turn its motion into wheel speeds.
#pragma once

namespace nord_driver::robot {

/// Named as diff_drive_controller names it; a multiplier corrects what was measured or drawn.
struct BaseGeometry {
  double wheel_separation = 0.0;    ///< m, between the contact points of the two sides
  double left_wheel_radius = 0.0;   ///< m
  double right_wheel_radius = 0.0;  ///< m
  double wheel_separation_multiplier = 1.0;
  double left_wheel_radius_multiplier = 1.0;
  double right_wheel_radius_multiplier = 1.0;
  double wheel_base = 0.0;  ///< m, between the contact points of front and rear wheels; mecanum only
};

/// Sizes with their multipliers. Each throws std::invalid_argument with a sentence naming the field: every length and
/// multiplier is finite and greater than zero.
double separationOf(const BaseGeometry& geometry);
double leftRadiusOf(const BaseGeometry& geometry);
double rightRadiusOf(const BaseGeometry& geometry);
/// What turning a mecanum base takes: half of (wheel_separation + wheel_base), times wheel_separation_multiplier.
double mecanumLeverOf(const BaseGeometry& geometry);

}  // namespace nord_driver::robot
