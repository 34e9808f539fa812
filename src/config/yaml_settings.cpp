#include "config/yaml_settings.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <utility>

namespace nord_driver::tools {

namespace {

enum class Kind { kText, kInteger, kFraction, kBoolean, kList, kGroup };

// YAML 1.1, as rosparam reads it.
Kind kindOf(const YAML::Node& value) {
  static const std::regex kIntegers("[-+]?([0-9]+|0x[0-9a-fA-F]+)");
  static const std::regex kFractions(R"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)");
  static const std::regex kBooleans("true|True|TRUE|false|False|FALSE|yes|Yes|YES|no|No|NO|on|On|ON|off|Off|OFF");
  if (value.IsSequence()) return Kind::kList;
  if (value.IsMap()) return Kind::kGroup;
  const std::string& text = value.Scalar();
  if (value.Tag() == "!") return Kind::kText;  // quoted
  if (std::regex_match(text, kIntegers)) return Kind::kInteger;
  if (std::regex_match(text, kFractions)) return Kind::kFraction;
  return std::regex_match(text, kBooleans) ? Kind::kBoolean : Kind::kText;
}

std::string printed(const YAML::Node& value) {
  switch (kindOf(value)) {
    case Kind::kGroup:
      return "a group";
    case Kind::kList:
      return "a list";
    case Kind::kText:
      return "\"" + value.Scalar() + "\"";
    default:
      return value.Scalar();
  }
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

YAML::Node readYamlFiles(const std::vector<std::string>& files) {
  YAML::Node all{YAML::NodeType::Map};
  for (const std::string& file : files) {
    try {
      const YAML::Node node = YAML::LoadFile(file);
      if (!node.IsMap()) throw ConfigError("--config " + file + ": expected a file of keys and values");
      all.reset(laidOver(all, node));
    } catch (const YAML::Exception& error) {
      throw ConfigError("--config " + file + ": " + error.what() + "; expected a readable YAML file");
    }
  }
  return all;
}

YamlSettings::YamlSettings(std::string prefix, const YAML::Node& node)
    : prefix_(std::move(prefix)), node_(YAML::Clone(node)) {
  if (node_.IsDefined() && !node_.IsNull() && !node_.IsMap()) {
    throw ConfigError(prefix_ + ": " + printed(node_) + " is not valid, expected a group of keys and values");
  }
}

YAML::Node YamlSettings::find(const std::string& key) const {
  YAML::Node at = node_;
  if (!at.IsDefined() || at.IsNull()) return YAML::Node(YAML::NodeType::Undefined);  // an absent group
  std::istringstream parts(key);
  std::string path;
  for (std::string part; std::getline(parts, part, '/'); path += (path.empty() ? "" : "/") + part) {
    if (!at.IsMap()) throw wrongKind(path, at, "a group of keys and values");
    const YAML::Node& here = at;
    const YAML::Node next = here[part];  // of a const node: a missing key is not added
    if (!next.IsDefined() || next.IsNull()) return YAML::Node(YAML::NodeType::Undefined);
    at.reset(next);
  }
  return at;
}

ConfigError YamlSettings::wrongKind(const std::string& key, const YAML::Node& value,
                                    const std::string& expected) const {
  return ConfigError(fullName(key) + ": " + printed(value) + " is not valid, expected " + expected);
}

bool YamlSettings::has(const std::string& key) const {
  return find(key).IsDefined();
}

std::optional<double> YamlSettings::number(const std::string& key) const {
  const YAML::Node value = find(key);
  if (!value.IsDefined()) return std::nullopt;
  const Kind kind = kindOf(value);
  if (kind != Kind::kInteger && kind != Kind::kFraction) throw wrongKind(key, value, "a number");
  if (kind == Kind::kInteger) return static_cast<double>(integer(key).value_or(0));
  return value.as<double>();
}

std::optional<std::int64_t> YamlSettings::integer(const std::string& key) const {
  const YAML::Node value = find(key);
  if (!value.IsDefined()) return std::nullopt;
  const Kind kind = kindOf(value);
  std::int64_t whole = 0;
  if (kind == Kind::kInteger && YAML::convert<std::int64_t>::decode(value, whole)) return whole;
  if (kind == Kind::kFraction) {
    constexpr double kLargest = 9007199254740992.0;  // 2^53: beyond it not every whole number is a double
    const auto fraction = value.as<double>();
    if (std::abs(fraction) <= kLargest && std::trunc(fraction) == fraction) return static_cast<std::int64_t>(fraction);
  }
  throw wrongKind(key, value, "a whole number");
}

std::optional<bool> YamlSettings::boolean(const std::string& key) const {
  const YAML::Node value = find(key);
  if (!value.IsDefined()) return std::nullopt;
  if (kindOf(value) != Kind::kBoolean) throw wrongKind(key, value, "true or false");
  return value.as<bool>();
}

std::optional<std::string> YamlSettings::text(const std::string& key) const {
  const YAML::Node value = find(key);
  if (!value.IsDefined()) return std::nullopt;
  if (kindOf(value) != Kind::kText) throw wrongKind(key, value, "a text");
  return value.Scalar();
}

std::optional<std::vector<std::string>> YamlSettings::texts(const std::string& key) const {
  const YAML::Node value = find(key);
  if (!value.IsDefined()) return std::nullopt;
  if (kindOf(value) == Kind::kText) return std::vector<std::string>{value.Scalar()};
  if (!value.IsSequence()) throw wrongKind(key, value, "a text or a list of texts");
  std::vector<std::string> list;
  for (const YAML::Node& item : value) {
    if (kindOf(item) != Kind::kText) throw wrongKind(key, item, "a list of texts");
    list.push_back(item.Scalar());
  }
  return list;
}

std::string YamlSettings::fullName(const std::string& key) const {
  return prefix_ + (prefix_.empty() || key.empty() ? "" : "/") + key;
}

std::shared_ptr<YamlSettings> YamlSettings::group(const std::string& key) const {
  const YAML::Node value = find(key);
  return std::make_shared<YamlSettings>(fullName(key), value.IsDefined() ? value : YAML::Node(YAML::NodeType::Null));
}

std::vector<std::string> YamlSettings::keys() const {
  std::vector<std::string> names;
  for (const auto& member : node_) names.push_back(member.first.as<std::string>());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace nord_driver::tools
