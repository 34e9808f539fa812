// How fast the wheels of a steered base turn once all of them stand as the motion asks.
#pragma once

#include "robot/base_kinematics.h"
#include "robot/steered_kinematics.h"

namespace nord_driver::robot {

/// For whoever compares drives with what the base asks of their wheels, and has no steering angles at hand: every wheel
/// is taken to stand where the motion asks, of several such angles at the one nearest to 0. Back from wheel speeds there
/// is no way without the angles: all wheels are taken to stand at 0.
class SteeredReach final : public BaseKinematics {
 public:
  /// Throws as SteeredKinematics does.
  explicit SteeredReach(const SteeredAxles& axles);

  std::size_t wheelCount() const noexcept override { return kinematics_.axleCount(); }
  /// The steering range lets it.
  bool movesSideways() const noexcept override { return kinematics_.isPossible({0.0, 0.0, 1.0}); }
  /// Zero for a motion that the steering range does not let it make at all.
  WheelSpeeds wheels(const Twist2d& twist) const noexcept override;
  Twist2d twist(const WheelSpeeds& wheels) const noexcept override { return kinematics_.twist(wheels, straight_); }
  /// Its sizes are no BaseGeometry: false.
  bool setGeometry(const BaseGeometry&) noexcept override { return false; }

 private:
  SteeredKinematics kinematics_;
  SteeringAngles straight_;
};

}  // namespace nord_driver::robot
