// The parameters of one drive against its state: what its presence, its loss and its states make of them.
#include "cycle/drive_parameters.h"

namespace nord_driver::cycle {

namespace {

constexpr Duration kReasonInterval = std::chrono::milliseconds{500};

}  // namespace

void DriveParameters::handleState(drive::Drive& drive, Instant now) noexcept {
  const drive::DriveReport& report = drive.report();
  if (!report.online) return handleLoss(drive);
  const profile::StatusWord status{report.status_word};
  bus_control_ = status.busControl();
  parameter_set_ = report.parameter_set;
  faults_.handleStatus(status);
  history_.handleFault(status.fault(), faults_.lastNumber(), faults_.awaitsNumber());
  askForReason(drive, now);
  if (scale_due_ && !writesProcessData()) scale(drive);
  scale_due_ = false;
  drive.setParametersAwaited(awaitsMotion());
}

void DriveParameters::handleLoss(drive::Drive& drive) noexcept {
  scale_due_ = false;
  held_since_.reset();
  drive.setSwitchOnReason(std::nullopt);
  open_ids_ = {};
  faults_.handleOffline();
  reader_.handleOffline();
  session_.handleOffline();
  history_.handleOffline();
  monitor_.handleOffline();
  elements_.forget();
  collect();
  // Another inverter may come back in its place: nothing is enabled with what P105 was before.
  forgetScale(drive);
  drive.setParametersAwaited(awaitsMotion());
}

void DriveParameters::forgetScale(drive::Drive& drive) noexcept {
  for (std::uint8_t set = 1; set <= 4; ++set) {
    drive.setMaxFrequency(set, Hertz{});
    drive.setMinimumFrequency(set, Hertz{});
    drive.setUnexpectedFunction(set, std::nullopt);
    drive.setPositionWords(set, {});
  }
  drive.setUnexpectedSource(std::nullopt);
}

// A write was checked when it was asked for: carried out later, it must not meet a motor under load.
bool DriveParameters::awaitsMotion() const noexcept {
  return !channel_.users_only && (!reader_.motionKnown() || writesMotion());
}

// An idle drive that 047E does not lead to "ready to switch on" has a reason; it is known before anybody asks for it.
void DriveParameters::askForReason(drive::Drive& drive, Instant now) noexcept {
  const drive::DriveReport& report = drive.report();
  const bool waiting = report.phase == drive::Phase::kIdle || report.phase == drive::Phase::kEnabling;
  const bool held = waiting && (report.state == profile::DriveState::kSwitchOnDisabled ||
                                report.state == profile::DriveState::kNotReadyToSwitchOn);
  // While it is read again, the one known before stands.
  if (!held || faults_.reasonState() != drive::ReasonState::kReading) {
    const bool known = held && faults_.reasonState() == drive::ReasonState::kKnown && faults_.reason() != 0;
    drive.setSwitchOnReason(known ? std::optional<std::uint16_t>{faults_.reason()} : std::nullopt);
  }
  if (!held) {
    held_since_.reset();
    faults_.forgetReason();
  } else if (!held_since_) {
    held_since_ = now;
  } else if (now - *held_since_ >= kReasonInterval) {
    held_since_ = now;
    faults_.requestReason();
  }
}

}  // namespace nord_driver::cycle
