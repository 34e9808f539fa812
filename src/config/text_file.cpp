#include "config/text_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "config/setting_checks.h"

namespace nord_driver {

std::string whyNoTextFile(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) return "";
  if (!std::filesystem::is_regular_file(status)) return "it is no ordinary file";
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return !error && size > kLargestTextFile ? "it has more than 4 MiB" : "";
}

std::string readTextFile(const Settings& settings, const std::string& key, const std::string& path,
                         const std::string& what) {
  std::string reason = whyNoTextFile(path);
  std::ostringstream text;
  if (reason.empty()) {
    errno = 0;
    std::ifstream file{path, std::ios::binary};
    if (file) text << file.rdbuf();
    if (!file || text.str().empty()) reason = errno != 0 ? std::strerror(errno) : "it is empty";
  }
  if (!reason.empty())
    throw wrongSetting(settings, key, "\"" + path + "\"", what + " that can be read (" + reason + ")");
  return text.str();
}

}  // namespace nord_driver
