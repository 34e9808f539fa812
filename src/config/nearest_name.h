// Slips of the pen: which of some names somebody may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nord_driver {

/// The one of `names` that `name` is a slip of; empty when none is near enough: two changes, or a third of `name`.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

/// The number of single-character changes between two words (Levenshtein).
std::size_t editDistance(const std::string& a, const std::string& b);

}  // namespace nord_driver
