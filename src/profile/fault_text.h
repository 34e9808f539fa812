// The inverter's fault numbers in words, for any number: what fault_table.h does not list is said to be unknown.
#pragma once

#include <cstdint>
#include <string>

namespace nord_driver::profile {

/// The fault is there, but its number could not be read.
constexpr std::uint16_t kFaultNumberUnknown = 65535;

/// The name of a fault by its value of P700 or P701, which is the printed number times ten (102 = "10.2"); "no fault"
/// for 0.
const char* faultText(std::uint16_t raw) noexcept;
/// What probably led to it; empty for 0.
const char* faultCause(std::uint16_t raw) noexcept;
/// What to look at; empty for 0.
const char* faultRemedy(std::uint16_t raw) noexcept;

/// "E10.2", as the inverter's display groups it; "no fault" and "fault of unknown number" for 0 and 65535.
std::string faultName(std::uint16_t raw);

}  // namespace nord_driver::profile
