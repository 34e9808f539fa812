// Rules about what comes from outside: texts from the wire, from the parameter server and from files are data, and never
// a program, a command line or a format.
#pragma once

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// No source of the driver (src/, include/) starts a program or loads one by a name of its own, and none uses a function
/// that writes into a buffer without knowing its size.
Violations checkCalls(const std::vector<SourceFile>& files);

/// The format of everything that takes one (printf and its kin, FixedText::format, ROS_INFO and its kin) is a literal,
/// or a choice of literals; or, in a function that hands its own format on, a parameter named `pattern` or `format`:
/// what such a function is called with is held to the same.
Violations checkFormats(const std::vector<SourceFile>& files);

}  // namespace nord_driver::rules
