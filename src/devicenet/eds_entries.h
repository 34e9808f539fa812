// The entries of a DeviceNet EDS file: which section, which key, which fields, in which line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devicenet/eds_file.h"

namespace nord_driver::devicenet {

struct EdsField {
  std::size_t line = 0;  ///< where it begins, or where the comma behind it stands when it is empty
  std::string text;      ///< without white space and quotes around it
};

struct EdsEntry {
  std::string section;  ///< lower case, without brackets
  std::string key;      ///< lower case; empty: the section itself, which begins here
  std::size_t line = 0;
  std::vector<EdsField> fields;
};

/// In the order of the file.
std::vector<EdsEntry> splitEds(const std::string& text, std::vector<EdsProblem>& problems);

/// Decimal, or hexadecimal with 0x. Nothing when it is no number of at most 32 bits.
std::optional<std::uint32_t> edsNumber(const std::string& text);

}  // namespace nord_driver::devicenet
