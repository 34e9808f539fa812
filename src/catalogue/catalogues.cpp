#include "catalogue/catalogues.h"

#include <filesystem>

#include "catalogue/yaml_map.h"

namespace nord_driver::catalogue {

namespace {

namespace fs = std::filesystem;

bool holdsTheFiles(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "parameters", error) && fs::is_directory(folder / "faults", error);
}

}  // namespace

Catalogues loadCatalogues(const std::string& folder, const std::vector<std::string>& own) {
  if (!holdsTheFiles(folder)) {
    throw ConfigError((folder.empty() ? "the package nord_driver" : folder) +
                      ": the files of parameters and faults are missing, expected config/parameters and config/faults "
                      "of the package nord_driver (is the workspace's setup file sourced?)");
  }
  std::vector<std::string> parameters = yamlFilesIn((fs::path(folder) / "parameters").string());
  std::vector<std::string> faults = yamlFilesIn((fs::path(folder) / "faults").string());
  for (const std::string& file : own) {
    const YAML::Node content = loadMap(file);
    const bool has_faults = content["faults"].IsDefined() || content["codes"].IsDefined();
    if (has_faults) faults.push_back(file);
    if (!has_faults || content["parameters"].IsDefined()) parameters.push_back(file);
  }
  return {Catalogue::load(parameters), FaultCatalogue::load(faults)};
}

ConfigError namedBy(const std::string& key, const std::vector<std::string>& files, const ConfigError& error) {
  const std::string sentence = error.what();
  for (const std::string& file : files) {
    if (sentence.compare(0, file.size() + 1, file + ":") == 0) return ConfigError(key + ": " + sentence);
  }
  return error;
}

std::string findConfigFolder(const std::string& program, const std::function<std::string()>& package) {
  const fs::path prefix = fs::path(program).parent_path().parent_path().parent_path();
  const fs::path installed = prefix / "share" / "nord_driver" / "config";
  if (!program.empty() && holdsTheFiles(installed)) return installed.string();
  const std::string folder = package();
  return folder.empty() ? "" : (fs::path(folder) / "config").string();
}

std::string runningProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? "" : program.string();
}

}  // namespace nord_driver::catalogue
