// The way to a position: along the ramps to the top speed, down again, and held; a speed controller below it.
//
// The simulator's own controller: the gains follow from the simulated motor as an installer would have set them.
#pragma once

#include "sim/inverter/motor.h"

namespace nord_driver::sim {

/// In Hz of the field and Hz/s.
struct MotionLimits {
  double top = 0.0;      ///< of the motion
  double maximum = 0.0;  ///< of the output frequency: P105
  double acceleration = 0.0;
  double deceleration = 0.0;
};

class PositionLoop {
 public:
  explicit PositionLoop(const Motor& motor) noexcept : motor_(motor) {}

  /// The control takes over, whatever the shaft does.
  void begin() noexcept;
  /// Output frequency for the next `dt` seconds; `distance` in revolutions of the shaft.
  double towards(double distance, const MotionLimits& limits, double dt) noexcept;
  /// The same for a constant speed, Hz of the rotor.
  double run(double speed, const MotionLimits& limits, double dt) noexcept;

  double speed() const noexcept { return speed_; }  ///< Hz, as the path has it
  /// Revolutions the shaft is behind (or before) the path.
  double lag() const noexcept { return lag_; }

 private:
  double follow(double wanted, const MotionLimits& limits, double dt) noexcept;

  const Motor& motor_;
  double speed_ = 0.0;
  double slip_ = 0.0;  // Hz, the integral
  double lag_ = 0.0;
  bool resting_ = false;
};

}  // namespace nord_driver::sim
