#include "sim/inverter/position_loop.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kPositionGain = 15.0;  // 1/s
constexpr double kSpeedGain = 100.0;    // 1/s
constexpr double kIntegral = 20.0;      // 1/s
constexpr double kReserve = 0.9;        // of the deceleration, for the path to a target
constexpr double kPullOut = 2.5;        // times the rated torque
// The control lets go within a resolution step, and acts again before the error shows.
constexpr double kRest = 0.0003;   // revolutions
constexpr double kWake = 0.0006;   // revolutions
constexpr double kStill = 0.0005;  // revolutions per second

}  // namespace

void PositionLoop::begin() noexcept {
  speed_ = motor_.rotorFrequency();
  slip_ = 0.0;
  lag_ = 0.0;
  resting_ = false;
}

double PositionLoop::towards(double distance, const MotionLimits& limits, double dt) noexcept {
  const int pole_pairs = motor_.settings().pole_pairs;
  const double away = std::fabs(distance);
  if (resting_ ? away < kWake : away < kRest && std::fabs(motor_.speed()) < kTwoPi * kStill) {
    resting_ = true;
    speed_ = slip_ = lag_ = 0.0;
    return 0.0;
  }
  resting_ = false;
  // A straight line near the target, the parabola of the ramp before it; both meet with the same slope.
  const double deceleration = kReserve * limits.deceleration;
  const double path = away * pole_pairs;
  const double line = deceleration / (kPositionGain * kPositionGain);
  const double speed = path < line ? kPositionGain * path : std::sqrt(2.0 * deceleration * (path - 0.5 * line));
  return follow(std::copysign(std::min(speed, limits.top), distance), limits, dt);
}

double PositionLoop::run(double speed, const MotionLimits& limits, double dt) noexcept {
  resting_ = false;
  return follow(std::clamp(speed, -limits.top, limits.top), limits, dt);
}

double PositionLoop::follow(double wanted, const MotionLimits& limits, double dt) noexcept {
  const double before = speed_;
  const bool faster = before == 0.0 || (before > 0.0 ? wanted > before : wanted < before);
  const double reachable = faster || wanted * before >= 0.0 ? wanted : 0.0;  // a reversal passes zero
  const double step = (faster ? limits.acceleration : limits.deceleration) * dt;
  speed_ = std::clamp(reachable, before - step, before + step);

  const MotorSettings& motor = motor_.settings();
  const double rotor = motor_.rotorFrequency();
  lag_ += (speed_ - rotor) / motor.pole_pairs * dt;
  // Hz/s of the rotor for each Hz of slip.
  const double response = motor.rated_torque / motor.slip / motor.inertia * motor.pole_pairs / kTwoPi;
  const double error = speed_ - rotor;
  const double most = kPullOut * motor.slip;
  const double ahead = ((speed_ - before) / dt + kSpeedGain * error) / response;
  const double asked = rotor + std::clamp(ahead + slip_, -most, most);
  const double frequency = std::clamp(asked, -limits.maximum, limits.maximum);
  const bool limited = std::fabs(ahead + slip_) > most || frequency != asked;
  if (!limited) slip_ += kIntegral * kSpeedGain * error / response * dt;
  return frequency;
}

}  // namespace nord_driver::sim
