// The catalogue as it is shipped, read once for all tests.
#pragma once

#include <string>
#include <vector>

#include "catalogue/catalogues.h"

namespace nord_driver::catalogue {

inline std::string shippedFolder() {
  return std::string(NORD_DRIVER_SOURCE_DIR) + "/config";
}

inline std::vector<std::string> shippedParameterFiles() {
  return yamlFilesIn(shippedFolder() + "/parameters");
}

inline std::vector<std::string> shippedFaultFiles() {
  return yamlFilesIn(shippedFolder() + "/faults");
}

inline const Catalogues& shippedCatalogues() {
  static const Catalogues kCatalogues = loadCatalogues(shippedFolder(), {});
  return kCatalogues;
}

inline const Catalogue& shipped() {
  return shippedCatalogues().parameters;
}

inline const FaultCatalogue& shippedFaults() {
  return shippedCatalogues().faults;
}

}  // namespace nord_driver::catalogue
