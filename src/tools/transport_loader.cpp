#include "tools/transport_loader.h"

#include <stdexcept>

namespace nord_driver::tools {

boost::shared_ptr<Transport> TransportLoader::load(const std::string& name) {
  constexpr char kHint[] = "is the workspace's setup file sourced?";
  try {
    loader_.emplace("nord_driver", "nord_driver::Transport");
    if (loader_->isClassAvailable(name)) return loader_->createInstance(name);
  } catch (const pluginlib::PluginlibException& error) {
    throw std::runtime_error(std::string(error.what()) + " (" + kHint + ")");
  }
  std::string known;
  for (const std::string& declared : loader_->getDeclaredClasses()) known += (known.empty() ? "" : ", ") + declared;
  throw ConfigError("transport: \"" + name + "\" is not valid, expected one of the declared transports: " +
                    (known.empty() ? std::string("none (") + kHint + ")" : known));
}

}  // namespace nord_driver::tools
