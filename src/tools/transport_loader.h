// The transport a configuration names, from its plugin: pluginlib needs no roscore.
#pragma once

#include <boost/shared_ptr.hpp>
#include <optional>
#include <pluginlib/class_loader.hpp>
#include <string>

#include "nord_driver/transport/transport.h"

namespace nord_driver::tools {

/// Must outlive what it has loaded.
class TransportLoader {
 public:
  /// Throws ConfigError naming the declared transports when `name` is none of them, and std::runtime_error when this
  /// package is not found.
  boost::shared_ptr<Transport> load(const std::string& name);

 private:
  std::optional<pluginlib::ClassLoader<Transport>> loader_;
};

}  // namespace nord_driver::tools
