#include "tools/urdf_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "tools/usage_error.h"

namespace nord_driver::tools {

std::string readUrdf(const std::string& path) {
  if (path.empty()) return {};
  std::error_code unknown;
  std::string reason = std::filesystem::is_directory(path, unknown) ? "it is a folder" : "";
  std::ostringstream urdf;
  if (reason.empty()) {
    const std::ifstream file(path);
    if (!file) reason = "this file cannot be read";
    if (file) urdf << file.rdbuf();
    if (file && urdf.str().empty()) reason = "it is empty";
  }
  if (!reason.empty()) throw UsageError("--urdf " + path + ": " + reason);
  return urdf.str();
}

}  // namespace nord_driver::tools
