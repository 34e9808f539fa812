#include "nord_driver/tools/yaml_settings.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace nord_driver::tools {

namespace {

void layOver(YAML::Node lower, const YAML::Node& upper) {
  for (const auto& member : upper) {
    const auto key = member.first.as<std::string>();
    if (member.second.IsMap() && lower[key] && lower[key].IsMap()) {
      layOver(lower[key], member.second);
    } else {
      lower[key] = member.second;
    }
  }
}

}  // namespace

YAML::Node readYamlFiles(const std::vector<std::string>& files) {
  YAML::Node all{YAML::NodeType::Map};
  for (const std::string& file : files) {
    try {
      const YAML::Node node = YAML::LoadFile(file);
      if (!node.IsMap()) throw ConfigError("--config " + file + ": expected a file of keys and values");
      layOver(all, node);
    } catch (const YAML::Exception& error) {
      throw ConfigError("--config " + file + ": " + error.what() + "; expected a readable YAML file");
    }
  }
  return all;
}

YamlSettings::YamlSettings(std::string prefix, const YAML::Node& node)
    : prefix_(std::move(prefix)), node_(YAML::Clone(node)) {
  if (node_.IsDefined() && !node_.IsNull() && !node_.IsMap()) {
    throw ConfigError(prefix_ + ": expected a group of keys and values");
  }
}

YAML::Node YamlSettings::find(const std::string& key) const {
  YAML::Node at = node_;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '/');) {
    if (!at.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    const YAML::Node& here = at;
    const YAML::Node next = here[part];  // of a const node: a missing key is not added
    if (!next.IsDefined()) return YAML::Node(YAML::NodeType::Undefined);
    at.reset(next);
  }
  return at;
}

template <typename T>
std::optional<T> YamlSettings::scalar(const std::string& key, const std::string& expected) const {
  const YAML::Node node = find(key);
  if (!node.IsDefined() || node.IsNull()) return std::nullopt;
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw ConfigError(fullName(key) + ": " + (node.IsScalar() ? node.Scalar() : "a list or group") +
                      " is not valid, expected " + expected);
  }
}

bool YamlSettings::has(const std::string& key) const {
  const YAML::Node node = find(key);
  return node.IsDefined() && !node.IsNull();
}

std::optional<double> YamlSettings::number(const std::string& key) const {
  return scalar<double>(key, "a number");
}

std::optional<std::int64_t> YamlSettings::integer(const std::string& key) const {
  return scalar<std::int64_t>(key, "a whole number");
}

std::optional<bool> YamlSettings::boolean(const std::string& key) const {
  return scalar<bool>(key, "true or false");
}

std::optional<std::string> YamlSettings::text(const std::string& key) const {
  return scalar<std::string>(key, "a text");
}

std::optional<std::vector<std::string>> YamlSettings::texts(const std::string& key) const {
  const YAML::Node node = find(key);
  if (node.IsDefined() && node.IsScalar()) return std::vector<std::string>{node.Scalar()};
  return scalar<std::vector<std::string>>(key, "a text or a list of texts");
}

std::string YamlSettings::fullName(const std::string& key) const {
  return prefix_.empty() ? key : prefix_ + "/" + key;
}

std::shared_ptr<YamlSettings> YamlSettings::group(const std::string& key) const {
  const YAML::Node node = find(key);
  return std::make_shared<YamlSettings>(fullName(key), node.IsDefined() ? node : YAML::Node(YAML::NodeType::Null));
}

std::vector<std::string> YamlSettings::keys() const {
  std::vector<std::string> names;
  for (const auto& member : node_) names.push_back(member.first.as<std::string>());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace nord_driver::tools
