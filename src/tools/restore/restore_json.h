// A restore as JSON: what was planned, and what became of it.
#pragma once

#include <string>
#include <vector>

#include "tools/restore/restore_journal.h"

namespace nord_driver::tools {

/// `state`: "planned", or how the run has ended.
std::string restoreJson(const RestoreRecord& record, const std::vector<RestorePlan::LeftOut>& left_out,
                        const std::vector<std::string>& notes, const std::string& state,
                        const catalogue::DriveCatalogue& known);

}  // namespace nord_driver::tools
