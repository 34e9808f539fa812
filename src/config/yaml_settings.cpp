#include "config/yaml_settings.h"

#include <filesystem>
#include <regex>
#include <system_error>
#include <utility>

#include "config/yaml_number.h"
#include "config/yaml_tree.h"

namespace nord_driver {

namespace {

// YAML 1.1, as rosparam reads it. In its keys a slash begins a group: "linear/x: {...}".
SettingValue scalarValue(const YAML::Node& node) {
  static const std::regex kBooleans("true|True|TRUE|false|False|FALSE|yes|Yes|YES|no|No|NO|on|On|ON|off|Off|OFF");
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return SettingValue::ofText(text);  // quoted
  std::int64_t whole = 0;
  if (isYamlInteger(text) && YAML::convert<std::int64_t>::decode(node, whole)) {
    return SettingValue::ofInteger(whole, text);
  }
  if (isYamlInteger(text) || isYamlFraction(text)) return SettingValue::ofFraction(node.as<double>(), text);
  if (std::regex_match(text, kBooleans)) return SettingValue::ofBoolean(node.as<bool>(), text);
  return SettingValue::ofText(text);
}

SettingValue valueOf(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return {};
  if (node.IsScalar()) return scalarValue(node);
  SettingValue value = node.IsMap() ? SettingValue::group() : SettingValue::list();
  if (node.IsMap()) {
    for (const auto& member : node) value.addAt(member.first.as<std::string>(), valueOf(member.second));
  } else {
    for (const YAML::Node& item : node) value.items.push_back(valueOf(item));
  }
  return value;
}

SettingValue wholeValue(const std::string& prefix, const YAML::Node& node) {
  const std::string why = whyNotWalkable(node);
  if (!why.empty())
    throw ConfigError((prefix.empty() ? "the file" : prefix) + ": " + why + ", expected groups of keys and values");
  return valueOf(node);
}

YAML::Node laidOver(const YAML::Node& lower, const YAML::Node& upper) {
  YAML::Node all = YAML::Clone(lower);
  for (const auto& member : upper) {
    const auto key = member.first.as<std::string>();
    const YAML::Node below = lower[key];
    const bool both = below.IsDefined() && below.IsMap() && member.second.IsMap();
    all[key] = both ? laidOver(below, member.second) : YAML::Clone(member.second);
  }
  return all;
}

}  // namespace

YamlSettings::YamlSettings(const std::string& prefix, const YAML::Node& node)
    : TreeSettings(prefix, wholeValue(prefix, node)) {}

YAML::Node readYamlFiles(const std::vector<std::string>& files) {
  YAML::Node all{YAML::NodeType::Map};
  for (const std::string& file : files) {
    try {
      std::error_code unknown;
      if (std::filesystem::is_directory(file, unknown)) throw ConfigError("--config " + file + ": it is a folder");
      const YAML::Node node = YAML::LoadFile(file);
      if (!node.IsMap()) throw ConfigError("--config " + file + ": expected a file of keys and values");
      const std::string why = whyNotWalkable(node);
      if (!why.empty()) throw ConfigError("--config " + file + ": " + why + ", expected groups of keys and values");
      all.reset(laidOver(all, node));
    } catch (const YAML::BadFile&) {
      std::error_code unreadable;
      throw ConfigError(
          "--config " + file + ": " +
          (std::filesystem::exists(file, unreadable) ? "this file cannot be read" : "there is no such file"));
    } catch (const YAML::Exception& error) {
      throw ConfigError("--config " + file + ": " + error.what() + "; expected a readable YAML file");
    }
  }
  return all;
}

}  // namespace nord_driver
