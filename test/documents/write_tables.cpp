// Writes doc/parameter_tables.md and doc/fault_tables.md, or tells why it cannot.
#include <cstdio>
#include <exception>
#include <fstream>

#include "catalogue/shipped.h"
#include "documents/catalogue_tables.h"

int main() {
  try {
    const auto& catalogues = nord_driver::catalogue::shippedCatalogues();
    std::ofstream parameters{NORD_DRIVER_SOURCE_DIR "/doc/parameter_tables.md"};
    parameters << nord_driver::documents::parameterTables(catalogues);
    std::ofstream faults{NORD_DRIVER_SOURCE_DIR "/doc/fault_tables.md"};
    faults << nord_driver::documents::faultTables(catalogues);
    return parameters.good() && faults.good() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
