// The parameters of a drive as a file: written, read again, and compared.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "tools/drive_parameters.h"

namespace nord_driver::tools {

/// Every value the drive has of what the catalogue knows. What resets a device is left out.
struct Dump {
  struct Value {
    catalogue::ParameterAddress address;
    std::int32_t raw = 0;
  };
  profile::Series series = profile::Series::kSk5xxe;
  std::vector<Value> values;
  std::vector<catalogue::ParameterAddress>
      missing;  ///< known of the series, but not in this inverter; whole or in part
};

/// Throws Trouble when the drive stops answering, or `end_asked`.
Dump takeDump(DriveParameters& drive, const std::atomic<bool>& end_asked);

/// As YAML; `drive` and `address` are named for people, and so is what is `known` of the values.
std::string dumpText(const Dump& dump, const catalogue::DriveCatalogue& known, const std::string& drive,
                     const std::string& address);
/// The other way round. Throws UsageError naming the file and what was expected, also where it has not as many values as it
/// says: it was cut off.
Dump readDump(const std::string& file);
/// The same of a text; `name`: what a refusal calls it.
Dump dumpFrom(const std::string& text, const std::string& name);

}  // namespace nord_driver::tools
