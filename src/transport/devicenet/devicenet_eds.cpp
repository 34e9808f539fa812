#include "transport/devicenet/devicenet_eds.h"

#include <string>

#include "config/setting_checks.h"
#include "config/text_file.h"
#include "devicenet/eds_check.h"
#include "devicenet/eds_file.h"
#include "transport/devicenet/assembly.h"

namespace nord_driver {

namespace {

constexpr const char* kKey = "eds";

void apply(DevicenetConfig& config, const Settings& settings, const std::string& path, std::size_t module) {
  const devicenet::EdsFile file = devicenet::parseEds(readTextFile(settings, kKey, path, "an EDS file"));
  if (!file.vendor_id && !file.product_code && !file.io_line) {
    throw wrongSetting(settings, kKey, "\"" + path + "\"",
                       "an EDS file of DeviceNet: it has neither a VendCode and a ProdCode nor [IO_Info]");
  }
  for (const devicenet::EdsProblem& problem : file.problems) {
    config.warnings.push_back(path + ":" + std::to_string(problem.line) + ": " + problem.text);
  }
  const AssemblyLayout& layout = *findAssembly(config.modules[module].assembly);
  const devicenet::EdsAssemblies assemblies{static_cast<std::uint8_t>(layout.input),
                                            static_cast<std::uint8_t>(layout.output),
                                            layout.output == kVariableAssembly};
  devicenet::NodeConfig& node = config.scanner.nodes[module];
  const std::vector<std::string> sentences = devicenet::checkAgainstEds(node, assemblies, file);
  if (!sentences.empty()) {
    throw ConfigError(settings.fullName(kKey) + ": " + path +
                      " describes another module than is configured: " + sentences.front());
  }
  node = devicenet::filledFromEds(node, file);
}

}  // namespace

void applyEds(DevicenetConfig& config, const std::vector<DriveSettings>& drives) {
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    std::string path, of;
    for (const std::size_t index : config.modules[i].drives) {
      const Settings& settings = *drives[index].settings;
      if (!settings.text(kKey)) continue;
      const std::string named = requiredText(settings, kKey, "the path of an EDS file");
      if (!path.empty() && named != path) {
        throw wrongSetting(settings, kKey, "\"" + named + "\"",
                           "\"" + path + "\", the one of drive \"" + of + "\": both are behind one module");
      }
      if (path.empty()) apply(config, settings, named, i);
      path = named;
      of = drives[index].name;
    }
  }
}

}  // namespace nord_driver
