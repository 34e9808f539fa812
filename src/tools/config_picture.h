// A checked configuration as a tree for people.
#pragma once

#include <string>

#include "tools/config_check.h"

namespace nord_driver::tools {

/// `lines`: branches as box-drawing characters, for a terminal that has them; otherwise in ASCII. Ends with a verdict:
/// "fine", "fine, 1 warning" or "refused: 2 errors".
std::string configPicture(const CheckedConfig& config, bool lines);

/// The same for programs: one object; its fields are described in doc/nord_param.md.
std::string configJson(const CheckedConfig& config);

}  // namespace nord_driver::tools
