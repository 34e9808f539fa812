// A text file that a setting names.
#pragma once

#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver {

/// Its text. Throws ConfigError with the reason when it cannot be read or is empty; `what`: "an EDS file".
std::string readTextFile(const Settings& settings, const std::string& key, const std::string& path,
                         const std::string& what);

}  // namespace nord_driver
