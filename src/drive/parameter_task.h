// One access to a parameter as a user means it: read it, or have it changed for now or for good.
#pragma once

#include <cstdint>

#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::drive {

enum class ParameterTaskKind : std::uint8_t {
  kRead,
  kWriteRam,         ///< lost at power off
  kWritePersistent,  ///< costs one of the EEPROM's 100 000 cycles (BU 2700 6.5), unless the value is there already
};

struct ParameterTask {
  std::uint32_t id = 0;  ///< chosen by the asker, comes back in the result
  ParameterTaskKind kind = ParameterTaskKind::kRead;
  std::uint16_t number = 0;  ///< the manual's: 102 for P102
  profile::ParameterShape shape = profile::ParameterShape::kPlain;
  std::uint8_t set = 1;      ///< 1..4, where the shape has sets
  std::uint8_t index = 1;    ///< the manual's, [-01] = 1, where the shape is an array
  bool double_word = false;  ///< 32 bit value (writes only)
  std::int32_t raw = 0;      ///< value to write
  /// kWritePersistent: also when the inverter has the value already. It may have it in its RAM only, from somebody this
  /// session does not know of.
  bool even_if_same = false;
};

struct ParameterTaskResult {
  std::uint32_t id = 0;
  /// kRefused without refused_number: the session itself refused, the note says why.
  profile::ParameterOutcome outcome = profile::ParameterOutcome::kTimeout;
  std::uint16_t error_number = 0;    ///< see parameter_error.h, when refused_number is set
  std::uint32_t abort_code = 0;      ///< CANopen: the SDO abort code behind error_number; 0: none
  std::uint16_t refused_number = 0;  ///< the parameter that error is about: the task's own, or P560; 0: none
  std::int32_t raw = 0;              ///< the value read, or read back
  bool eeprom_written = false;       ///< this task cost EEPROM cycles, or may have
  const char* note = "";             ///< a clause for the user; empty when there is nothing to add
};

}  // namespace nord_driver::drive
