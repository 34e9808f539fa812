// The rule that package.xml, scripts/install_deps.sh and CMake name the same dependencies.
#pragma once

#include <string>
#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// One thing we depend on, under its three names.
struct Dependency {
  std::string key;                    ///< of rosdep, in package.xml; empty: there is none
  std::vector<std::string> packages;  ///< of Debian, in install_deps.sh without --test; what brings it may be listed
  std::vector<std::string> cmake;     ///< packages, components and libraries CMake finds; empty: it looks for none
};

/// This project's.
const std::vector<Dependency>& dependencies();

/// Each name of `table` is in its file, and each name of the files is in `table`. CMake files below fuzz and bench do
/// not count, they are for tests only, and none of packages of their own.
Violations checkDependencies(const std::vector<SourceFile>& files, const std::vector<Dependency>& table);

}  // namespace nord_driver::rules
