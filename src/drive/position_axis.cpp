#include "drive/position_axis.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::drive {

namespace {

const profile::PositionWords kNoWords{};

// The nearest target its words can have. Without one there would be 0 in them, which is a target as well.
std::int64_t nearestTarget(double joint, const profile::PositionScale& scale, const profile::PositionField& field) {
  const double steps_per_revolution = profile::stepsPerRevolution(scale, field);
  const double steps = (joint - scale.offset) * scale.revolutions_per_unit * steps_per_revolution;
  if (field.bits == 16) return std::llround(std::clamp(steps, -32'768.0, 32'767.0));
  const double most = profile::kMaxRevolutions * steps_per_revolution;
  return std::llround(std::clamp(steps, -most, most));
}

}  // namespace

const char* toString(TargetRefusal refusal) noexcept {
  switch (refusal) {
    case TargetRefusal::kNone:
      return "nothing";
    case TargetRefusal::kNotFinite:
      return "it is not a number, or infinite";
    case TargetRefusal::kNotEnabled:
      return "the drive is not enabled, and a target is not kept for later";
    case TargetRefusal::kHoming:
      return "a reference run is under way";
    case TargetRefusal::kElementsOnly:
      return "the drive goes to the elements of its array only (position/targets: array)";
    case TargetRefusal::kBelowLimit:
      return "it is below the joint's lower limit";
    case TargetRefusal::kAboveLimit:
      return "it is above the joint's upper limit";
    case TargetRefusal::kBeyondRange:
      return "it is beyond what the drive, or the words that carry it, can have";
  }
  return "";
}

void PositionAxis::setWords(std::uint8_t set, const profile::PositionWords& words) noexcept {
  if (set < 1 || set > words_.size()) return;
  profile::PositionWords& known = words_[set - 1u];
  // Other words than before: what was read from them may be something else.
  if (set == set_ && !(known.actual == words.actual)) reader_.handleGap();
  known = words;
}

const profile::PositionWords& PositionAxis::words(std::uint8_t set) const noexcept {
  return set >= 1 && set <= words_.size() ? words_[set - 1u] : kNoWords;
}

void PositionAxis::handleInput(const profile::ProcessInput& input, std::uint8_t set, double max_speed,
                               Instant now) noexcept {
  if (set != set_) reader_.handleGap();
  set_ = set;
  const double steps =
      max_speed * config_.revolutions_per_motor_turn * profile::stepsPerRevolution(config_.scale, field());
  reader_.handleValues(field(), input.actual_values, steps, now);
  // What a run found is a place in the count before. The new zero of a run under way comes before its end.
  if (reader_.hasJumped()) homed_ = false;
}

void PositionAxis::handleGap() noexcept {
  reader_.handleGap();
  homing_.end();
  homed_ = false;
  has_target_ = false;
  element_ = 0;
  path_.forget();
}

bool PositionAxis::canHold(std::uint8_t set) const noexcept {
  const profile::PositionWords& at = words(set);
  if (!reader_.isKnown() || set != set_) return false;
  if (config_.by_element) return true;
  // Where no word carries a target, none is in its range.
  const auto target =
      profile::toSteps(profile::toJoint(reader_.steps(), config_.scale, at.actual), config_.scale, at.setpoint);
  return target.has_value();
}

// A count that is set anew is no speed.
double PositionAxis::motorTurnsPerSecond() const noexcept {
  if (resetting_.isRunning()) return 0.0;
  return reader_.speed() / profile::stepsPerRevolution(config_.scale, field()) / config_.revolutions_per_motor_turn;
}

void PositionAxis::follow(bool moves) noexcept {
  const bool freeze = moves && !homing_.isRunning();
  if (!freeze || !frozen_) hold();
  frozen_ = freeze;
}

void PositionAxis::startHoming(Instant now) noexcept {
  homed_ = false;
  const Duration window = words(set_).speed_actual ? Duration{0} : reader_.speedWindow();
  homing_.start(now, config_.homing_timeout, window);
}

void PositionAxis::endHoming() noexcept {
  homing_.end();
}

HomingRun::Outcome PositionAxis::handleHoming(bool reached, bool still, Instant now) noexcept {
  const HomingRun::Outcome outcome = homing_.handleView({reached, still, reader_.isHeldBack(), referenced_}, now);
  if (outcome == HomingRun::Outcome::kDone) {
    homed_ = true;
    reader_.handleNewZero(field());
    // From here on it is held, and a target that comes before the next word goes out is one.
    hold();
    frozen_ = true;
  }
  return outcome;
}

void PositionAxis::startReset(Instant now, Duration hold, Duration timeout) noexcept {
  homed_ = false;
  resetting_.start(now, hold, timeout);
}

// A count of 16 bits is what its word is: the turns it was continued by are over with the new zero.
bool PositionAxis::isReset() const noexcept {
  if (!isCertain()) return false;
  const std::int64_t steps =
      field().bits == 16 ? static_cast<std::int16_t>(static_cast<std::uint64_t>(reader_.steps())) : reader_.steps();
  const double wanted = config_.scale.offset + config_.reset_to / config_.scale.revolutions_per_unit;
  return std::fabs(profile::toJoint(steps, config_.scale, field()) - wanted) <= config_.tolerance;
}

bool PositionAxis::handleReset(Instant now) noexcept {
  if (!resetting_.handleAnswer(isReset(), now)) return false;
  reader_.handleNewZero(field());
  return true;
}

// canHold() has kept it from being enabled beyond its words; it may have sagged over their border since.
void PositionAxis::hold() noexcept {
  element_ = 0;
  asked_ = false;
  const profile::PositionWords& at = words(set_);
  if (!reader_.isKnown() || (!at.setpoint.carried() && !config_.by_element)) return;
  wanted_ = profile::toJoint(reader_.steps(), config_.scale, at.actual);
  path_.hold(wanted_);
  target_ = nearestTarget(wanted_, config_.scale, at.setpoint);
  has_target_ = true;
}

bool PositionAxis::strays() const noexcept {
  if (!frozen_ || !reader_.isKnown() || (asked_ && !config_.by_element)) return false;
  return path_.isLeft(profile::toJoint(reader_.steps(), config_.scale, field()), config_.stray);
}

void PositionAxis::refuse(TargetRefusal refusal, double joint) noexcept {
  report_.refused = refusal;
  report_.refused_target = joint;
}

std::optional<std::int32_t> PositionAxis::stepsOf(double joint) const noexcept {
  const profile::PositionField& carried = words(set_).setpoint;
  if (carried.carried()) return profile::toSteps(joint, config_.scale, carried);
  return profile::toSteps(joint, profile::arrayScale(config_.scale), profile::kArrayField);
}

TargetRefusal PositionAxis::refusalOf(double joint) const noexcept {
  if (!std::isfinite(joint)) return TargetRefusal::kNotFinite;
  if (config_.lower && joint < *config_.lower) return TargetRefusal::kBelowLimit;
  if (config_.upper && joint > *config_.upper) return TargetRefusal::kAboveLimit;
  if (!stepsOf(joint)) return TargetRefusal::kBeyondRange;
  return homing_.isRunning() ? TargetRefusal::kHoming : TargetRefusal::kNone;
}

TargetRefusal PositionAxis::setTarget(double joint) noexcept {
  refuse(refusalOf(joint), joint);
  if (config_.by_element) refuse(TargetRefusal::kElementsOnly, joint);
  if (report_.refused != TargetRefusal::kNone) return report_.refused;
  wanted_ = joint;
  target_ = *stepsOf(joint);
  has_target_ = true;
  asked_ = true;
  return report_.refused;
}

// What its ramp takes to turn it round is not known here (P103): a second at this speed, a ramp of two seconds.
TargetRefusal PositionAxis::setElement(std::uint8_t element, double joint, double speed) noexcept {
  if (!config_.by_element) return setTarget(joint);
  refuse(refusalOf(joint), joint);
  if (report_.refused != TargetRefusal::kNone) return report_.refused;
  path_.goTo(profile::toJoint(reader_.steps(), config_.scale, field()), joint, speed);
  wanted_ = joint;
  target_ = *stepsOf(joint);
  has_target_ = true;
  element_ = element;
  return report_.refused;
}

void PositionAxis::put(profile::ProcessOutput& output, std::uint8_t set) noexcept {
  if (!has_target_) return;
  profile::putPosition(words(set).setpoint, static_cast<std::int32_t>(target_), output.setpoints);
}

double PositionAxis::toldTarget() const noexcept {
  const profile::PositionField& carried = words(set_).setpoint;
  return carried.carried() ? profile::toJoint(target_, config_.scale, carried) : wanted_;
}

bool PositionAxis::isAtLimit(double joint) const noexcept {
  return (config_.lower && joint <= *config_.lower + config_.tolerance) ||
         (config_.upper && joint >= *config_.upper - config_.tolerance);
}

void PositionAxis::tell(bool online, bool enabled, bool reached) noexcept {
  const profile::PositionField& at = field();
  const bool known = online && reader_.isKnown();
  report_.position.reset();
  report_.target.reset();
  report_.homing = homing_.isRunning();
  report_.teach = teaching_.bits();
  report_.reset = resetting_.bit();
  report_.homed = online && referenced_.value_or(homed_);
  report_.held_back = known && reader_.isHeldBack();
  if (known) {
    report_.position = profile::toJoint(reader_.steps(), config_.scale, at);
  }
  report_.element = enabled ? element_ : std::uint8_t{0};
  if (enabled && has_target_) report_.target = toldTarget();
  report_.reached = reached && known && !homing_.isRunning() && report_.target.has_value() &&
                    std::fabs(*report_.position - *report_.target) <= config_.tolerance;
  report_.following =
      (asked_ || element_ != 0) && known && !homing_.isRunning() && report_.target.has_value() && !report_.reached;
  report_.at_limit = known && isAtLimit(*report_.position);
  // From there on it has to stay.
  if (report_.reached) path_.hold(*report_.target);
}

}  // namespace nord_driver::drive
