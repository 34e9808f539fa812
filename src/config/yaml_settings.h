// A group of a YAML file as Settings: the driver's configuration without a parameter server.
#pragma once

#include <yaml-cpp/yaml.h>

#include <memory>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver::tools {

/// Reads values as rosparam does, so that a file means here what it means to the node: what is quoted is a text, what
/// looks like a number is none. Keys may hold slashes ("bus/baud_rate").
class YamlSettings final : public Settings {
 public:
  /// `node` is a map, or null for an absent group. Throws ConfigError when it is anything else.
  YamlSettings(std::string prefix, const YAML::Node& node);

  bool has(const std::string& key) const override;
  std::optional<double> number(const std::string& key) const override;
  std::optional<std::int64_t> integer(const std::string& key) const override;
  std::optional<bool> boolean(const std::string& key) const override;
  std::optional<std::string> text(const std::string& key) const override;
  std::optional<std::vector<std::string>> texts(const std::string& key) const override;
  /// Sorted as the parameter server sorts them.
  std::vector<std::string> keys() const override;
  std::string fullName(const std::string& key) const override;

  /// The group below `key`; an empty one when it is absent.
  std::shared_ptr<YamlSettings> group(const std::string& key) const;

 private:
  YAML::Node find(const std::string& key) const;  // undefined when it is absent or null
  ConfigError wrongKind(const std::string& key, const YAML::Node& value, const std::string& expected) const;

  std::string prefix_;
  YAML::Node node_;
};

/// One map of several files, a later one laid over an earlier one, group by group. Throws ConfigError naming the file.
YAML::Node readYamlFiles(const std::vector<std::string>& files);

}  // namespace nord_driver::tools
