// The rule that documents name only code that exists.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// Names in documents that look like code of this project and are somebody else's, each with whose.
const std::map<std::string, std::string>& foreignNames();

/// Reads what stands in backticks in doc/*.md and README.md, outside fenced blocks, and finds what looks like code and
/// is nowhere: `SomeClass`, `someName`, `name()`, `SomeClass::name`, paths below src, test, include and scripts, and
/// headers and sources by the end of their path. Code is what stands in C++ files (test/rules left out), comments left
/// out, and the names of messages and services. No document at all is a violation too.
Violations checkDocuments(const std::vector<SourceFile>& files, const std::map<std::string, std::string>& foreign);

}  // namespace nord_driver::rules
