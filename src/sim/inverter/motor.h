// The simulated shaft: a motor with slip, inertia and friction.
//
// An induction motor turns slower than its field by the slip its load needs, and coasts when the voltage goes off. A
// simulator without both would hide every mistake of odometry and of stopping.
#pragma once

namespace nord_driver::sim {

/// Everything at the motor shaft.
struct MotorSettings {
  int pole_pairs = 2;
  double inertia = 0.01;      ///< kg m2, load included
  double rated_torque = 5.0;  ///< Nm
  double slip = 2.0;          ///< Hz of the field ahead of the rotor at rated torque
  double load = 0.02;         ///< dry friction as a share of the rated torque, against every motion
  double viscous = 0.0005;    ///< Nm per rad/s
};

/// Torque is proportional to the slip up to a pull-out torque; fed with time, no clock of its own.
class Motor {
 public:
  explicit Motor(const MotorSettings& settings) noexcept : settings_(settings) {}

  /// `dt` in s, `frequency` of the field in Hz (sign = direction); without voltage only friction acts.
  void advance(double dt, bool voltage, double frequency) noexcept;

  /// Something holds the shaft, whatever the field does.
  void setBlocked(bool on) noexcept { blocked_ = on; }

  double speed() const noexcept { return speed_; }  ///< rad/s
  double angle() const noexcept { return angle_; }  ///< rad, continuous
  /// The rotor's speed as an electrical frequency, in Hz: what the field would have without slip.
  double rotorFrequency() const noexcept;
  /// Torque of the field as a share of the rated torque.
  double torqueShare() const noexcept { return torque_ / settings_.rated_torque; }
  const MotorSettings& settings() const noexcept { return settings_; }

 private:
  MotorSettings settings_;
  double speed_ = 0.0;
  double angle_ = 0.0;
  double torque_ = 0.0;
  bool blocked_ = false;
};

}  // namespace nord_driver::sim
