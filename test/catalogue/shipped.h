// The catalogue as it is shipped, read once for all tests.
#pragma once

#include <string>
#include <vector>

#include "catalogue/catalogue.h"
#include "catalogue/fault_catalogue.h"

namespace nord_driver::catalogue {

inline std::vector<std::string> shippedParameterFiles() {
  return yamlFilesIn(std::string(NORD_DRIVER_SOURCE_DIR) + "/config/parameters");
}

inline std::vector<std::string> shippedFaultFiles() {
  return yamlFilesIn(std::string(NORD_DRIVER_SOURCE_DIR) + "/config/faults");
}

inline const Catalogue& shipped() {
  static const Catalogue kCatalogue = Catalogue::load(shippedParameterFiles());
  return kCatalogue;
}

inline const FaultCatalogue& shippedFaults() {
  static const FaultCatalogue kCatalogue = FaultCatalogue::load(shippedFaultFiles());
  return kCatalogue;
}

}  // namespace nord_driver::catalogue
