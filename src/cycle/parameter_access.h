// What a user writes to name a parameter and its value, made into a request to the cycle, and the answer's value.
#pragma once

#include <cstdint>
#include <string>

#include "cycle/request.h"
#include "nord_driver/profile/series.h"
#include "profile/parameter_catalogue.h"

namespace nord_driver::cycle {

struct ParameterAddress {
  std::uint16_t number = 0;        ///< the manual's: 105 for P105
  std::uint8_t parameter_set = 0;  ///< 1..4; 0: the set in force where the parameter depends on it
  std::uint8_t index = 0;          ///< the manual's array index, [-01] = 1; 0: no array
};

struct ParameterWrite {
  double value = 0.0;       ///< in the parameter's unit; raw where it is not in the catalogue
  bool persistent = false;  ///< EEPROM; otherwise RAM, lost at power off
  bool allow_raw = false;   ///< parameters that are not in the catalogue may be written
};

/// A request to read; `info` is what the catalogue knows (nullptr: nothing). Returns what is wrong with the address in
/// a sentence; empty when nothing is.
std::string addressParameter(const ParameterAddress& address, profile::Series series, Request& request,
                             const profile::ParameterInfo*& info);

/// Makes it a request to write. Returns what is wrong with the value; empty when nothing is.
std::string addValue(const ParameterWrite& write, const profile::ParameterInfo* info, Request& request);

/// The value behind a raw one; the raw one itself where the catalogue knows nothing.
double valueOf(const profile::ParameterInfo* info, std::int32_t raw);

}  // namespace nord_driver::cycle
