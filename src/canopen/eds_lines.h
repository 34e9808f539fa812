// The lines of an EDS file: sections of keys and values, and the numbers among the values.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "canopen/eds_file.h"

namespace nord_driver::canopen {

struct EdsValue {
  std::size_t line = 0;
  std::string text;  ///< without white space around it; may be empty
};

struct EdsSection {
  std::size_t line = 0;
  std::map<std::string, EdsValue> values;  ///< by key, lower case

  /// Nothing when the key is missing or has no value: files have many such keys.
  const EdsValue* find(const std::string& key) const noexcept;
};

/// By name, lower case.
using EdsSections = std::map<std::string, EdsSection>;

/// Comments are lines that begin with a semicolon. Of two equal keys the first holds.
EdsSections splitEds(const std::string& text, std::vector<EdsProblem>& problems);

/// Hexadecimal with 0x, octal with a leading 0, else decimal; a sign; "$NODEID" on one side of a plus. What follows a
/// semicolon is no part of it. Nothing when it is no number of at most 64 bits.
std::optional<EdsNumber> edsNumber(const std::string& text);

}  // namespace nord_driver::canopen
