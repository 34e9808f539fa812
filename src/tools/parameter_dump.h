// The parameters of a drive as a file: written, read again, and compared.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "tools/parameter_link.h"

namespace nord_driver::tools {

/// Every value the inverter has of what the catalogue knows. What can only be written is not in the catalogue, and what
/// resets the inverter is left out.
struct Dump {
  struct Value {
    cycle::ParameterAddress address;
    std::int32_t raw = 0;
  };
  profile::Series series = profile::Series::kSk5xxe;
  std::vector<Value> values;
  std::vector<cycle::ParameterAddress> missing;  ///< known of the series, but not in this inverter; whole or in part
};

/// Throws Trouble when the drive stops answering, or `end_asked`.
Dump takeDump(ParameterLink& link, const std::atomic<bool>& end_asked);

/// As YAML; `drive` and `address` are named for people.
std::string dumpText(const Dump& dump, const std::string& drive, const std::string& address);
/// The other way round. Throws UsageError naming the file and what was expected.
Dump readDump(const std::string& file);

struct Comparison {
  std::vector<std::string> differences;  ///< one sentence each
  std::size_t compared = 0;
};

/// Reads from the drive what `dump` has of settings; information changes by itself. Throws Trouble, and UsageError
/// when the dump is of another series: its numbers mean something else.
Comparison compare(ParameterLink& link, const Dump& dump, const std::atomic<bool>& end_asked);

/// "50 Hz", "7" where there is no unit.
std::string valueText(const profile::ParameterInfo* info, std::int32_t raw);

}  // namespace nord_driver::tools
