// The transport a configuration names, from its plugin: pluginlib needs no roscore.
#pragma once

#include <boost/shared_ptr.hpp>
#include <pluginlib/class_loader.hpp>
#include <string>

#include "nord_driver/transport/transport.h"

namespace nord_driver::tools {

/// Must outlive what it has loaded.
class TransportLoader {
 public:
  TransportLoader() : loader_("nord_driver", "nord_driver::Transport") {}

  /// Throws ConfigError naming the declared transports when `name` is none of them.
  boost::shared_ptr<Transport> load(const std::string& name);

 private:
  pluginlib::ClassLoader<Transport> loader_;
};

}  // namespace nord_driver::tools
