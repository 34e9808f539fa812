// What kind of thing a device path names, as far as its timing goes.
#pragma once

#include <cstdint>
#include <string>

namespace nord_driver::link {

/// True for a pty, by the number of the device (`stat::st_rdev`): it moves bytes without any time of its own; no rate, no
/// parity, no pauses to be seen.
bool isPtyNumber(std::uint64_t device_number) noexcept;

/// True for a UART of the board itself, whose bytes reach the driver within a few characters. False for USB adapters
/// (which hold bytes back), ptys, and a device that is not there yet.
bool isNativeUart(const std::string& device) noexcept;

}  // namespace nord_driver::link
