// Rules that keep the build complete: a source or a folder that nobody lists is silently not built and not tested.
#pragma once

#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// Every .cpp under src and test is named in the nearest CMakeLists.txt above it, and every folder with a
/// CMakeLists.txt is named in the nearest one above that.
Violations checkSourceLists(const std::vector<SourceFile>& files);

/// Of the scripts only demo.sh builds where rosrun looks: below the package it finds the programs of every folder but
/// build/, and asks which is meant as soon as there are two.
Violations checkBuildFolders(const std::vector<SourceFile>& files);

}  // namespace nord_driver::rules
