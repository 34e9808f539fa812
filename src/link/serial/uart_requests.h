// The ioctls of a UART, with the kernel's structures kept to themselves: <asm/termbits.h> and <termios.h> exclude each
// other.
#pragma once

#include "link/serial/serial_system.h"

namespace nord_driver::link::uart {

int setLine(int descriptor, BaudRate rate) noexcept;
int readLine(int descriptor, LineState& state) noexcept;
int setRs485(int descriptor, const Rs485Settings& settings) noexcept;
int readRs485(int descriptor, Rs485Settings& settings) noexcept;
int requestLowLatency(int descriptor) noexcept;
int readCounters(int descriptor, RawLineCounters& counters) noexcept;
int flushInput(int descriptor) noexcept;
int flushOutput(int descriptor) noexcept;

}  // namespace nord_driver::link::uart
