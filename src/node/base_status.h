// The task `base` of /diagnostics.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cycle/snapshot.h"

namespace nord_driver::node {

/// `names`: of the drives; `sideways`: this kind of base can move so; `ignored`: commands for it that were no numbers.
void reportBase(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& names, bool sideways,
                std::uint64_t ignored, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace nord_driver::node
