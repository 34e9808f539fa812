// The serial number this computer tells in the duplicate-MAC check when none is configured.
#pragma once

#include <cstdint>
#include <string>

namespace nord_driver {

/// The same for a text at all times; never 0.
std::uint32_t serialNumberOf(const std::string& identity) noexcept;
/// Of /etc/machine-id; without one of the computer's name.
std::uint32_t machineSerialNumber();

}  // namespace nord_driver
