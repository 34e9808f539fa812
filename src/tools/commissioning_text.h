// What the commissioning check prints, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "tools/commissioning_check.h"

namespace nord_driver::tools {

/// Drive by drive, one line for each finding, and a last one with how many there are.
std::string checkText(const std::vector<CommissionedDrive>& drives, const commissioning::Findings& findings);

/// {"drives": [{"name", "address", "series", "parameter_set", "trouble", "findings": [...]}], "findings": N}.
std::string checkJson(const std::vector<CommissionedDrive>& drives, const commissioning::Findings& findings);

/// "left: P509 Source control word: 0 Control terminals or keyboard -> 4 PROFIBUS", and what it means where it changes
/// who has control.
std::string fixText(const Fix& fix);

}  // namespace nord_driver::tools
