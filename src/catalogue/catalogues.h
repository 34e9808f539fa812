// Both catalogues as one: the files the project comes with, and those a user lays over them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "catalogue/catalogue.h"
#include "catalogue/fault_catalogue.h"

namespace nord_driver::catalogue {

struct Catalogues {
  Catalogue parameters;
  FaultCatalogue faults;
};

/// The project's files below `folder` (parameters/, faults/), then `own` in their order: each of parameters, of faults,
/// or of both. Throws ConfigError with one sentence on what is wrong in which file, or that the project's are missing.
Catalogues loadCatalogues(const std::string& folder, const std::vector<std::string>& own);

/// What was thrown, named by `key` ("~parameter_files") where it is about one of the `files` that this key of a
/// configuration lists: "~parameter_files: FILE:LINE: ...".
ConfigError namedBy(const std::string& key, const std::vector<std::string>& files, const ConfigError& error);

/// The folder of the project's own files. Where the program `program` (its full path) is installed, in
/// PREFIX/lib/nord_driver, that of the same prefix, wherever it was moved to; otherwise that of `package`, which finds
/// the package's folder, or an empty text when there is none, and is asked only then.
std::string findConfigFolder(const std::string& program, const std::function<std::string()>& package);

/// The full path of the program that runs; empty when the system does not tell.
std::string runningProgram();

}  // namespace nord_driver::catalogue
