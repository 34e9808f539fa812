#include "sim/inverter/motor.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kPullOut = 2.5;  // torque share at which the motor gives no more

}  // namespace

double Motor::rotorFrequency() const noexcept {
  return speed_ * settings_.pole_pairs / kTwoPi;
}

void Motor::advance(double dt, bool voltage, double frequency) noexcept {
  if (dt <= 0.0) return;
  const double torque_per_hertz = settings_.rated_torque / settings_.slip;
  const double hertz_per_speed = settings_.pole_pairs / kTwoPi;
  const double dry = settings_.load * settings_.rated_torque;
  const double before = speed_;

  // Implicit steps: stable however stiff the slip's spring is against the inertia.
  double drive = 0.0;  // torque that does not depend on the speed
  double damping = settings_.viscous;
  torque_ = 0.0;
  const double step = dt / settings_.inertia;
  if (voltage) {
    const double stiff = damping + torque_per_hertz * hertz_per_speed;
    const double reached = (speed_ + step * torque_per_hertz * frequency) / (1.0 + step * stiff);
    // At the end of the step: the torque at its begin would carry a motor with little slip beyond its field.
    const double wanted = torque_per_hertz * (frequency - reached * hertz_per_speed);
    const double limit = kPullOut * settings_.rated_torque;
    if (std::fabs(wanted) > limit) {
      drive = std::copysign(limit, wanted);
    } else {
      drive = torque_per_hertz * frequency;
      damping = stiff;
    }
  }
  const double free = (speed_ + step * drive) / (1.0 + step * damping);
  // Dry friction takes speed away, never adds any, and holds the shaft when the rest cannot overcome it.
  const double friction = step * dry / (1.0 + step * damping);
  speed_ = blocked_ ? 0.0 : std::copysign(std::max(0.0, std::fabs(free) - friction), free);
  if (voltage) {
    const double limit = kPullOut * settings_.rated_torque;
    torque_ = std::clamp(torque_per_hertz * (frequency - rotorFrequency()), -limit, limit);
  }
  angle_ += 0.5 * (before + speed_) * dt;
}

}  // namespace nord_driver::sim
