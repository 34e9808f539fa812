// How the standard itself reads a status word, as a witness against the translation into NORD's bits.
#pragma once

#include "profile/status_word.h"

namespace nord_driver::profile {

/// The state that a status word of CiA 402 (6041h) or DRIVECOM 21 means by itself (CiA 402-2, "state coding").
inline DriveState stateOf(Word status_word) {
  switch (status_word & 0x4Fu) {
    case 0x00:
      return DriveState::kNotReadyToSwitchOn;
    case 0x40:
      return DriveState::kSwitchOnDisabled;
    case 0x0F:
      return DriveState::kFaultReactionActive;
    case 0x08:
      return DriveState::kFault;
    default:
      break;
  }
  switch (status_word & 0x6Fu) {
    case 0x21:
      return DriveState::kReadyToSwitchOn;
    case 0x23:
      return DriveState::kSwitchedOn;
    case 0x27:
      return DriveState::kOperationEnabled;
    case 0x07:
      return DriveState::kQuickStopActive;
    default:
      return DriveState::kUnknown;
  }
}

}  // namespace nord_driver::profile
