// CANopen emergency (EMCY) error codes of NORD inverters, in words.
//
// Several faults share one code and some codes differ between the CANopen and the EtherCAT option: the exact number is
// that of P700, which the driver reads whenever the status word shows a fault.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nord_driver::profile {

struct EmergencyInfo {
  std::uint16_t code;  ///< bytes 0 and 1 of the message, low byte first (CiA 301 7.2.7)
  const char* faults;  ///< the inverter's numbers it can stand for: "E2.0, E2.1"; empty when no manual says
  const char* text;    ///< a clause: "overcurrent (I2t limit)"
};

struct EmergencyTable {
  const EmergencyInfo* rows;  ///< in ascending order of their codes
  std::size_t size;
  const EmergencyInfo* begin() const noexcept { return rows; }
  const EmergencyInfo* end() const noexcept { return rows + size; }
};
EmergencyTable emergencyTable() noexcept;

/// The row of a code; nullptr when no manual lists it.
const EmergencyInfo* findEmergency(std::uint16_t code) noexcept;

/// A clause for any code: that of its row, or of its class in CiA 301 7.2.7.1.
const char* emergencyText(std::uint16_t code) noexcept;
/// The inverter's fault numbers of a code, "E2.0, E2.1"; empty when unknown.
const char* emergencyFaults(std::uint16_t code) noexcept;

}  // namespace nord_driver::profile
