// Where a program of this package finds its files of parameters and faults: beside itself when it is installed, in the
// package's folder in a workspace. Needs no ROS master.
#pragma once

#include <ros/package.h>

#include <string>
#include <vector>

#include "catalogue/catalogues.h"

namespace nord_driver::tools {

/// `own`: files of the user, laid over those of the project. Throws ConfigError, one sentence.
inline catalogue::Catalogues installedCatalogues(const std::vector<std::string>& own) {
  const auto package = [] { return ros::package::getPath("nord_driver"); };
  return catalogue::loadCatalogues(catalogue::findConfigFolder(catalogue::runningProgram(), package), own);
}

/// The same for files that the configuration lists at `key`, which the sentence names.
inline catalogue::Catalogues installedCatalogues(const std::vector<std::string>& own, const std::string& key) {
  try {
    return installedCatalogues(own);
  } catch (const ConfigError& error) {
    throw catalogue::namedBy(key, own, error);
  }
}

}  // namespace nord_driver::tools
