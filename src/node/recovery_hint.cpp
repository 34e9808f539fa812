#include "node/recovery_hint.h"

#include "profile/status_word.h"

namespace nord_driver::node {

namespace {

bool isLocal(const cycle::DriveSnapshot& drive) noexcept {
  const profile::StatusWord status{drive.input.status_word};
  return status.isUseful() && !status.busControl();
}

// Bits 4 and 5 may also follow a stop of ours for a moment: only who was stopped by its terminals, or stays held, counts.
const char* stopAtTerminals(const cycle::DriveSnapshot& drive) noexcept {
  const profile::StatusWord status{drive.input.status_word};
  const bool by_terminals = drive.terminals == cycle::TerminalFinding::kHeld ||
                            drive.stop_cause == drive::StopCause::kOff2 || drive.stop_cause == drive::StopCause::kOff3;
  if (!by_terminals || !status.isUseful()) return nullptr;
  if (!status.voltageEnabled()) return "OFF2";
  return status.quickStopInactive() ? nullptr : "OFF3";
}

}  // namespace

std::string recoveryHint(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& drive_names) {
  if (!snapshot.connected) return "bring the bus back (see \"bus\"), then ~enable";
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    if (!snapshot.drives[i].online) {
      return "bring drive " + drive_names[i] + " back (see \"drive " + drive_names[i] + "\"), then ~enable";
    }
  }
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    if (snapshot.drives[i].fault_number == 0 && !snapshot.drives[i].fault_latched) continue;
    return "remove the cause (see \"drive " + drive_names[i] + "\"), then ~acknowledge_faults, then ~enable";
  }
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    if (!isLocal(snapshot.drives[i])) continue;
    return "give the bus control of drive " + drive_names[i] +
           " again (status bit 9: remote control input, P509), then ~enable";
  }
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    const char* const stop = stopAtTerminals(snapshot.drives[i]);
    if (stop == nullptr) continue;
    return std::string("release ") + stop + " at the terminals of drive " + drive_names[i] + ", then ~enable";
  }
  return "~enable";
}

}  // namespace nord_driver::node
