#include "transport/canopen/canopen_eds.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "canopen/eds_check.h"
#include "canopen/eds_file.h"
#include "config/setting_checks.h"

namespace nord_driver {

namespace {

constexpr const char* kKey = "eds";

std::string readFile(const Settings& settings, const std::string& path) {
  errno = 0;
  std::ifstream file{path, std::ios::binary};
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || text.str().empty()) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "it is empty or no file";
    throw wrongSetting(settings, kKey, "\"" + path + "\"", "an EDS file that can be read (" + reason + ")");
  }
  return text.str();
}

}  // namespace

void applyEds(const Settings& settings, std::uint32_t bit_rate, canopen::NodeConfig& node) {
  if (!settings.text(kKey)) return;
  const std::string path = requiredText(settings, kKey, "the path of an EDS file");
  const canopen::EdsFile file = canopen::parseEds(readFile(settings, path));
  if (file.objects.empty()) {
    throw wrongSetting(settings, kKey, "\"" + path + "\"", "an EDS file: it describes no object");
  }
  const std::vector<std::string> sentences = canopen::checkAgainstEds(node, file, bit_rate);
  if (!sentences.empty()) {
    throw ConfigError(settings.fullName(kKey) + ": " + path +
                      " describes another device than is configured: " + sentences.front());
  }
  node = canopen::filledFromEds(node, file);
}

}  // namespace nord_driver
