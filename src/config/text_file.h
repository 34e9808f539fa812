// Files that a configuration names and that are read as a whole.
#pragma once

#include <cstdint>
#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver {

/// Bytes. No file anybody writes by hand, and no GSD or EDS file, is a tenth of it.
constexpr std::uintmax_t kLargestTextFile = 4u << 20u;

/// Why the file is not even to be opened; empty when it may be tried, and may fail, as it does where there is none. A
/// name comes from the configuration, which anybody in the ROS graph may have set: a pipe would hold up the start for
/// ever, /dev/zero take all memory.
std::string whyNoTextFile(const std::string& path);

/// Its text. Throws ConfigError with the reason when it cannot be read or is empty; `what`: "an EDS file".
std::string readTextFile(const Settings& settings, const std::string& key, const std::string& path,
                         const std::string& what);

}  // namespace nord_driver
