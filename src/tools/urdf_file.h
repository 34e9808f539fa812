// The file of a robot description that a command is given.
#pragma once

#include <string>

namespace nord_driver::tools {

/// Its text; empty where no file is named. Throws UsageError when it cannot be read or is empty.
std::string readUrdf(const std::string& path);

}  // namespace nord_driver::tools
