// What is wrong, or doubtful, in the parameters of a drive, and what would be right.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "commissioning/facts.h"

namespace nord_driver::commissioning {

enum class Severity : std::uint8_t {
  kError,    ///< it cannot work, or moves or runs on when it must not
  kWarning,  ///< it works, but not as one expects, or not in every case
  kNote,     ///< chosen, or perhaps meant; to be known
};

/// "error", "warning", "note".
const char* toString(Severity severity) noexcept;

/// A value that would be right.
struct Remedy {
  std::int32_t raw = 0;
  std::string text;  ///< with unit and name: "4 PROFIBUS"
};

struct Finding {
  std::string rule;  ///< "bus_has_control"
  Severity severity = Severity::kWarning;
  std::string drive;                ///< as the configuration calls it
  ParameterKey key;                 ///< number 0: no single parameter
  std::string parameter;            ///< "P509 Source control word", "P105 set 1 Maximum frequency"
  std::optional<std::int32_t> raw;  ///< as it is; nothing where it could not be read
  std::string value;                ///< with unit and name: "0 Control terminals or keyboard"
  std::string why;                  ///< why it matters; a clause
  std::optional<Remedy> remedy;     ///< the value to set, where one can be named
  std::string advice;               ///< what to do where none can; a clause, may be empty
  std::string source;               ///< manual, chapter and page
  bool selects_bus = false;         ///< to write it changes who controls the drive
};

/// "P509 Source control word = 0 Control terminals or keyboard: WHY; set it to 4 PROFIBUS (BU 0020, 6.2.2, p. 63)".
std::string toText(const Finding& finding);

}  // namespace nord_driver::commissioning
