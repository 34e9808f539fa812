#include "trace/trace_feed.h"

namespace nord_driver::trace {

namespace {

/// True for a stop nobody asked for.
bool unasked(drive::StopCause cause) noexcept {
  switch (cause) {
    case drive::StopCause::kNone:
    case drive::StopCause::kQuickStop:
    case drive::StopCause::kCoast:           // the way of a stop, asked for or with a cause of its own
    case drive::StopCause::kCommandTimeout:  // whoever ends the commands wants the stop that is configured for that
      return false;
    default:
      return true;
  }
}

bool isCommand(Word control, profile::Command command) noexcept {
  constexpr Word kCommandBits = 0x000F;
  return (control & kCommandBits) == (static_cast<Word>(command) & kCommandBits);
}

bool turns(profile::DriveState state) noexcept {
  return state == profile::DriveState::kOperationEnabled || state == profile::DriveState::kQuickStopActive;
}

/// Remembers `now` and tells whether it has just become true.
bool rises(bool& before, bool now) noexcept {
  const bool rose = now && !before;
  before = now;
  return rose;
}

}  // namespace

TraceFeed::TraceFeed(std::size_t drive_count) : history_(drive_count), drives_(drive_count) {}

void TraceFeed::handleCycle(const std::vector<profile::ProcessOutput>& outputs,
                            const std::vector<DriveExchange>& inputs, const cycle::CycleSnapshot& snapshot) noexcept {
  TraceTrigger trigger;
  trigger.time = snapshot.time;
  trigger.cycle = history_.cycles();
  history_.record(outputs, inputs, snapshot.time);
  for (DriveIndex i = 0; i < drives_.size(); ++i) handleDrive(i, snapshot.drives[i], trigger);
  if (rises(base_stopped_, unasked(snapshot.base.stop_cause))) {
    trigger.kind = TraceTrigger::Kind::kStop;
    trigger.drive = cycle::kAllDrives;
    trigger.status_word = 0;
    trigger.text = snapshot.base.text;
    triggers_.push(trigger);
  }
}

void TraceFeed::handleDrive(DriveIndex drive, const cycle::DriveSnapshot& snapshot, TraceTrigger& trigger) noexcept {
  Seen& seen = drives_[drive];
  const bool faulted = snapshot.faults != seen.faults;
  seen.faults = snapshot.faults;
  const bool stopped = rises(seen.stopped, unasked(snapshot.stop_cause));
  const bool fell_out = fallsOut(seen, snapshot);
  if (!faulted && !stopped && !fell_out) return;
  trigger.kind = faulted ? TraceTrigger::Kind::kFault : TraceTrigger::Kind::kStop;
  trigger.drive = drive;
  trigger.status_word = snapshot.input.status_word;
  trigger.text = snapshot.text;
  triggers_.push(trigger);
}

// The stop of commands that ended stays the cause, whatever comes upon it on the way down.
bool TraceFeed::fallsOut(Seen& seen, const cycle::DriveSnapshot& snapshot) noexcept {
  const bool heeds = snapshot.online && profile::StatusWord{snapshot.input.status_word}.busControl();
  const Word control = snapshot.output.control_word;
  const bool off1_broken = seen.off1 && (isCommand(control, profile::Command::kQuickStop) ||
                                         snapshot.state == profile::DriveState::kSwitchOnDisabled);
  const bool out = seen.turned && (!heeds || off1_broken);
  seen.turned = heeds && turns(snapshot.state);
  seen.off1 = isCommand(control, profile::Command::kShutdown);
  return out && snapshot.stop_cause == drive::StopCause::kCommandTimeout;
}

}  // namespace nord_driver::trace
