#include "catalogue/yaml_map.h"

#include <algorithm>
#include <regex>

#include "config/nearest_name.h"
#include "config/text_file.h"
#include "config/yaml_tree.h"

namespace nord_driver::catalogue {

namespace {

std::string printed(const YAML::Node& value) {
  if (!value.IsDefined() || value.IsNull()) return "nothing";
  if (value.IsScalar()) return "\"" + value.Scalar() + "\"";
  if (value.IsMap()) return "a group";
  std::string list = "[";
  for (const YAML::Node& item : value) {
    list += (list.size() > 1 ? ", " : "") + (item.IsScalar() ? item.Scalar() : std::string("..."));
  }
  return list + "]";
}

Place placeOf(const std::string& file, const YAML::Node& node) {
  return {file, node.Mark().line + 1};
}

// What a file says is part of many sentences: a zero would end one, and others are for a terminal to obey.
std::string withoutControls(std::string text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

}  // namespace

ConfigError wrongPlace(const Place& place, const std::string& message) {
  return ConfigError(place.file + ":" + std::to_string(place.line) + ": " + withoutControls(message));
}

ConfigError wrongValue(const std::string& file, const YAML::Node& value, const std::string& path,
                       const std::string& expected) {
  return wrongPlace(placeOf(file, value),
                    (path.empty() ? "" : path + ": ") + printed(value) + " is not valid, expected " + expected);
}

YAML::Node loadMap(const std::string& file) {
  const std::string refused = whyNoTextFile(file);
  if (!refused.empty()) throw ConfigError(file + ": " + refused + ", expected a readable YAML file");
  YAML::Node node;
  try {
    node = YAML::LoadFile(file);
  } catch (const YAML::BadFile&) {
    throw ConfigError(file + ": cannot be opened, expected a readable YAML file");
  } catch (const YAML::Exception& error) {
    throw wrongPlace({file, error.mark.line + 1}, error.msg + "; expected a readable YAML file");
  }
  if (!node.IsMap()) throw wrongValue(file, node, "", "a file of keys and values");
  const std::string why = whyNotWalkable(node);
  if (!why.empty()) throw wrongPlace({file, 1}, why + ", expected a file of keys and values");
  return node;
}

std::optional<std::int64_t> wholeNumber(const std::string& text) {
  static const std::regex kDecimal("[-+]?[0-9]{1,15}");
  static const std::regex kHex("0[xX][0-9a-fA-F]{1,8}");
  if (std::regex_match(text, kDecimal)) return std::stoll(text);
  if (std::regex_match(text, kHex)) return std::stoll(text.substr(2), nullptr, 16);
  return std::nullopt;
}

std::optional<double> decimalNumber(const std::string& text) {
  static const std::regex kFraction(R"([-+]?([0-9]{1,15}(\.[0-9]{0,9})?|\.[0-9]{1,9}))");
  if (const auto whole = wholeNumber(text)) return static_cast<double>(*whole);
  if (!std::regex_match(text, kFraction)) return std::nullopt;
  return YAML::Node(text).as<double>();
}

YamlMap::YamlMap(std::string file, std::string path, const YAML::Node& node)
    : file_(std::move(file)), path_(std::move(path)), node_(node) {
  if (!node_.IsMap()) throw wrongValue(file_, node_, path_, "a group of keys and values");
  std::vector<std::string> keys;
  for (const auto& member : node_) {
    if (!member.first.IsScalar()) throw wrongValue(file_, member.first, path_, "a key");
    const std::string key = member.first.Scalar();
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
      throw wrongPlace(placeOf(file_, member.first), pathOf(key) + " stands here twice, expected every key once");
    }
    keys.push_back(key);
  }
}

YAML::Node YamlMap::find(const std::string& key) const {
  for (const auto& member : node_) {
    if (member.first.Scalar() == key) return member.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

YAML::Node YamlMap::node(const std::string& key) {
  asked_.push_back(key);
  return find(key);
}

std::optional<std::string> YamlMap::text(const std::string& key) {
  const YAML::Node value = node(key);
  if (!value.IsDefined()) return std::nullopt;
  if (!value.IsScalar() || value.Scalar().empty()) throw wrong(key, "a text");
  return value.Scalar();
}

std::optional<double> YamlMap::number(const std::string& key) {
  const YAML::Node value = node(key);
  if (!value.IsDefined()) return std::nullopt;
  const auto result = value.IsScalar() ? decimalNumber(value.Scalar()) : std::nullopt;
  if (!result) throw wrong(key, "a number");
  return result;
}

std::optional<std::int64_t> YamlMap::integer(const std::string& key) {
  const YAML::Node value = node(key);
  if (!value.IsDefined()) return std::nullopt;
  const auto result = value.IsScalar() ? wholeNumber(value.Scalar()) : std::nullopt;
  if (!result) throw wrong(key, "a whole number");
  return result;
}

std::optional<bool> YamlMap::flag(const std::string& key) {
  const YAML::Node value = node(key);
  if (!value.IsDefined()) return std::nullopt;
  if (value.IsScalar() && value.Scalar() == "true") return true;
  if (value.IsScalar() && value.Scalar() == "false") return false;
  throw wrong(key, "true or false");
}

std::vector<std::string> YamlMap::texts(const std::string& key) {
  const YAML::Node value = node(key);
  if (!value.IsDefined()) return {};
  if (value.IsScalar() && !value.Scalar().empty()) return {value.Scalar()};
  if (!value.IsSequence() || value.size() == 0) throw wrong(key, "a text or a list of texts");
  std::vector<std::string> list;
  for (const YAML::Node& item : value) {
    if (!item.IsScalar() || item.Scalar().empty()) throw wrongValue(file_, item, pathOf(key), "a list of texts");
    list.push_back(item.Scalar());
  }
  return list;
}

void YamlMap::rejectUnknown() const {
  for (const auto& member : node_) {
    const std::string key = member.first.Scalar();
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    const std::string nearest = nearestName(key, asked_);
    std::string known;
    for (const std::string& name : asked_) known += (known.empty() ? "" : ", ") + name;
    throw wrongPlace(placeOf(file_, member.first),
                     pathOf(key) + " is not a key of this file, expected " +
                         (nearest.empty() ? "one of " + known : "perhaps \"" + nearest + "\""));
  }
}

// At the line of the key: a value that is absent has the place of what follows it.
ConfigError YamlMap::wrong(const std::string& key, const std::string& expected) const {
  for (const auto& member : node_) {
    if (member.first.Scalar() != key) continue;
    return wrongPlace(placeOf(file_, member.first),
                      pathOf(key) + ": " + printed(member.second) + " is not valid, expected " + expected);
  }
  return missing(key, expected);
}

ConfigError YamlMap::missing(const std::string& key, const std::string& expected) const {
  return wrongPlace(place(), pathOf(key) + " is missing, expected " + expected);
}

Place YamlMap::place() const {
  return placeOf(file_, node_);
}

std::string YamlMap::pathOf(const std::string& key) const {
  return path_.empty() ? key : path_ + ": " + key;
}

}  // namespace nord_driver::catalogue
