// Which folder may include what: the table of the architecture, held by a test.
//
// Debian keeps ROS headers in /usr/include, where every file finds them, so that no compiler would object to a protocol
// engine that knows ROS.
#pragma once

#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// Reads the `#include` lines (and calls of clocks) of every C++ file under include/nord_driver, src and test. No such
/// file at all is a violation too.
Violations checkIncludes(const std::vector<SourceFile>& files);

}  // namespace nord_driver::rules
