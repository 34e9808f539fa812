// Rules about the text of single files.
#pragma once

#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// A C++ file longer than this holds more than one idea.
constexpr std::size_t kMaxLines = 400;

/// C++ files stay within kMaxLines; a header begins with a comment that says what it is for and has `#pragma once`.
Violations checkCppFiles(const std::vector<SourceFile>& files);

/// A node of this package in a launch file of launch/ has clear_params="true": what an earlier start has left on a
/// standing roscore is a drive too many, or another bus.
Violations checkLaunchFiles(const std::vector<SourceFile>& files);

/// No file names a folder outside the project or leaves work behind for later.
Violations checkWords(const std::vector<SourceFile>& files);

}  // namespace nord_driver::rules
