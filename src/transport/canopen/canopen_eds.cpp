#include "transport/canopen/canopen_eds.h"

#include "canopen/eds_check.h"
#include "canopen/eds_file.h"
#include "config/setting_checks.h"
#include "config/text_file.h"

namespace nord_driver {

namespace {

constexpr const char* kKey = "eds";

}  // namespace

void applyEds(const Settings& settings, std::uint32_t bit_rate, canopen::NodeConfig& node) {
  if (!settings.text(kKey)) return;
  const std::string path = requiredText(settings, kKey, "the path of an EDS file");
  const canopen::EdsFile file = canopen::parseEds(readTextFile(settings, kKey, path, "an EDS file"));
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
