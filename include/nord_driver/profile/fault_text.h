// The inverter's fault numbers in words: those the bus can cause (BU 0020 8.1, BU 2700 8.3).
#pragma once

#include <cstdint>
#include <string>

namespace nord_driver::profile {

/// The fault is there, but its number could not be read.
constexpr std::uint16_t kFaultNumberUnknown = 65535;

/// What a value of P700 or P701 means; the raw value is the printed number times ten (102 = "10.2").
const char* faultText(std::uint16_t raw) noexcept;

/// "E10.2", as the inverter's display groups it; "no fault" and "fault of unknown number" for 0 and 65535.
std::string faultName(std::uint16_t raw);

}  // namespace nord_driver::profile
