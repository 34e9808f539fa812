// Values of parameters as people read and write them: "P509 = 4 PROFIBUS", "10.00 s", "PROFIBUS".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "catalogue/parameter_entry.h"

namespace nord_driver::catalogue {

/// "P509", "P740[-01]"; "object 6042h", "object 6046h:1" from 2000h on. `index` 1.. is used for arrays.
std::string label(const ParameterEntry& entry, unsigned index = 1);

/// A raw value, whatever stands beyond its size, in words: "4 PROFIBUS", "10.00 s", "-0.1 s No error", "047Eh",
/// "0202h: Bus status operational, FI 1 online". A value that another issue of the manual names otherwise says so.
std::string valueText(const ParameterEntry& entry, std::int32_t raw, unsigned index = 1);

/// "P509 = 4 PROFIBUS".
std::string assignment(const ParameterEntry& entry, std::int32_t raw, unsigned index = 1);

/// A raw value, or one sentence on why there is none.
struct RawValue {
  std::optional<std::int32_t> raw;
  std::string error;
};

/// The raw value of what somebody typed: a value in the parameter's unit ("10.5", "10.5 s"), a raw one ("047Eh",
/// "0x047E"), a name ("PROFIBUS", in any case), or both as valueText() prints them ("4 PROFIBUS"). Refused with a sentence:
/// a name that several numbers have or that issues of the manual give to different numbers; a value finer than the
/// resolution; one beyond the range that has no name.
RawValue rawFrom(const ParameterEntry& entry, const std::string& text, unsigned index = 1);

/// Whether so many steps of the resolution are a raw value, but for the rest of a division.
bool isWholeStep(double steps);
/// Why a value finer than the resolution is refused.
std::string notWhole(const ParameterEntry& entry, const std::string& text, unsigned index);

/// Why nobody may write the parameter; empty when it may be written.
std::string whyNotWritable(const ParameterEntry& entry);

/// How it is accessed: "array of 3, sets 1 to 4, read only"; "perhaps sets 1 to 4" where no manual says,
/// "unit not known". May be empty.
std::string kindText(const ParameterEntry& entry);

/// The resolution with the unit: "0.01 s".
std::string stepText(const ParameterEntry& entry);

/// What may be written, for sentences and help: "0 to 10" or "-0.1 to 100 s".
std::string rangeText(const ParameterEntry& entry, unsigned index = 1);

}  // namespace nord_driver::catalogue
