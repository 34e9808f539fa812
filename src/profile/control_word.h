// The control word (STW): its bits, the words that command an inverter, and the parameter set they all carry.
//
// Zero is no stop command: with bit 10 = 0 the inverter ignores the whole process data and, as delivered, runs on
// (BU 2700 6.4.1 note 2, 7.1.1).
#pragma once

#include <cassert>
#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::profile {

/// The bits of the control word (BU 2700 6.4.1, BU 0020 7.3.3).
namespace control_bit {
constexpr Word kOn = 1u << 0;               ///< 0: OFF1, down the brake ramp
constexpr Word kEnableVoltage = 1u << 1;    ///< 0: OFF2, output off at once, the motor coasts
constexpr Word kNoQuickStop = 1u << 2;      ///< 0: OFF3, down the quick stop ramp P426
constexpr Word kEnableOperation = 1u << 3;  ///< 0: output off
constexpr Word kEnableRamp = 1u << 4;       ///< 0: down the quick stop ramp, stays "operation enabled"
constexpr Word kRunRamp = 1u << 5;          ///< 0: holds the frequency, does not stop
constexpr Word kEnableSetpoint = 1u << 6;   ///< 0: setpoint 0 on the ramp
constexpr Word kAcknowledge = 1u << 7;      ///< 0 -> 1: acknowledges faults whose cause is gone
constexpr Word kBusBit8 = 1u << 8;          ///< P480 [-11]
constexpr Word kBusBit9 = 1u << 9;          ///< P480 [-12]
constexpr Word kDataValid = 1u << 10;       ///< 0: the process data are not evaluated
constexpr Word kRight = 1u << 11;           ///< beats bit 12; both 0 = right (BU 2700 6.4.1 note 3)
constexpr Word kLeft = 1u << 12;
}  // namespace control_bit

/// Parameter set 1..4 in bits 14 and 15, of the control word as of the status word.
constexpr std::uint8_t parameterSet(Word word) noexcept {
  return static_cast<std::uint8_t>((word >> 14) + 1u);
}

/// `word` with the given parameter set (1..4) in bits 14 and 15.
constexpr Word withParameterSet(Word word, std::uint8_t set) noexcept {
  assert(set >= 1 && set <= 4);
  return static_cast<Word>((word & 0x3FFFu) | static_cast<unsigned>((set - 1u) & 3u) << 14);
}

/// The words this driver commands with; their value is the control word with parameter set 1.
enum class Command : Word {
  kIgnored = 0x0000,          ///< bit 10 = 0: asks for a status word without commanding anything
  kShutdown = 0x047E,         ///< OFF1, and the idle word
  kEnableOperation = 0x047F,  ///< runs to setpoint 1 (BU 2700 6.6.2 prints 047E: the manual errs, BU 0020 9.2)
  kQuickStop = 0x047B,        ///< OFF3; bit 1 stays 1, without it this would be OFF2 (BU 2700 6.4.3 no. 11)
  kDisableVoltage = 0x047D,   ///< OFF2
};

/// The control word of a command to an inverter in the given parameter set (1..4). 047E alone also says "set 1".
/// The ignored word is 0000 in every set.
constexpr Word controlWord(Command command, std::uint8_t set) noexcept {
  return command == Command::kIgnored ? Word{0} : withParameterSet(static_cast<Word>(command), set);
}

}  // namespace nord_driver::profile
