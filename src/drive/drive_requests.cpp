// What users may ask of a drive, and why it says no.
#include <cmath>
#include <cstdlib>

#include "drive/drive.h"

namespace nord_driver::drive {

using profile::Command;
using profile::DriveState;
using profile::StatusWord;

namespace {

bool isPositive(Hertz frequency) noexcept {
  return std::isfinite(frequency.value) && frequency.value > 0.0;
}

}  // namespace

Refusal Drive::enableRefusal() const noexcept {
  switch (report_.phase) {
    case Phase::kOffline:
      return Refusal::kOffline;
    case Phase::kEnabling:
    case Phase::kEnabled:
    case Phase::kResting:
    case Phase::kResuming:
      return Refusal::kNone;
    case Phase::kHoldingZero:
    case Phase::kStopping:
    case Phase::kQuickStopping:
    case Phase::kCoasting:
      return Refusal::kStopping;
    case Phase::kAcknowledging:
    case Phase::kSwitchingSet:
      return Refusal::kBusy;
    case Phase::kIdle:
      break;
  }
  if (isSettingUp()) return Refusal::kBusy;
  const StatusWord status(report_.status_word);
  if (status.fault()) return Refusal::kFault;
  if (report_.unexpected_source) return Refusal::kUnexpectedSource;
  if (!status.busControl()) return Refusal::kLocalControl;
  if (report_.fault_latched) return Refusal::kFaultLatched;
  const bool startable = report_.state == DriveState::kSwitchOnDisabled ||
                         report_.state == DriveState::kReadyToSwitchOn || report_.state == DriveState::kSwitchedOn;
  if (!startable) return Refusal::kWrongState;
  if (report_.parameter_set != report_.commanded_set) return Refusal::kParameterSet;
  if (parameters_awaited_) return Refusal::kParametersAwaited;
  if (!maxFrequency(report_.commanded_set).has_value()) return Refusal::kMaxFrequencyUnknown;
  const Refusal unsuitable = parameterRefusal();
  return unsuitable == Refusal::kNone ? positionRefusal() : unsuitable;
}

Refusal Drive::parameterRefusal() const noexcept {
  if (report_.unexpected_source) return Refusal::kUnexpectedSource;
  if (report_.unexpected_function) return Refusal::kUnexpectedFunction;
  const bool turns_at_zero = report_.minimum_frequency.value > 0.0;
  return turns_at_zero && !config_.allow_minimum_frequency ? Refusal::kMinimumFrequency : Refusal::kNone;
}

void Drive::requestEnable(Instant now) noexcept {
  refuse(enableRefusal());
  if (report_.refusal != Refusal::kNone || isRunning()) return;
  report_.stop_cause = StopCause::kNone;
  report_.command_invalid = false;
  enter(Phase::kEnabling, now);
}

void Drive::requestSetpointZero(Instant now) noexcept {
  if (report_.phase == Phase::kEnabling) return requestShutdown(now);
  if (!isEnabled(report_.phase)) return;
  // With P104 > 0 setpoint 0 is no rest, nor of a drive that positions, nor of one that does not hear it.
  if (axis_ || config_.led || restsAtZero() || report_.phase != Phase::kEnabled) return requestShutdown(now);
  enter(Phase::kHoldingZero, now);
}

void Drive::requestShutdown(Instant now, StopCause cause) noexcept {
  if (isSettingUp()) endSetup(Refusal::kTeachStopped, Refusal::kResetStopped);
  if (!isRunning()) return;
  latch(cause);
  if (report_.phase == Phase::kEnabling) refuse(Refusal::kStopped);
  enter(Phase::kStopping, now);
}

void Drive::requestQuickStop(Instant now, StopCause cause) noexcept {
  if (report_.phase == Phase::kEnabling) refuse(Refusal::kStopped);
  breakOff(Refusal::kRequestStopped);
  latch(cause);
  if (report_.phase == Phase::kOffline) {
    unanswered_ = {Command::kQuickStop, true, now + config_.shutdown_timeout};
  } else if (report_.phase != Phase::kQuickStopping && report_.phase != Phase::kCoasting) {
    enter(Phase::kQuickStopping, now);
  }
}

void Drive::requestCoast(Instant now, StopCause cause) noexcept {
  if (report_.phase == Phase::kEnabling) refuse(Refusal::kStopped);
  breakOff(Refusal::kRequestStopped);
  latch(cause);
  if (report_.phase == Phase::kOffline) {
    unanswered_ = {Command::kDisableVoltage, true, now + config_.shutdown_timeout};
  } else if (report_.phase != Phase::kCoasting) {
    enter(Phase::kCoasting, now);
  }
}

// A quick stop, or OFF2, that was not heard is still to be carried out. For an ordinary stop "idle" commands the same.
Phase Drive::phaseOnReturn(Instant now) const noexcept {
  const bool may_turn = report_.state == DriveState::kOperationEnabled || report_.state == DriveState::kQuickStopActive;
  if (!may_turn || !stopsUnheard(now)) return Phase::kIdle;
  if (unanswered_.command == Command::kQuickStop) return Phase::kQuickStopping;
  return unanswered_.command == Command::kDisableVoltage ? Phase::kCoasting : Phase::kIdle;
}

void Drive::end(RequestReport& request, Refusal refusal) noexcept {
  request.state = refusal == Refusal::kNone ? RequestState::kDone : RequestState::kRefused;
  request.refusal = refusal;
}

// Ends a request that takes its time, if one runs, without success.
void Drive::breakOff(Refusal why) noexcept {
  if (report_.phase == Phase::kAcknowledging) {
    end(report_.acknowledge, why);
    refuse(why);
  } else if (report_.phase == Phase::kSwitchingSet) {
    end(report_.set_switch, why);
    refuse(why);
    report_.commanded_set = report_.parameter_set;
  }
}

void Drive::requestAcknowledge(Instant now, std::uint32_t token) noexcept {
  if (report_.phase == Phase::kAcknowledging) return;
  refuse(Refusal::kNone);
  // A drive without a fault has nothing to wait for, and must not spoil the answer for the others of its base.
  const bool healthy = !report_.fault_latched && !StatusWord(report_.status_word).fault();
  if (report_.phase == Phase::kOffline) refuse(Refusal::kOffline);
  if (report_.phase != Phase::kOffline && report_.phase != Phase::kIdle && !healthy) refuse(Refusal::kBusy);
  report_.acknowledge = {token, RequestState::kRunning, Refusal::kNone};
  if (report_.refusal != Refusal::kNone) return end(report_.acknowledge, report_.refusal);
  if (!StatusWord(report_.status_word).fault()) {
    report_.fault_latched = false;
    return end(report_.acknowledge, Refusal::kNone);
  }
  edge_.start();
  enter(Phase::kAcknowledging, now);
}

bool Drive::isNearStandstill() const noexcept {
  return report_.online && std::abs(int{report_.speed}) <= config_.near_standstill;
}

Refusal Drive::setRefusal(std::uint8_t set) const noexcept {
  if (set < 1 || set > 4) return Refusal::kNoSuchSet;
  if (set > config_.parameter_sets) return Refusal::kOnlySet1;
  if (report_.phase == Phase::kOffline) return Refusal::kOffline;
  if (report_.phase == Phase::kAcknowledging || report_.phase == Phase::kSwitchingSet) return Refusal::kBusy;
  if (isSettingUp()) return Refusal::kBusy;
  if (report_.phase != Phase::kIdle) return Refusal::kNotDisabled;
  const StatusWord status(report_.status_word);
  if (status.fault()) return Refusal::kFault;
  if (!status.busControl()) return Refusal::kLocalControl;
  if (!isNearStandstill()) return Refusal::kTurning;
  const bool switchable =
      report_.state == DriveState::kSwitchOnDisabled || report_.state == DriveState::kReadyToSwitchOn;
  return switchable ? Refusal::kNone : Refusal::kWrongState;
}

void Drive::requestParameterSet(std::uint8_t set, Instant now, std::uint32_t token) noexcept {
  const Refusal refusal = setRefusal(set);
  refuse(refusal);
  if (report_.phase == Phase::kSwitchingSet) return;  // it goes on: its outcome is not this one's
  report_.set_switch = {token, RequestState::kRunning, Refusal::kNone};
  if (refusal != Refusal::kNone) return end(report_.set_switch, refusal);
  enter(Phase::kSwitchingSet, now);
  report_.commanded_set = set;
}

void Drive::setVelocity(RadPerSec joint) noexcept {
  if (isEnabled(report_.phase)) phase_.wanted = joint;
}

const Drive::ParameterSet* Drive::parameterSet(std::uint8_t set) const noexcept {
  return set >= 1 && set <= sets_.size() ? &sets_[set - 1u] : nullptr;
}

Drive::ParameterSet* Drive::parameterSet(std::uint8_t set) noexcept {
  return set >= 1 && set <= sets_.size() ? &sets_[set - 1u] : nullptr;
}

void Drive::setMaxFrequency(std::uint8_t set, Hertz frequency) noexcept {
  if (ParameterSet* const known = parameterSet(set)) {
    known->max_frequency = isPositive(frequency) ? std::optional<Hertz>(frequency) : std::nullopt;
  }
}

std::optional<Hertz> Drive::maxFrequency(std::uint8_t set) const noexcept {
  const ParameterSet* const known = parameterSet(set);
  return known != nullptr ? known->max_frequency : std::nullopt;
}

void Drive::setMinimumFrequency(std::uint8_t set, Hertz frequency) noexcept {
  if (ParameterSet* const known = parameterSet(set)) known->min_frequency = isPositive(frequency) ? frequency : Hertz{};
  tellSet();
}

void Drive::setUnexpectedFunction(std::uint8_t set, const std::optional<UnexpectedFunction>& function) noexcept {
  if (ParameterSet* const known = parameterSet(set)) known->unexpected_function = function;
  tellSet();
}

RadPerSec Drive::minVelocity() const noexcept {
  return RadPerSec{std::fabs(profile::toRadPerSec(report_.minimum_frequency, config_.joint).value)};
}

double Drive::onlyDirection() const noexcept {
  if (config_.reverses) return 0.0;
  return config_.joint.inverted ? -1.0 : 1.0;
}

std::optional<RadPerSec> Drive::maxVelocity() const noexcept {
  const auto maximum = maxFrequency(report_.commanded_set);
  if (!maximum.has_value()) return std::nullopt;
  return RadPerSec{std::fabs(profile::toRadPerSec(*maximum, config_.joint).value)};
}

}  // namespace nord_driver::drive
