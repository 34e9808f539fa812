#include "config/yaml_settings.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <regex>
#include <system_error>
#include <utility>

#include "config/yaml_merge.h"
#include "config/yaml_number.h"
#include "config/yaml_tree.h"
#include "core/units.h"

namespace nord_driver {

namespace {

// The parameter server is told its values by XML-RPC, whose whole numbers have 32 bits: rosparam ends with a longer one.
SettingValue wholeNumber(const std::string& name, const YAML::Node& node) {
  std::int64_t whole = 0;
  const bool known = YAML::convert<std::int64_t>::decode(node, whole);
  const bool fits =
      known && whole >= std::numeric_limits<std::int32_t>::min() && whole <= std::numeric_limits<std::int32_t>::max();
  if (fits) return SettingValue::ofInteger(whole, node.Scalar());
  throw ConfigError(
      name + ": " + node.Scalar() +
      " is not valid, expected -2147483648 to 2147483647: the parameter server takes no longer whole number" +
      (known ? "; write " + std::to_string(whole) + ".0" : ""));
}

/// "deg(90)" or "rad(1.5)" where rosparam takes the value for an angle, written as the tag `!degrees 90` as well; else
/// empty.
std::string angleText(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  const bool begins = text.compare(0, 4, "deg(") == 0 || text.compare(0, 4, "rad(") == 0;
  const bool in_brackets = begins && text.find(')') == text.size() - 1;
  if (node.Tag() == "!degrees") return in_brackets ? text : "deg(" + text + ")";
  if (node.Tag() == "!radians") return in_brackets ? text : "rad(" + text + ")";
  return in_brackets && node.Tag() != "!" ? text : "";
}

// In rad() rosparam evaluates Python: rad(pi/2). Nobody does this here, so that only a number can be read.
SettingValue angleValue(const std::string& name, const std::string& text) {
  static const std::regex kNumberInBrackets(
      R"(.{4} *([-+]?(0|[1-9][0-9]*|[0-9]+\.[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?) *\))");
  constexpr std::size_t kLongest = 64;  // std::regex takes stack for each character
  std::smatch parts;
  double number = 0.0;
  if (text.size() > kLongest || !std::regex_match(text, parts, kNumberInBrackets) ||
      !YAML::convert<double>::decode(YAML::Node(parts[1].str()), number)) {
    throw ConfigError(name + ": " + text + " is not valid, expected one number in the brackets: write the number");
  }
  return SettingValue::ofFraction(text[0] == 'd' ? number * kPi / 180.0 : number, text);
}

// YAML 1.1, as rosparam reads it. In its keys a slash begins a group: "linear/x: {...}".
SettingValue scalarValue(const std::string& name, const YAML::Node& node) {
  static const std::regex kBooleans("true|True|TRUE|false|False|FALSE|yes|Yes|YES|no|No|NO|on|On|ON|off|Off|OFF");
  const std::string& text = node.Scalar();
  const std::string angle = angleText(node);
  if (!angle.empty()) return angleValue(name, angle);
  if (node.Tag() == "!") return SettingValue::ofText(text);  // quoted
  if (isYamlInteger(text)) return wholeNumber(name, node);
  if (isYamlFraction(text)) return SettingValue::ofFraction(node.as<double>(), text);
  if (std::regex_match(text, kBooleans)) return SettingValue::ofBoolean(node.as<bool>(), text);
  return SettingValue::ofText(text);
}

SettingValue valueOf(const std::string& name, const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return {};
  if (node.IsScalar()) return scalarValue(name, node);
  SettingValue value = node.IsMap() ? SettingValue::group() : SettingValue::list();
  if (node.IsMap()) {
    const bool below_another = !name.empty() && name.back() != '/' && name.back() != '~';
    for (const auto& member : node) {
      const auto key = member.first.as<std::string>();
      value.addAt(key, valueOf((below_another ? name + "/" : name) + key, member.second));
    }
  } else {
    for (const YAML::Node& item : node) value.items.push_back(valueOf(name, item));
  }
  return value;
}

SettingValue wholeValue(const std::string& prefix, const YAML::Node& node) {
  const std::string why = whyNotWalkable(node);
  if (!why.empty())
    throw ConfigError((prefix.empty() ? "the file" : prefix) + ": " + why + ", expected groups of keys and values");
  return valueOf(prefix, withKeysMerged(node, prefix.empty() ? "the file" : prefix));
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
      all.reset(laidOver(all, withKeysMerged(node, "--config " + file)));
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
