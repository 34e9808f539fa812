// The simulated robot: the true pose that follows from the true angles of its wheels.
#pragma once

#include <array>

namespace nord_driver::sim {

struct Pose {
  double x = 0.0;      ///< m
  double y = 0.0;      ///< m
  double theta = 0.0;  ///< rad, continuous
};

/// A motion of the robot in its own frame, or the speed of one: forward, to the left, counter-clockwise.
struct Motion {
  double x = 0.0;    ///< m, m/s
  double y = 0.0;    ///< m, m/s
  double yaw = 0.0;  ///< rad, rad/s
};

/// What the wheels on the two sides of the robot do: angles since start in rad, or speeds in rad/s, positive =
/// forwards. Where a side turns as one, all of its wheels have the same.
struct Wheels {
  double front_left = 0.0;
  double rear_left = 0.0;
  double front_right = 0.0;
  double rear_right = 0.0;
};

/// Where the steered wheels of a robot point: rad from straight ahead, counter-clockwise seen from above.
struct Steering {
  double front = 0.0;
  double rear = 0.0;
};

/// No wheel slips on the ground.
class Body {
 public:
  virtual ~Body() = default;

  /// Wheel angles, and where wheels that are steered point meanwhile; the first call sets the reference.
  void moveTo(const Wheels& angles, const Steering& steering = {}) noexcept;
  /// Wheel speeds, for `linear()`, `lateral()` and `angular()`.
  void setSpeeds(const Wheels& speeds, const Steering& steering = {}) noexcept { speed_ = motionOf(speeds, steering); }

  const Pose& pose() const noexcept { return pose_; }
  double linear() const noexcept { return speed_.x; }     ///< m/s
  double lateral() const noexcept { return speed_.y; }    ///< m/s, to the left
  double angular() const noexcept { return speed_.yaw; }  ///< rad/s

 private:
  /// How the body moves when its wheels do so; linear in the wheels.
  virtual Motion motionOf(const Wheels& wheels, const Steering& steering) const noexcept = 0;

  bool started_ = false;
  Wheels last_;
  Pose pose_;
  Motion speed_;
};

/// Wheels on one axle line, all wheels of one side turn alike.
class DiffDriveBody final : public Body {
 public:
  /// Both in m.
  DiffDriveBody(double wheel_radius, double wheel_separation) noexcept
      : wheel_radius_(wheel_radius), wheel_separation_(wheel_separation) {}

 private:
  Motion motionOf(const Wheels& wheels, const Steering& steering) const noexcept override;

  double wheel_radius_;
  double wheel_separation_;
};

/// Four mecanum wheels whose rollers stand at 45 degrees and form an X seen from above: front right and rear left
/// forward, the other two backward, moves the robot to the left. Where the wheels contradict each other, all of them
/// slip alike.
class MecanumBody final : public Body {
 public:
  /// In m; `wheel_base` from the front to the rear axle.
  MecanumBody(double wheel_radius, double wheel_separation, double wheel_base) noexcept
      : wheel_radius_(wheel_radius), lever_(0.5 * (wheel_separation + wheel_base)) {}

 private:
  Motion motionOf(const Wheels& wheels, const Steering& steering) const noexcept override;

  double wheel_radius_;
  double lever_;
};

/// Where the wheel of a steered axle touches the ground, seen from the middle of the robot.
struct SteeredWheel {
  double x = 0.0;       ///< m
  double y = 0.0;       ///< m
  double radius = 0.0;  ///< m
};

/// Two driven wheels, each steered about the upright axis through its contact point; the rest of the robot runs on
/// castors. A wheel resists sliding along and across alike, so where the two contradict each other, in their speeds or
/// by where they point, both slip by the least that lets the robot stay rigid. Of `Wheels` those on the left count.
class SteeredBody final : public Body {
 public:
  SteeredBody(const SteeredWheel& front, const SteeredWheel& rear) noexcept : front_(front), rear_(rear) {}

 private:
  Motion motionOf(const Wheels& wheels, const Steering& steering) const noexcept override;

  SteeredWheel front_;
  SteeredWheel rear_;
};

}  // namespace nord_driver::sim
