// One file of parameters, read and checked by itself. What its keys mean: doc/parameter_files.md.
#pragma once

#include <string>
#include <vector>

#include "catalogue/device.h"
#include "catalogue/parameter_entry.h"

namespace nord_driver::catalogue {

struct ParameterFile {
  std::vector<Device> devices;
  /// As the file has them: an entry that corrects another one may lack what it leaves as it is.
  std::vector<ParameterEntry> entries;
};

/// Throws ConfigError on an unknown key, a value of another kind, a number that stands twice, a range upside down: one
/// sentence with file, line, key, value and what was expected.
ParameterFile readParameterFile(const std::string& file);

/// `devices: [sk5xxe, module_profibus]` of a file; empty when it is absent. Throws ConfigError for an unknown one.
std::vector<Device> readDevices(YamlMap& map);

}  // namespace nord_driver::catalogue
