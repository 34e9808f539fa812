// Draws what a drive did over time: setpoint and frequency, current, and a band of the states it was in.
#pragma once

#include <string>

#include "tools/scope_record.h"

namespace nord_driver::tools {

/// A picture of its own, 1000 px wide, that reads on light and dark pages; the same bytes each time. Without P105 the
/// left axis is in % of it. Throws UsageError when there are fewer than two samples.
std::string scopeSvg(const ScopeRecord& record);

}  // namespace nord_driver::tools
