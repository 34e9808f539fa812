// The parameters of every device, from the files of the project and those a user lays over them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "catalogue/catalogue_file.h"
#include "catalogue/device.h"
#include "catalogue/parameter_entry.h"

namespace nord_driver::catalogue {

/// What somebody asked for, or one sentence on why it is not there.
struct Lookup {
  const ParameterEntry* entry = nullptr;
  std::string error;
};

/// By what somebody typed: "509", "P509", "0x6042", or the name in any case. `whose`: of which device the entries are,
/// in sentences.
Lookup lookIn(const std::vector<const ParameterEntry*>& entries, const std::string& text, const std::string& whose);

class Catalogue {
 public:
  /// In this order: an entry of a later file corrects one of an earlier file key by key, or adds one. Throws ConfigError
  /// with one sentence on what is wrong in which file.
  static Catalogue load(const std::vector<std::string>& files);

  /// nullptr: not described.
  const ParameterEntry* find(const Device& device, std::uint16_t number) const;
  /// lookIn() among the parameters of a device.
  Lookup look(const Device& device, const std::string& text) const {
    return lookIn(all(device), text, toString(device));
  }
  /// Every parameter of a device in the order of the numbers.
  std::vector<const ParameterEntry*> all(const Device& device) const;

 private:
  std::map<Device, std::map<std::uint16_t, ParameterEntry>> entries_;
};

/// The files `*.yaml` of a folder, sorted by name. Throws ConfigError when there is none.
std::vector<std::string> yamlFilesIn(const std::string& folder);

}  // namespace nord_driver::catalogue
