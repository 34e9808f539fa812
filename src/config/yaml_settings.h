// A group of a YAML file as Settings: the driver's configuration without a parameter server.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "config/tree_settings.h"

namespace nord_driver {

/// Reads values as rosparam does, so that a file means here what it means to the node: what is quoted is a text, what
/// looks like a number is none, "linear/x" is the group "x" in the group "linear", and merge keys ("<<") are resolved.
class YamlSettings final : public TreeSettings {
 public:
  /// `node` is a map, or null for an absent group. Throws ConfigError when it is anything else.
  YamlSettings(const std::string& prefix, const YAML::Node& node);
};

/// One map of several files, a later one laid over an earlier one, group by group. Throws ConfigError naming the file.
YAML::Node readYamlFiles(const std::vector<std::string>& files);

}  // namespace nord_driver
