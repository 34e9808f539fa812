// The simulated robot: the true pose that follows from the true angles of its wheels.
#pragma once

namespace nord_driver::sim {

struct Pose {
  double x = 0.0;      ///< m
  double y = 0.0;      ///< m
  double theta = 0.0;  ///< rad, continuous
};

/// Wheels on one axle line, no slip on the ground, all wheels of one side turn alike (their mean counts).
class DiffDriveBody {
 public:
  /// Both in m.
  DiffDriveBody(double wheel_radius, double wheel_separation) noexcept
      : wheel_radius_(wheel_radius), wheel_separation_(wheel_separation) {}

  /// Wheel angles in rad since start, positive = forwards. The first call sets the reference.
  void moveTo(double left_angle, double right_angle) noexcept;
  /// Wheel speeds in rad/s, for `linear()` and `angular()`.
  void setSpeeds(double left, double right) noexcept;

  const Pose& pose() const noexcept { return pose_; }
  double linear() const noexcept { return linear_; }    ///< m/s
  double angular() const noexcept { return angular_; }  ///< rad/s

 private:
  double wheel_radius_;
  double wheel_separation_;
  bool started_ = false;
  double left_ = 0.0;
  double right_ = 0.0;
  Pose pose_;
  double linear_ = 0.0;
  double angular_ = 0.0;
};

}  // namespace nord_driver::sim
