// The part of the bus cycle that is about the base: from its command to its drives, and from these to its pose.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "cycle/bus_cycle.h"
#include "profile/scaling.h"

namespace nord_driver::cycle {

namespace {

// What the base waits for comes and goes with every command: told once in this time.
constexpr Duration kTellInterval = std::chrono::seconds{5};

const char* clauseOf(SteeredWait wait) noexcept {
  switch (wait) {
    case SteeredWait::kNothing:
      break;
    case SteeredWait::kAngles:
      return "the base waits until its wheels are steered";
    case SteeredWait::kNoAngle:
      return "cmd_vel asks for a motion that has no angle in the steering range: the base stands";
    case SteeredWait::kWiderCurve:
      return "cmd_vel asks for a curve beyond the steering range: the base drives the tightest there is";
    case SteeredWait::kNoPosition:
      return "a steering drive does not tell its angle: the base stands";
  }
  return "";
}

}  // namespace

void BusCycle::addBase(const BaseConfig& config) {
  wheels_ = config.wheels();
  if (config.steered) {
    steering_ = config.steered->steering;
    steered_.emplace(config, cmd_vel_timeout_);
  } else {
    base_.emplace(config, cmd_vel_timeout_);
  }
}

void BusCycle::commandBase(Instant now, Duration dt) noexcept {
  drive::DriveGroup& group = *supervisor_.base();
  group.commandIsFresh(!isStale(ports_.newestBaseCommand(), cmd_vel_timeout_, now), now);
  const bool follow = group.commandAllowed();
  const bool driving = follow || group.wantsZeroRamp();
  base_->tune(ports_.newestBaseTuning());
  const robot::WheelSpeeds wheels =
      base_->pollWheels(ports_.newestBaseCommand(), driving, follow, maxWheelSpeeds(), now, dt, minWheelSpeeds());
  for (std::size_t i = 0; i < wheels_.size(); ++i) setVelocity(wheels_[i], wheels[i]);
  group.setpointIsZero(robot::standsStill(wheels));
}

// Enabled, every drive of the base is: the wheels turn and the axes go to their angles, or none of them.
void BusCycle::commandSteered(Instant now, Duration dt) noexcept {
  drive::DriveGroup& group = *supervisor_.base();
  const TwistCommand& newest = ports_.newestBaseCommand();
  group.commandIsFresh(!isStale(newest, cmd_vel_timeout_, now), now);
  const bool follow = group.commandAllowed();
  const bool driving = follow || group.wantsZeroRamp();
  const SteeredDrives drives{maxWheelSpeeds(), steeringAngles(), minWheelSpeeds(), wheelsTurn(), fastestWheel()};
  const robot::SteeredSetpoint setpoint = steered_->poll(newest, driving, follow, drives, now, dt);
  for (std::size_t i = 0; i < wheels_.size(); ++i) setVelocity(wheels_[i], setpoint.wheels[i]);
  Sentence waits = clauseOf(steered_->waitsFor());
  bool passes = steered_->waitsFor() == SteeredWait::kAngles;
  for (std::size_t i = 0; i < steering_.size() && driving; ++i) {
    drive::Drive& axis = drives_[steering_[i]];
    if (!steered_->commandsAngles() && !axis.report().position.homing) continue;
    const drive::TargetRefusal refusal = axis.setPosition(setpoint.angles[i]);
    // One that is on its way out of "operation enabled" stops the base by itself.
    if (refusal == drive::TargetRefusal::kNone || refusal == drive::TargetRefusal::kNotEnabled) continue;
    waits.format("drive %s does not take the steering angle %.4g: %s", names_[steering_[i]].c_str(), setpoint.angles[i],
                 drive::toString(refusal));
    passes = false;
  }
  group.setpointIsZero(robot::standsStill(setpoint.wheels));
  tellWaits(waits, passes, now);
}

// Unseen, a wheel may turn.
bool BusCycle::wheelsTurn() const noexcept {
  return std::any_of(wheels_.begin(), wheels_.end(), [this](DriveIndex i) { return !drives_[i].isNearStandstill(); });
}

double BusCycle::fastestWheel() const noexcept {
  int fastest = 0;
  for (const DriveIndex i : wheels_) fastest = std::max(fastest, std::abs(int{drives_[i].report().speed}));
  return static_cast<double>(fastest) / profile::kHundredPercent;
}

// An axis on its way through a reference run turns its wheel to where the base does not go.
bool BusCycle::refuseHomeUnderWay(const Request& request) noexcept {
  if (!steered_ || !supervisor_.inBase(request.drive)) return false;
  const bool stands = steered_->limited() == robot::Twist2d{} && !wheelsTurn();
  if (stands && supervisor_.base()->commandAllowed()) return false;
  Sentence text;
  text.format("drive %s steers the base, and the base is not enabled at standstill: no reference run",
              names_[request.drive].c_str());
  ports_.complete(answerTo(request, false, text));
  return true;
}

void BusCycle::tellWaits(const Sentence& waits, bool passes, Instant now) noexcept {
  if (waits.empty()) waits_since_.reset();
  if (!waits.empty() && !waits_since_) waits_since_ = now;
  snapshot_.base.waits = waits;
  if (waits.empty() || (passes && now - *waits_since_ < kTellInterval)) return;
  if (waits_told_at_ && now - *waits_told_at_ < kTellInterval) return;
  waits_told_at_ = now;
  ports_.tell({true, waits});
}

robot::SteeringAngles BusCycle::steeringAngles() const noexcept {
  robot::SteeringAngles angles;
  for (const DriveIndex i : steering_) {
    const drive::PositionReport& axis = drives_[i].report().position;
    // On its way through a reference run an axis has no angle to drive by, and its count gets a new zero.
    angles.push_back(axis.homing ? std::numeric_limits<double>::quiet_NaN()
                                 : axis.position.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return angles;
}

bool BusCycle::isSaturatedWheel(DriveIndex drive) const noexcept {
  if (base_) return base_->belowMinimum() || base_->beyondFull();
  return !drives_[drive].positions() && (steered_->belowMinimum() || steered_->beyondFull());
}

robot::WheelSpeeds BusCycle::maxWheelSpeeds() const noexcept {
  robot::WheelSpeeds speeds;
  for (const DriveIndex i : wheels_) speeds.push_back(drives_[i].maxVelocity().value_or(RadPerSec{}).value);
  return speeds;
}

MinimumSpeeds BusCycle::minWheelSpeeds() const noexcept {
  MinimumSpeeds minimum;
  for (const DriveIndex i : wheels_) {
    minimum.wheels.push_back(minSpeed(i));
    minimum.directions.push_back(onlyDirection(i));
    minimum.coming_to_rest = minimum.coming_to_rest || comesToRest(i);
  }
  return minimum;
}

void BusCycle::measureBase(Duration dt) noexcept {
  bool seen = true;
  robot::WheelSpeeds wheels;
  for (const DriveIndex i : wheels_) {
    seen = seen && drives_[i].report().online && drives_[i].report().scaled;
    wheels.push_back(drives_[i].report().velocity.value);
  }
  const robot::SteeringAngles angles = steeringAngles();
  for (const double angle : angles) seen = seen && std::isfinite(angle);
  if (base_) seen ? base_->handleWheels(wheels, dt) : base_->handleGap();
  if (steered_) seen ? steered_->handleMeasured(wheels, angles, dt) : steered_->handleGap();
}

void BusCycle::publishBase() noexcept {
  BaseSnapshot& base = snapshot_.base;
  const robot::Odometry& odometry = base_ ? base_->odometry() : steered_->odometry();
  base.known = true;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    base.known = base.known && (axes_[i].known || !supervisor_.inBase(i));
  }
  base.pose = odometry.pose();
  base.velocity = odometry.velocity();
  base.command = base_ ? base_->limited() : steered_->limited();
  base.enabled = supervisor_.base()->commandAllowed();
  base.text = supervisor_.baseStopSentence();
  base.stopped = !base.text.empty();
  base.stop_cause = supervisor_.base()->report().stop_cause;
}

}  // namespace nord_driver::cycle
