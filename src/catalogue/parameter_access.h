// What a user writes to name a parameter and its value, made into a request to a transport.
#pragma once

#include <cstdint>
#include <string>

#include "catalogue/drive_catalogue.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::catalogue {

struct ParameterAddress {
  std::uint16_t number = 0;        ///< the manual's: 105 for P105
  std::uint8_t parameter_set = 0;  ///< 1..4; 0: the set in force where the parameter depends on it
  std::uint8_t index = 0;          ///< the manual's array index, [-01] = 1; 0: no array
};

struct ParameterWrite {
  double value = 0.0;       ///< in the parameter's unit; raw where that is not known
  bool persistent = false;  ///< EEPROM; otherwise RAM, lost at power off
  bool allow_raw = false;   ///< parameters whose unit is not known may be written
};

struct ParameterAccess {
  profile::ParameterRequest request;      ///< to read, until one of the functions below makes it one to write
  const ParameterEntry* entry = nullptr;  ///< what the catalogue knows; nullptr: nothing
  std::string error;                      ///< what is wrong with the address, a sentence; empty when nothing is
};

ParameterAccess accessTo(const ParameterAddress& address, const DriveCatalogue& known);

// Each makes it an access to write and returns what is wrong, a sentence; empty when nothing is. What can only be read
// and what resets a device is refused, whatever the value.

/// Why a value of this parameter means nothing, "P426: its unit is not known": it is not in the catalogue, or a quantity of
/// unknown unit. Empty when it has a meaning.
std::string whyUnitUnknown(const ParameterAccess& access);
/// The same for where raw values are not allowed, with what allows them.
std::string whyNotRaw(const ParameterAccess& access);
/// A value finer than the resolution is refused, not rounded: 0.1 could become 0.
std::string setValue(ParameterAccess& access, const ParameterWrite& write);
/// What somebody typed, as rawFrom() takes it; of parameters in the catalogue only.
std::string setText(ParameterAccess& access, const std::string& text, bool persistent);
/// As transferred; allowed where the catalogue knows nothing, too.
std::string setRaw(ParameterAccess& access, std::int64_t raw, bool persistent);

/// The value behind a raw one, in the parameter's unit; the raw one itself where `entry` is nullptr.
double valueOf(const ParameterEntry* entry, std::int32_t raw, unsigned index);

/// "Maximum frequency", "Process data bus in, Setpoint 1"; empty where `entry` is nullptr.
std::string fullName(const ParameterEntry* entry, unsigned index);

/// What was read or written, for a user: "P102 = 0.60 s"; of one nobody describes "P799 = 5 (raw)".
std::string valueSentence(const ParameterAccess& access, std::int32_t raw, const DriveCatalogue& known);

}  // namespace nord_driver::catalogue
