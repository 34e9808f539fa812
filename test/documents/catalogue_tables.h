// doc/parameter_tables.md and doc/fault_tables.md: the files below config/parameters and config/faults as tables.
#pragma once

#include <string>

#include "catalogue/catalogues.h"

namespace nord_driver::documents {

/// Every parameter, one table for each file below config/parameters.
std::string parameterTables(const catalogue::Catalogues& catalogues);

/// Every fault and error number, one table for each file below config/faults.
std::string faultTables(const catalogue::Catalogues& catalogues);

}  // namespace nord_driver::documents
