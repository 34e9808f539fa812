#include "tools/transport_loader.h"

#include <stdexcept>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver::tools {

boost::shared_ptr<Transport> TransportLoader::load(const std::string& name) {
  constexpr char kHint[] = "is the workspace's setup file sourced?";
  try {
    if (!loader_) loader_.emplace("nord_driver", "nord_driver::Transport");
    if (loader_->isClassAvailable(name)) return loader_->createInstance(name);
  } catch (const pluginlib::PluginlibException& error) {
    throw std::runtime_error(std::string(error.what()) + " (" + kHint + ")");
  }
  throw unknownTransport(YamlSettings{"", {}}, name, loader_->getDeclaredClasses());
}

}  // namespace nord_driver::tools
