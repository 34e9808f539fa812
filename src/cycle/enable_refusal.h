// Why drives are not enabled: every reason there is, in one sentence.
#pragma once

#include <string>
#include <vector>

#include "drive/drive.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::cycle {

/// Faults come first, then absent drives, then what else a drive says, the commands last: who ends the first reason
/// shall not be told the next one only then. A single reason is told in full, with what was last seen.
/// `refusals`: one per drive, kNone where it does not refuse or is not asked. `commands`: what the velocity commands
/// have against it; empty for nothing. Returns an empty sentence when there is no reason.
Sentence enableRefusalMessage(const std::vector<std::string>& names, const std::vector<drive::Drive>& drives,
                              const std::vector<drive::Refusal>& refusals, const Sentence& commands) noexcept;

}  // namespace nord_driver::cycle
