#include "cycle/steered_motion.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::cycle {

namespace {

constexpr Duration kLongestHold = std::chrono::milliseconds{500};
// A wheel that gets no slower at setpoint 0 stands as well as it ever will; as of a drive that halts (DriveGroup).
constexpr Duration kNoSlower = std::chrono::seconds{1};
// Of 100 %, in that time: down a ramp of 1000 s; P103, a word in steps of 0.01 s, ends at 655 s.
constexpr double kSlower = 0.001;
// Of the tolerance: how far a step may lead the wheels, and by how much it may turn the angles at once. The rest is
// for how exactly the axes come to their angles.
constexpr double kLead = 0.75;
constexpr double kTurnAtOnce = 0.5;

bool allKnown(const robot::SteeringAngles& angles) noexcept {
  return std::all_of(angles.begin(), angles.end(), [](double angle) { return std::isfinite(angle); });
}

}  // namespace

SteeredMotion::SteeredMotion(const BaseConfig& config, Duration cmd_vel_timeout)
    : kinematics_(config.steered.value().axles),
      joint_limits_(wheelLimits(config)),
      limiter_(config.limits),
      odometry_(config.velocity_rolling_window_size),
      timeout_(cmd_vel_timeout),
      tolerance_(config.steered->angle_tolerance),
      open_loop_(config.open_loop) {
  steered_.resize(kinematics_.axleCount());
}

robot::SteeredSetpoint SteeredMotion::poll(const TwistCommand& command, bool driving, bool follow,
                                           const SteeredDrives& drives, Instant now, Duration dt) noexcept {
  obeys_ = below_minimum_ = beyond_full_ = false;
  waits_for_ = SteeredWait::kNothing;
  const bool known = allKnown(drives.angles);
  if (!driving || !known) {
    limiter_.reset();
    rolling_.reset();
    if (known) steered_ = drives.angles;
    was_blind_ = !known;
    steers_ = false;
    commands_angles_ = commands_angles_ && driving;
    if (driving) waits_for_ = SteeredWait::kNoPosition;
    return rest();
  }
  // Where they stand may be somewhere else, and counted anew: they are not sent back.
  if (was_blind_) steered_ = drives.angles;
  was_blind_ = false;
  const robot::WheelSpeeds limits = robot::tighterOf(drives.max_speeds, joint_limits_);
  obeys_ = follow && !drives.minimum.coming_to_rest && !command.held && !isStale(command, timeout_, now);
  if (!obeys_) limiter_.endAcceleration();
  robot::Twist2d target = targetOf(command, obeys_, limits, drives);
  // Taken as zero at once, it is left along the limits.
  below_minimum_ = anyBelow(kinematics_.solve(target, drives.angles, steered_).wheels, drives.minimum);
  if (below_minimum_) target = {};
  if (limited_ == robot::Twist2d{} && !readyToDriveOff(target, drives, dt)) {
    obeys_ = obeys_ && target == robot::Twist2d{};
    limiter_.reset();
    return rest();
  }
  rolling_.reset();
  step(target, drives, now, dt);
  return setpoint(drives, limits, target == robot::Twist2d{});
}

// What is beyond the steering range or too fast is made smaller before the ramps, which never run ahead of the wheels.
robot::Twist2d SteeredMotion::targetOf(const TwistCommand& command, bool obey, const robot::WheelSpeeds& limits,
                                       const SteeredDrives& drives) noexcept {
  if (!obey || !isFinite(command.twist) || command.twist == robot::Twist2d{}) return {};
  const robot::Twist2d possible = kinematics_.possible(command.twist);
  if (possible != command.twist) {
    waits_for_ = possible == robot::Twist2d{} ? SteeredWait::kNoAngle : SteeredWait::kWiderCurve;
  }
  const robot::WheelSpeeds wheels = kinematics_.solve(possible, drives.angles, steered_).wheels;
  beyond_full_ = robot::areBeyond(wheels, drives.max_speeds);
  return robot::times(robot::factorInto(wheels, limits), possible);
}

bool SteeredMotion::rollsOut(const SteeredDrives& drives, Duration dt) noexcept {
  if (!drives.wheels_turn) {
    rolling_.reset();
    return false;
  }
  const bool slower = !rolling_ || drives.wheel_speed < rolling_->slowest - kSlower;
  rolling_ = slower ? Rolling{drives.wheel_speed} : Rolling{rolling_->slowest, rolling_->lasts + dt};
  return rolling_->lasts < kNoSlower;
}

bool SteeredMotion::readyToDriveOff(const robot::Twist2d& target, const SteeredDrives& drives, Duration dt) noexcept {
  const robot::SteeringAngles& angles = drives.angles;
  const bool rolls = rollsOut(drives, dt);
  if (target == robot::Twist2d{}) {
    // A way to steer that is not asked for any more ends where it is; wheels that have arrived keep their angle.
    if (steers_ && robot::largestDifference(steered_, angles) > tolerance_) steered_ = angles;
    steers_ = false;
    return false;
  }
  const robot::SteeringAngles wanted = kinematics_.solve(target, angles, steered_).angles;
  // Commanded to stand they come down their own ramps (P103), which may be slower than the limits, or there are none. What
  // has begun to be steered at standstill is not ended by that.
  if (rolls && robot::largestDifference(wanted, steers_ ? steered_ : angles) > tolerance_) {
    waits_for_ = SteeredWait::kAngles;
    return false;
  }
  steered_ = wanted;
  commands_angles_ = true;
  steers_ = robot::largestDifference(steered_, angles) > tolerance_;
  if (steers_) waits_for_ = SteeredWait::kAngles;
  return !steers_;
}

// As BaseMotion::ramp.
robot::TwistLimiter SteeredMotion::stepped(const robot::Twist2d& target, const SteeredDrives& drives,
                                           Duration dt) const noexcept {
  const auto isPossible = [&](const robot::Twist2d& twist) {
    return !anyBelow(kinematics_.wheels(twist, drives.angles), drives.minimum);
  };
  robot::TwistLimiter limiter = limiter_;
  limiter.limitWhere(isPossible, target, dt);
  return limiter;
}

void SteeredMotion::step(const robot::Twist2d& target, const SteeredDrives& drives, Instant now, Duration dt) noexcept {
  const robot::SteeringAngles& angles = drives.angles;
  const robot::TwistLimiter next = stepped(target, drives, dt);
  const robot::SteeringAngles wanted = kinematics_.solve(next.twist(), angles, steered_).angles;
  Step way = target == robot::Twist2d{} ? Step::kGo : stepTo(next.twist(), wanted, angles);
  // A stop that was begun for a wheel that is to reverse is not decided on anew: where one axis has a jerk limit and
  // begins to brake more slowly than the others, the next step would be possible again, and lead back.
  turns_about_ = (turns_about_ || way == Step::kTurnAbout) && anyReverses(target, angles);
  if (turns_about_) way = Step::kTurnAbout;
  if (way != Step::kHold) holding_since_.reset();
  if (way == Step::kHold && now - holding_since_.emplace(holding_since_.value_or(now)) >= kLongestHold) {
    way = Step::kBrake;
  }
  switch (way) {
    case Step::kGo:
      limiter_ = next;
      // To zero each axis may go its own shortest way (TwistLimiter): what is left of the motion on it is no path.
      if (target != robot::Twist2d{}) steered_ = wanted;
      break;
    case Step::kHold:
      limiter_ = stepped(limited_, drives, dt);
      break;
    case Step::kBrake:
    case Step::kTurnAbout:
      limiter_ = stepped({}, drives, dt);
      waits_for_ = SteeredWait::kAngles;
      break;
  }
  limited_ = limiter_.twist();
}

SteeredMotion::Step SteeredMotion::stepTo(const robot::Twist2d& next, const robot::SteeringAngles& wanted,
                                          const robot::SteeringAngles& angles) const noexcept {
  constexpr double kRounding = 1e-9;
  const double off = robot::largestDifference(steered_, angles);
  if (off > tolerance_) return Step::kBrake;
  const double turn = robot::largestDifference(wanted, steered_);
  if (!kinematics_.isPossible(next) || turn > kTurnAtOnce * tolerance_) return Step::kTurnAbout;
  const double lead = robot::largestDifference(wanted, angles);
  const bool not_further = lead <= off + kRounding && lead <= tolerance_;
  return lead <= kLead * tolerance_ || not_further ? Step::kGo : Step::kHold;
}

bool SteeredMotion::anyReverses(const robot::Twist2d& target, const robot::SteeringAngles& angles) const noexcept {
  const robot::WheelSpeeds present = kinematics_.wheels(limited_, steered_);
  const robot::WheelSpeeds wanted = kinematics_.solve(target, angles, steered_).wheels;
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (present[i] * wanted[i] < 0.0) return true;
  }
  return false;
}

robot::SteeredSetpoint SteeredMotion::rest() noexcept {
  limited_ = {};
  drives_ = false;
  holding_since_.reset();
  robot::SteeredSetpoint setpoint;
  setpoint.angles = steered_;
  setpoint.wheels.resize(kinematics_.axleCount());
  return setpoint;
}

robot::SteeredSetpoint SteeredMotion::setpoint(const SteeredDrives& drives, const robot::WheelSpeeds& limits,
                                               bool braking) noexcept {
  const double part = robot::factorInto(kinematics_.wheels(limited_, drives.angles), limits);
  if (part != 1.0) {
    limited_ = robot::times(part, limited_);
    limiter_.reset(limited_);
  }
  const robot::WheelSpeeds wheels = kinematics_.wheels(limited_, drives.angles);
  if (!anyBelow(wheels, drives.minimum)) {
    drives_ = !robot::standsStill(wheels);
    return {steered_, wheels};
  }
  // On the way up the limiter goes on alone until every wheel is fast enough; on the way down it has arrived.
  below_minimum_ = below_minimum_ || !braking;
  if (drives_) limiter_.reset();
  return rest();
}

void SteeredMotion::handleMeasured(const robot::WheelSpeeds& wheels, const robot::SteeringAngles& angles,
                                   Duration dt) noexcept {
  odometry_.update(open_loop_ ? limited_ : kinematics_.twist(wheels, angles), dt);
}

}  // namespace nord_driver::cycle
