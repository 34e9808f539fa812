// What is asked of an opened serial line, and what it must have taken.
#pragma once

#include "link/serial/serial_system.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

enum class LineDemand : std::uint8_t {
  kExact,  ///< a UART: the rate it really does and 8E1 are read back
  kNone,   ///< a pty: takes every rate and reads parity back as off
};

/// 8E1 at the wanted rate. False: `reason` names what was wanted and what the line does.
bool setUpLine(SerialSystem& system, int descriptor, BaudRate rate, LineDemand demand, Sentence& reason) noexcept;

/// RS-485 by the kernel, when it is wanted. False: `reason`.
bool setUpRs485(SerialSystem& system, int descriptor, const Rs485Settings& wanted, Sentence& reason) noexcept;

/// Asks for received bytes without delay. What stays slow is no failure: `warning` says so.
void setUpLatency(SerialSystem& system, int descriptor, const char* device, Sentence& warning) noexcept;

}  // namespace nord_driver::link
