#include "profile/state_machine.h"

namespace nord_driver::profile {

namespace {

using S = DriveState;

constexpr Word kOff2Mask = 0b010;  // X X 0 X
constexpr Word kOff3Mask = 0b110;  // X 0 1 X
constexpr Word kOff3 = 0b010;
constexpr Word kShutdownMask = 0b111;  // X 1 1 0
constexpr Word kShutdown = 0b110;

// Number, from, to: BU 2700 6.4.3. The order of rows with the same `from` is the priority of BU 2700 6.4.1: disable
// voltage, quick stop, shut down, enable operation, switch on, disable operation.
constexpr Transition kRows[] = {
    // clang-format off
    { 1, S::kNotReadyToSwitchOn,  S::kSwitchOnDisabled,    0, 0, "the charging relay closes"},
    { 2, S::kSwitchOnDisabled,    S::kReadyToSwitchOn,     kShutdownMask, kShutdown, "shut down"},
    { 7, S::kReadyToSwitchOn,     S::kSwitchOnDisabled,    kOff2Mask, 0, "disable voltage"},
    { 7, S::kReadyToSwitchOn,     S::kSwitchOnDisabled,    kOff3Mask, kOff3, "quick stop"},
    { 3, S::kReadyToSwitchOn,     S::kSwitchedOn,          0b111, 0b111, "switch on"},
    {10, S::kSwitchedOn,          S::kSwitchOnDisabled,    kOff2Mask, 0, "disable voltage"},
    {10, S::kSwitchedOn,          S::kSwitchOnDisabled,    kOff3Mask, kOff3, "quick stop"},
    { 6, S::kSwitchedOn,          S::kReadyToSwitchOn,     kShutdownMask, kShutdown, "shut down"},
    { 4, S::kSwitchedOn,          S::kOperationEnabled,    0b1111111, 0b1111111, "enable operation"},
    { 9, S::kOperationEnabled,    S::kSwitchOnDisabled,    kOff2Mask, 0, "disable voltage"},
    {11, S::kOperationEnabled,    S::kQuickStopActive,     kOff3Mask, kOff3, "quick stop"},
    { 8, S::kOperationEnabled,    S::kReadyToSwitchOn,     kShutdownMask, kShutdown, "shut down"},
    // The bit table of BU 0020 7.3.3 says "ready to switch on" here; the transition table is the more exact one.
    { 5, S::kOperationEnabled,    S::kSwitchedOn,          0b1111, 0b0111, "disable operation"},
    {12, S::kQuickStopActive,     S::kSwitchOnDisabled,    kOff2Mask, 0, "disable voltage"},
    {13, S::kUnknown,             S::kFaultReactionActive, 0, 0, "a fault occurs"},
    {14, S::kFaultReactionActive, S::kFault,               0, 0, "the reaction to the fault ends"},
    {15, S::kFault,               S::kSwitchOnDisabled,    control_bit::kAcknowledge, control_bit::kAcknowledge, "acknowledge fault"},
    // clang-format on
};

}  // namespace

TransitionTable transitions() noexcept {
  return {kRows, sizeof(kRows) / sizeof(kRows[0])};
}

const Transition* transitionFor(DriveState state, Word now, Word before) noexcept {
  if ((now & control_bit::kDataValid) == 0) return nullptr;
  for (const Transition& row : kRows) {
    if (row.from != state || row.mask == 0 || (now & row.mask) != row.value) continue;
    if (state == DriveState::kFault && (before & control_bit::kAcknowledge) != 0) continue;  // 15 is the edge 0 -> 1
    return &row;
  }
  return nullptr;
}

}  // namespace nord_driver::profile
