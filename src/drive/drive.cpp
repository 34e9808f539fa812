#include "drive/drive.h"

#include <cmath>
#include <cstdlib>

namespace nord_driver::drive {

using profile::Command;
using profile::DriveState;
using profile::StatusWord;

namespace {

// |IW1| from which its sign is held against the direction bits: 5 % of P105. Below it bit 11 is 1 at rest
// (BU 2700 6.6.1: 0B31) and slip may turn the sign.
constexpr int kClearlyTurning = 819;

bool contradictsDirection(StatusWord status, std::int16_t actual_value) noexcept {
  if (std::abs(int{actual_value}) < kClearlyTurning) return false;
  if (status.directionRight() == status.directionLeft()) return false;
  return status.directionRight() != (actual_value > 0);
}

// Why "operation enabled" was left without being asked, as far as the status word tells (BU 2700 6.4.2 bits 4 and 5).
StopCause exitCause(StatusWord status) noexcept {
  if (!status.voltageEnabled()) return StopCause::kOff2;  // the command of the higher priority (BU 2700 6.4.1)
  if (!status.quickStopInactive()) return StopCause::kOff3;
  return StopCause::kUnaskedExit;
}

}  // namespace

Drive::Drive(const DriveConfig& config)
    : config_(config), edge_(config.acknowledge_time), missing_(config.drive_timeout) {
  if (config.position) axis_.emplace(*config.position);
  for (std::size_t i = 0; i < sets_.size(); ++i) sets_[i].max_frequency = config.max_frequency[i];
}

bool Drive::isRunning() const noexcept {
  return isEnabled(report_.phase) || report_.phase == Phase::kEnabling || report_.phase == Phase::kHoldingZero;
}

bool Drive::isAtRest() const noexcept {
  if (report_.phase == Phase::kOffline) return true;
  if (report_.phase != Phase::kIdle || isSettingUp()) return false;
  switch (report_.state) {
    case DriveState::kReadyToSwitchOn:
    case DriveState::kSwitchOnDisabled:
    case DriveState::kNotReadyToSwitchOn:
    case DriveState::kFault:
      return true;
    default:
      return false;
  }
}

void Drive::enter(Phase phase, Instant now, RadPerSec wanted) noexcept {
  report_.phase = phase;
  phase_ = PhaseData{};
  phase_.since = now;
  phase_.wanted = wanted;
  const bool offline = phase == Phase::kOffline;
  if (axis_ && axis_->isHoming()) {
    axis_->endHoming();
    end(report_.homing, offline ? Refusal::kOffline : Refusal::kHomingStopped);
  }
  if (!isSettingUp()) return;
  endSetup(offline ? Refusal::kOffline : Refusal::kTeachStopped, offline ? Refusal::kOffline : Refusal::kResetStopped);
}

void Drive::latch(StopCause cause) noexcept {
  if (report_.stop_cause != StopCause::kNone) return;
  report_.stop_cause = cause;
  report_.stop_status_word = report_.status_word;
}

void Drive::stop(StopCause cause, Instant now) noexcept {
  latch(cause);
  if (report_.phase == Phase::kEnabling) refuse(Refusal::kStopped);
  enter(Phase::kIdle, now);
}

void Drive::refuse(Refusal refusal) noexcept {
  report_.refusal = refusal;
}

// --- what the inverter says ------------------------------------------------------------------------------------------

void Drive::handleInput(const profile::ProcessInput& input, bool fresh, Instant now) noexcept {
  if (fresh && StatusWord(input.status_word).isUseful()) {
    handleUseful(input, now);
  } else {
    handleSilence(now);
  }
  measure(fresh);
}

void Drive::handleModule(bool inverter_missing, Instant now) noexcept {
  if (inverter_missing) missing_.handle(last_useful_, now);
}

void Drive::handleUseful(const profile::ProcessInput& input, Instant now) noexcept {
  const StatusWord status(input.status_word);
  const bool joined = report_.phase == Phase::kOffline;
  last_useful_ = now;
  report_.online = true;
  report_.input = input;
  report_.status_word = input.status_word;
  report_.state = status.state();
  report_.parameter_set = status.parameterSet();
  learnSet(status, joined);
  if (joined) enter(phaseOnReturn(now), now);
  if (axis_) handlePosition(now);
  checkStops(status, now);
  follow(status, now);
  if (axis_) followHoming(now);
  if (isSettingUp()) followSetup(now);
}

void Drive::learnSet(StatusWord status, bool joined) noexcept {
  if (joined || !status.busControl()) report_.commanded_set = status.parameterSet();
}

void Drive::handleSilence(Instant now) noexcept {
  if (report_.phase == Phase::kOffline || now - last_useful_ <= config_.drive_timeout) return;
  goOffline(StopCause::kSilent, now);
}

void Drive::handleInterruption(StopCause cause, Instant now) noexcept {
  if (report_.phase != Phase::kOffline) goOffline(cause, now);
}

void Drive::goOffline(StopCause cause, Instant now) noexcept {
  unanswered_ = UnansweredWord{};
  breakOff(Refusal::kOffline);
  if (!isAtRest() && report_.phase != Phase::kSwitchingSet) {
    // It may hear us without being heard: with 0000 it would carry on at its last setpoint, or trip by its time-out.
    unanswered_ = {isRunning() ? Command::kShutdown : command(now), true, now + config_.shutdown_timeout};
    if (report_.phase != Phase::kIdle && report_.phase != Phase::kAcknowledging) latch(cause);
  }
  const bool was_enabling = report_.phase == Phase::kEnabling;
  enter(Phase::kOffline, now);
  report_.online = false;
  report_.state = DriveState::kUnknown;
  report_.parameter_set = 0;
  if (axis_) axis_->handleGap();
  if (was_enabling) refuse(Refusal::kOffline);
}

void Drive::checkStops(StatusWord status, Instant now) noexcept {
  if (config_.onlooker) report_.fault_latched = false;
  if (status.fault()) {
    // A fault can vanish without us: dropping the enable acknowledges it, P506 and terminals do (BU 0020 8). So every
    // fault seen is kept.
    report_.fault_latched = true;
    const bool stopping = report_.phase == Phase::kStopping || report_.phase == Phase::kQuickStopping ||
                          report_.phase == Phase::kCoasting;
    if (isRunning() || stopping) stop(StopCause::kFault, now);
    return;
  }
  if (!isRunning()) return;
  if (!status.busControl()) {
    stop(StopCause::kLocalControl, now);
  } else if (status.parameterSet() != report_.commanded_set) {
    // Setpoint 1 is a share of P105 of the set in force: a set that changes by itself is a step of the speed
    // (BU 0020 7.3.5).
    stop(StopCause::kParameterSet, now);
  } else if ((report_.phase == Phase::kEnabled || report_.phase == Phase::kHoldingZero) &&
             report_.state != DriveState::kOperationEnabled) {
    stop(exitCause(status), now);
  } else if (parameterRefusal() != Refusal::kNone) {
    stop(StopCause::kUnsuitable, now);
  }
}

void Drive::follow(StatusWord status, Instant now) noexcept {
  switch (report_.phase) {
    case Phase::kIdle:
      return followIdle(status, now);
    case Phase::kEnabling:
      return followEnabling(status, now);
    case Phase::kResting:
      return followResting(status, now);
    case Phase::kResuming:
      return followResuming(status, now);
    case Phase::kStopping:
      return followStopping(report_.state, now);
    case Phase::kQuickStopping:
    case Phase::kCoasting:
      return followOff2OrOff3(report_.state, now);
    case Phase::kAcknowledging:
      return followAcknowledging(status, now);
    case Phase::kSwitchingSet:
      return followSwitchingSet(status, now);
    default:
      return;
  }
}

// OFF1 is no latch here either: nothing but "ready to switch on" shows that it has ended.
void Drive::followResting(StatusWord status, Instant now) noexcept {
  const bool ramps_down = report_.state == DriveState::kOperationEnabled;
  const bool expected =
      ramps_down || report_.state == DriveState::kSwitchedOn || report_.state == DriveState::kReadyToSwitchOn;
  if (!expected) return stop(exitCause(status), now);
  phase_.ready_seen = phase_.sent && report_.state == DriveState::kReadyToSwitchOn;
  if (!ramps_down) phase_.since = now;
  boundRamp(now);
}

void Drive::followResuming(StatusWord status, Instant now) noexcept {
  switch (report_.state) {
    case DriveState::kOperationEnabled:
      return enter(Phase::kEnabled, now, phase_.wanted);
    case DriveState::kReadyToSwitchOn:
    case DriveState::kSwitchedOn:
      if (now - phase_.since >= config_.enable_timeout) stop(StopCause::kNotResumed, now);
      return;
    default:
      return stop(exitCause(status), now);
  }
}

// Idle commands OFF1 as well, to a drive that stopped for a reason of its own or was found turning: a ramp that does
// not end is escalated as in kStopping. Without bus control no word is evaluated, and the time has not begun.
void Drive::followIdle(StatusWord status, Instant now) noexcept {
  const bool ramps_down = phase_.sent && status.busControl() && report_.state == DriveState::kOperationEnabled;
  if (!ramps_down || config_.onlooker) phase_.since = now;
  boundRamp(now);
}

void Drive::boundRamp(Instant now) noexcept {
  if (now - phase_.since < config_.shutdown_timeout) return;
  latch(StopCause::kShutdownTimeout);
  enter(Phase::kQuickStopping, now);
}

void Drive::followEnabling(StatusWord status, Instant now) noexcept {
  const DriveState state = report_.state;
  if (phase_.ready_seen && state == DriveState::kOperationEnabled) return enter(Phase::kEnabled, now);
  if (phase_.ready_seen && state != DriveState::kReadyToSwitchOn && state != DriveState::kSwitchedOn) {
    // Back behind "ready" without being asked, by terminals for example: an enable sequence never repeats itself.
    return stop(exitCause(status), now);
  }
  // Only once 047E went out: bits 0 and 3 come after an answered "shut down", never in place of one.
  const bool where_known = !axis_ || axis_->isCertain();
  if (phase_.sent && where_known && state == DriveState::kReadyToSwitchOn) {
    // With P104 > 0 it would turn as soon as it is "operation enabled": that waits for the first velocity.
    if (restsAtZero()) return enter(Phase::kResting, now);
    phase_.ready_seen = true;
  }
  if (now - phase_.since < config_.enable_timeout) return;
  refuse(Refusal::kEnableTimeout);
  // Once 047F was sent it may still come to act: leave as from "enabled", with OFF1 until "ready to switch on" is seen.
  enter(phase_.ready_seen ? Phase::kStopping : Phase::kIdle, now);
}

void Drive::followStopping(DriveState state, Instant now) noexcept {
  // OFF1 is no latch: bits 0 and 3 set again during the ramp would run the motor up. So nothing ends it but the state.
  const bool ended = state == DriveState::kReadyToSwitchOn || state == DriveState::kSwitchOnDisabled ||
                     state == DriveState::kNotReadyToSwitchOn;
  if (phase_.sent && ended) return enter(Phase::kIdle, now);
  boundRamp(now);
}

void Drive::followOff2OrOff3(DriveState state, Instant now) noexcept {
  // OFF3 ends in "switch-on disabled" by itself at f = 0 (BU 2700 6.4.1 bit 2), or at once from "ready" (6.4.3 no. 7).
  const bool ended = state == DriveState::kSwitchOnDisabled || state == DriveState::kNotReadyToSwitchOn ||
                     (!config_.has_quick_stop && state == DriveState::kReadyToSwitchOn);
  if (phase_.sent && ended) enter(Phase::kIdle, now);
}

void Drive::followAcknowledging(StatusWord status, Instant now) noexcept {
  edge_.handleAnswer();
  if (!status.fault()) {
    // The bit is dropped as soon as the fault is gone: left at 1, no further edge could follow (BU 2700 6.4.1 bit 7).
    report_.fault_latched = false;
    end(report_.acknowledge, Refusal::kNone);
    enter(Phase::kIdle, now);
  } else if (edge_.ended(now)) {
    breakOff(Refusal::kCauseStands);
    enter(Phase::kIdle, now);
  }
}

void Drive::followSwitchingSet(StatusWord status, Instant now) noexcept {
  if (phase_.sent && status.parameterSet() == report_.commanded_set && status.busControl() && !status.fault()) {
    end(report_.set_switch, Refusal::kNone);
  } else if (status.fault()) {
    breakOff(Refusal::kFault);
  } else if (!status.busControl()) {
    breakOff(Refusal::kLocalControl);
  } else if (now - phase_.since >= config_.enable_timeout) {
    breakOff(Refusal::kSetNotConfirmed);
  } else {
    return;
  }
  enter(Phase::kIdle, now);
}

void Drive::tellSet() noexcept {
  const ParameterSet* const set = parameterSet(report_.commanded_set);
  report_.minimum_frequency = set != nullptr ? set->min_frequency : Hertz{};
  report_.unexpected_function = set != nullptr ? set->unexpected_function : std::nullopt;
}

// A word in revolutions per minute from before its transport knew P105 is 0, whatever the speed was: it does not begin
// to count when P105 comes.
void Drive::measure(bool fresh) noexcept {
  tellSet();
  const auto maximum = maxFrequency(report_.parameter_set);
  report_.scaled = report_.online && maximum.has_value() && (fresh || report_.scaled);
  report_.speed = speedWord();
  report_.frequency = {};
  report_.velocity = {};
  if (report_.scaled) {
    report_.frequency = profile::fromActualValue1(report_.speed, *maximum);
    report_.velocity = profile::toRadPerSec(report_.frequency, config_.joint);
    if (axis_) report_.velocity.value *= axis_->config().unit_per_radian;
  }
  report_.direction_contradiction =
      config_.check_direction && report_.online && contradictsDirection(StatusWord(report_.status_word), report_.speed);
  if (axis_) measurePosition();
}

// --- what goes to the inverter ---------------------------------------------------------------------------------------

Command Drive::command(Instant now) const noexcept {
  switch (report_.phase) {
    case Phase::kOffline:
      if (report_.commanded_set == 0) return Command::kIgnored;
      if (unanswered_.due || now < unanswered_.until) return unanswered_.command;
      return missing_.isCertain(now) ? Command::kShutdown : Command::kIgnored;
    case Phase::kEnabling:
      return phase_.ready_seen ? Command::kEnableOperation : Command::kShutdown;
    case Phase::kEnabled:
    case Phase::kHoldingZero:
    case Phase::kResuming:
      return Command::kEnableOperation;
    case Phase::kQuickStopping:
      return Command::kQuickStop;
    case Phase::kCoasting:
      return Command::kDisableVoltage;
    case Phase::kIdle:
    case Phase::kAcknowledging:
    case Phase::kSwitchingSet:
    case Phase::kStopping:
    case Phase::kResting:
      break;
  }
  return Command::kShutdown;
}

// The setpoint goes out with 047F from the first word on: at setpoint 0 the motor would turn to the right meanwhile.
void Drive::restOrResume(const profile::Setpoint& setpoint, Instant now) noexcept {
  const bool running = report_.phase == Phase::kEnabled || report_.phase == Phase::kResuming;
  if (running && restsAtZero() && setpoint.word == 0) {
    enter(Phase::kResting, now, phase_.wanted);
  } else if (report_.phase == Phase::kResting && phase_.ready_seen && setpoint.word != 0) {
    enter(Phase::kResuming, now, phase_.wanted);
  }
}

profile::ProcessOutput Drive::pollOutput(Instant now) noexcept {
  profile::ProcessOutput output;
  report_.saturated = false;
  report_.velocity_command = {};
  if (axis_) {
    putPosition(output, now);
  } else if (isEnabled(report_.phase)) {
    // Enabled without P105 cannot be; were it so, the setpoint would be 0.
    const Hertz maximum = maxFrequency(report_.commanded_set).value_or(Hertz{});
    profile::Setpoint setpoint = profile::toSetpoint1(profile::toHertz(phase_.wanted, config_.joint), maximum);
    // One that is led does not hear this setpoint: its inverter turns both ways, as its leader's says.
    if (!config_.reverses && !config_.led && setpoint.word < 0) setpoint = {0, true, false};
    restOrResume(setpoint, now);
    if (report_.phase != Phase::kResting) output.setpoints[0] = setpoint.word;
    const double frequency = std::fabs(profile::fromActualValue1(setpoint.word, maximum).value);
    const bool below = setpoint.word != 0 && frequency < report_.minimum_frequency.value;
    report_.saturated = setpoint.saturated || below;
    report_.command_invalid = setpoint.invalid;
    report_.velocity_command =
        profile::toRadPerSec(profile::fromActualValue1(output.setpoints[0], maximum), config_.joint);
  }
  const Command word = command(now);
  unanswered_.due = false;
  if (word != Command::kIgnored) output.control_word = profile::controlWord(word, report_.commanded_set);
  if (report_.phase == Phase::kAcknowledging && edge_.poll(now)) {
    output.control_word |= profile::control_bit::kAcknowledge;
  }
  report_.output = output;
  phase_.sent = true;
  return output;
}

}  // namespace nord_driver::drive
