// What a drive that positions does otherwise.
#include <algorithm>
#include <cmath>

#include "drive/drive.h"

namespace nord_driver::drive {

using profile::Command;
using profile::DriveState;
using profile::StatusWord;

namespace {

// P105 is not known yet: the most any of the series turns.
constexpr double kFastest = 400.0;  // Hz

}  // namespace

void Drive::setPositionWords(std::uint8_t set, const profile::PositionWords& words) noexcept {
  if (axis_) axis_->setWords(set, words);
}

void Drive::handlePosition(Instant now) noexcept {
  const double fastest = maxFrequency(report_.parameter_set).value_or(Hertz{kFastest}).value;
  axis_->handleInput(report_.input, report_.parameter_set, fastest / config_.joint.pole_pairs, now);
  // The drive would go where the old target is in the new count.
  const bool expected = axis_->isHoming();
  if (axis_->hasJumped() && !expected && isRunning()) stop(StopCause::kPositionJump, now);
  if (axis_->strays() && isRunning()) stop(StopCause::kStrayed, now);
}

std::int16_t Drive::speedWord() const noexcept {
  if (!axis_) return report_.input.actual_values[0];
  const auto& place = axis_->words(report_.parameter_set).speed_actual;
  if (place) return report_.input.actual_values[*place];
  const auto maximum = maxFrequency(report_.parameter_set);
  if (!maximum || !axis_->isKnown()) return 0;
  const double share = axis_->motorTurnsPerSecond() * config_.joint.pole_pairs / maximum->value;
  return static_cast<std::int16_t>(std::lround(std::clamp(share, -2.0, 1.999) * profile::kHundredPercent));
}

void Drive::measurePosition() noexcept {
  axis_->tell(report_.online, isEnabled(report_.phase), StatusWord(report_.status_word).setpointReached());
  report_.position = axis_->report();
}

// A count that just got its new zero may still be on its way through the reader.
void Drive::followHoming(Instant now) noexcept {
  if (!axis_->isHoming()) return;
  const StatusWord status(report_.status_word);
  report_.speed = speedWord();
  switch (axis_->handleHoming(status.setpointReached(), isNearStandstill(), now)) {
    case HomingRun::Outcome::kGoesOn:
      return;
    case HomingRun::Outcome::kDone:
      return end(report_.homing, Refusal::kNone);
    case HomingRun::Outcome::kTimedOut:
      end(report_.homing, Refusal::kHomingTimeout);
      latch(StopCause::kHomingTimeout);
      return enter(Phase::kStopping, now);
  }
}

void Drive::requestHoming(Instant now, std::uint32_t token) noexcept {
  if (!axis_ || axis_->isHoming()) return;
  report_.homing = {token, RequestState::kRunning, Refusal::kNone};
  if (report_.phase != Phase::kEnabled) return end(report_.homing, Refusal::kNotEnabled);
  // The end of the way it is on would look like the end of the run.
  if (!isNearStandstill()) return end(report_.homing, Refusal::kHomingTurning);
  axis_->startHoming(now);
}

Refusal Drive::setupRefusal() const noexcept {
  if (report_.phase == Phase::kOffline) return Refusal::kOffline;
  if (report_.phase == Phase::kAcknowledging || report_.phase == Phase::kSwitchingSet) return Refusal::kBusy;
  const StatusWord status(report_.status_word);
  if (status.fault()) return Refusal::kFault;
  if (!status.busControl()) return Refusal::kLocalControl;
  const bool disabled = report_.state == DriveState::kSwitchOnDisabled || report_.state == DriveState::kReadyToSwitchOn;
  if (report_.phase != Phase::kIdle || !disabled) return Refusal::kTeachNotDisabled;
  if (report_.parameter_set != report_.commanded_set) return Refusal::kParameterSet;
  if (!axis_->isCertain()) return Refusal::kPositionUnknown;
  return isNearStandstill() ? Refusal::kNone : Refusal::kTeachTurning;
}

void Drive::requestTeaching(Instant now, std::uint32_t token) noexcept {
  if (!axis_ || isSettingUp()) return;
  report_.teaching = {token, RequestState::kRunning, Refusal::kNone};
  const Refusal refusal = setupRefusal();
  if (refusal != Refusal::kNone) return end(report_.teaching, refusal);
  axis_->teaching().start(now, config_.acknowledge_time, config_.setup_timeout);
}

void Drive::requestPositionReset(Instant now, std::uint32_t token) noexcept {
  if (!axis_ || isSettingUp()) return;
  report_.resetting = {token, RequestState::kRunning, Refusal::kNone};
  const Refusal refusal = setupRefusal();
  if (refusal != Refusal::kNone) return end(report_.resetting, refusal);
  axis_->startReset(now, config_.acknowledge_time, config_.setup_timeout);
}

void Drive::endSetup(Refusal taught, Refusal reset) noexcept {
  if (axis_->teaching().isRunning()) end(report_.teaching, taught);
  if (axis_->resetting().isRunning()) end(report_.resetting, reset);
  axis_->teaching().end();
  axis_->resetting().end();
}

void Drive::followSetup(Instant now) noexcept {
  report_.speed = speedWord();
  // The count is getting its new zero: what it was is no longer certain.
  const bool resets = axis_->resetting().isRunning();
  const Refusal refusal = setupRefusal();
  const bool expected = resets && refusal == Refusal::kPositionUnknown;
  if (refusal != Refusal::kNone && !expected) return endSetup(refusal, refusal);
  if (resets && axis_->handleReset(now)) return end(report_.resetting, Refusal::kNone);
  if (!resets && axis_->teaching().handleAnswer(now)) end(report_.teaching, Refusal::kNone);
}

void Drive::setReferenced(std::optional<bool> referenced) noexcept {
  if (axis_) axis_->setReferenced(referenced);
}

Refusal Drive::positionRefusal() const noexcept {
  if (!axis_) return Refusal::kNone;
  if (!axis_->isCertain()) return Refusal::kPositionUnknown;
  return axis_->canHold(report_.commanded_set) ? Refusal::kNone : Refusal::kPositionBeyondRange;
}

// What is refused stands in the report at once.
TargetRefusal Drive::setPosition(double joint) noexcept {
  if (!axis_) return TargetRefusal::kNotEnabled;
  TargetRefusal refusal = TargetRefusal::kNotEnabled;
  if (report_.phase == Phase::kEnabled) {
    refusal = axis_->setTarget(joint);
  } else {
    axis_->refuse(refusal, joint);
  }
  report_.position = axis_->report();
  return refusal;
}

TargetRefusal Drive::movePosition(double increment) noexcept {
  const bool counts = axis_ && report_.phase == Phase::kEnabled;
  return setPosition(counts ? axis_->target() + increment : std::nan(""));
}

TargetRefusal Drive::setElement(std::uint8_t element, double joint) noexcept {
  if (!axis_ || report_.phase != Phase::kEnabled) return setPosition(joint);
  const TargetRefusal refusal = axis_->setElement(element, joint, report_.velocity.value);
  report_.position = axis_->report();
  return refusal;
}

// The speed goes out unsigned: which way it has to travel, the drive knows.
void Drive::putPosition(profile::ProcessOutput& output, Instant now) noexcept {
  if (axis_->teaching().isOverdue(now) || axis_->resetting().isOverdue(now)) {
    endSetup(Refusal::kTeachTimeout, Refusal::kResetTimeout);
  }
  const bool moves = report_.phase == Phase::kEnabled || (report_.phase == Phase::kEnabling && phase_.ready_seen);
  axis_->follow(moves);
  const profile::PositionWords& words = axis_->words(report_.commanded_set);
  if (moves && words.speed_setpoint) {
    const Hertz maximum = maxFrequency(report_.commanded_set).value_or(Hertz{});
    const Hertz wanted = axis_->config().speed ? profile::toHertz(*axis_->config().speed, config_.joint) : maximum;
    const profile::Setpoint speed = profile::toSetpoint1({std::fabs(wanted.value)}, maximum);
    output.setpoints[*words.speed_setpoint] = speed.word;
    report_.saturated = speed.saturated;
    const RadPerSec travelled = profile::toRadPerSec(profile::fromActualValue1(speed.word, maximum), config_.joint);
    report_.velocity_command = {std::fabs(travelled.value) * axis_->config().unit_per_radian};
  }
  axis_->put(output, report_.commanded_set);
  measurePosition();
}

}  // namespace nord_driver::drive
