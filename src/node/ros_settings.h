// The private parameters of the node as Settings.
#pragma once

#include <XmlRpcValue.h>

#include <string>

#include "config/tree_settings.h"

namespace nord_driver::node {

/// A group of parameters ("~", "~bus") taken from the parameter server once.
class RosSettings final : public TreeSettings {
 public:
  /// `value` is a struct, or invalid for an absent group. Throws ConfigError when it is anything else.
  RosSettings(std::string prefix, const XmlRpc::XmlRpcValue& value);
};

}  // namespace nord_driver::node
