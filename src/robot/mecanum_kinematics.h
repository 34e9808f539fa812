// The kinematics of a base on four mecanum wheels: forward, sideways and turning at once.
#pragma once

#include "robot/base_kinematics.h"

namespace nord_driver::robot {

/// Wheels are counted front left, rear left, front right, rear right.
///
/// Assumes that
/// - the rollers stand at 45 degrees and, seen from above, those on top of the wheels form an X (their axes point to
///   the middle of the base): going left turns front right and rear left forward, the other two backward,
/// - `base_link` lies in the middle of the four contact points,
/// - the rollers run freely and the wheels touch the plane all the time; a base without suspension on an uneven floor
///   does not.
///
/// Four wheels have one freedom more than the plane: when measured speeds contradict each other, wheels slip, and the
/// motion returned is the best fit.
class MecanumKinematics final : public BaseKinematics {
 public:
  /// Throws std::invalid_argument with a sentence naming the field: every length (wheel_base too) and multiplier is
  /// finite and greater than zero.
  explicit MecanumKinematics(const BaseGeometry& geometry);

  std::size_t wheelCount() const noexcept override { return 4; }
  bool movesSideways() const noexcept override { return true; }
  WheelSpeeds wheels(const Twist2d& twist) const noexcept override;
  Twist2d twist(const WheelSpeeds& wheels) const noexcept override;
  bool setGeometry(const BaseGeometry& geometry) noexcept override;

 private:
  double lever_;
  double left_radius_;
  double right_radius_;
};

}  // namespace nord_driver::robot
