#include "profile/status_word.h"

namespace nord_driver::profile {

namespace {

struct StateRow {
  Word mask;
  Word value;
  DriveState state;
};

// BU 2700 6.4.3, "Decoded frequency inverter statuses": X in the table is 0 in the mask. Bit 4 (voltage enabled) is
// left out everywhere: the other bits tell the states apart, and it only mirrors the OFF2 command.
constexpr StateRow kStates[] = {
    //  6543210     6543210
    {0b1001111, 0b0000000, DriveState::kNotReadyToSwitchOn},   // 0 X X 0 0 0 0
    {0b1001111, 0b1000000, DriveState::kSwitchOnDisabled},     // 1 X X 0 0 0 0
    {0b1101111, 0b0100001, DriveState::kReadyToSwitchOn},      // 0 1 1 0 0 0 1
    {0b1101111, 0b0100011, DriveState::kSwitchedOn},           // 0 1 1 0 0 1 1
    {0b1101111, 0b0100111, DriveState::kOperationEnabled},     // 0 1 1 0 1 1 1
    {0b1001111, 0b0001000, DriveState::kFault},                // 0 X X 1 0 0 0
    {0b1001111, 0b0001111, DriveState::kFaultReactionActive},  // 0 X X 1 1 1 1
    {0b1101111, 0b0000111, DriveState::kQuickStopActive},      // 0 0 1 0 1 1 1
};

}  // namespace

DriveState StatusWord::state() const noexcept {
  for (const StateRow& row : kStates) {
    if ((word_ & row.mask) == row.value) return row.state;
  }
  return DriveState::kUnknown;
}

const char* toString(DriveState state) noexcept {
  switch (state) {
    case DriveState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case DriveState::kSwitchOnDisabled:
      return "switch-on disabled";
    case DriveState::kReadyToSwitchOn:
      return "ready to switch on";
    case DriveState::kSwitchedOn:
      return "switched on";
    case DriveState::kOperationEnabled:
      return "operation enabled";
    case DriveState::kQuickStopActive:
      return "quick stop active";
    case DriveState::kFaultReactionActive:
      return "fault reaction active";
    case DriveState::kFault:
      return "fault";
    case DriveState::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace nord_driver::profile
