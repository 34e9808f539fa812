#include "config/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "config/setting_checks.h"

namespace nord_driver {

std::string readTextFile(const Settings& settings, const std::string& key, const std::string& path,
                         const std::string& what) {
  errno = 0;
  std::ifstream file{path, std::ios::binary};
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || text.str().empty()) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "it is empty or no file";
    throw wrongSetting(settings, key, "\"" + path + "\"", what + " that can be read (" + reason + ")");
  }
  return text.str();
}

}  // namespace nord_driver
