#include "config/tree_settings.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "config/nearest_name.h"
#include "config/yaml_number.h"

namespace nord_driver {

namespace {

using Kind = SettingValue::Kind;

constexpr const char* kAGroup = "a group of keys and values";

// An integer is a number all the same: rosparam makes one of "1".
bool isNumber(const SettingValue& value) {
  return value.kind == Kind::kInteger || value.kind == Kind::kFraction;
}

bool readsAsNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

// What to do about the slips of YAML that are made most.
std::string remedyOf(const SettingValue& value, const std::string& expected) {
  const bool quoted_number = expected.find("number") != std::string::npos && readsAsNumber(value.text);
  const bool quoted_flag = expected == "true or false" && (value.text == "true" || value.text == "false");
  if (value.kind == Kind::kText && quoted_number && !isYamlInteger(value.text) && !isYamlFraction(value.text)) {
    return ": YAML takes " + value.text + " for a text, write " + yamlNumber(std::strtod(value.text.c_str(), nullptr));
  }
  if (value.kind == Kind::kText && (quoted_number || quoted_flag)) return ": write " + value.text + " without quotes";
  if (value.kind == Kind::kList && expected == kAGroup) return ": write \"name: ...\" in place of \"- ...\"";
  return "";
}

void collectLeaves(const SettingValue& group, const std::string& prefix, std::vector<std::string>& names) {
  for (std::size_t i = 0; i < group.names.size(); ++i) {
    const std::string name = prefix + group.names[i];
    if (group.items[i].kind == Kind::kGroup) {
      collectLeaves(group.items[i], name + "/", names);
    } else {
      names.push_back(name);
    }
  }
}

}  // namespace

TreeSettings::TreeSettings(std::string prefix, SettingValue value)
    : prefix_(std::move(prefix)), value_(std::move(value)) {
  if (value_.kind != Kind::kGroup && value_.kind != Kind::kNone) throw wrongKind("", value_, kAGroup);
}

const SettingValue* TreeSettings::find(const std::string& key) const {
  asked_.insert(key);
  const SettingValue* at = &value_;
  std::istringstream parts(key);
  std::string path;
  for (std::string part; std::getline(parts, part, '/'); path += (path.empty() ? "" : "/") + part) {
    if (at->kind == Kind::kNone) return nullptr;
    if (at->kind != Kind::kGroup) throw wrongKind(path, *at, kAGroup);
    at = at->find(part);
    if (at == nullptr) return nullptr;
  }
  return at->kind == Kind::kNone ? nullptr : at;
}

ConfigError TreeSettings::wrongKind(const std::string& key, const SettingValue& value,
                                    const std::string& expected) const {
  return ConfigError(fullName(key) + ": " + value.printed() + " is not valid, expected " + expected +
                     remedyOf(value, expected));
}

ConfigError TreeSettings::wrongItem(const std::string& key, const SettingValue& item,
                                    const std::string& expected) const {
  if (item.kind != Kind::kList) return wrongKind(key, item, expected);
  return ConfigError(fullName(key) + ": a list of lists is not valid, expected " + expected +
                     ": take one pair of brackets away");
}

bool TreeSettings::has(const std::string& key) const {
  return find(key) != nullptr;
}

std::optional<double> TreeSettings::number(const std::string& key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!isNumber(*value)) throw wrongKind(key, *value, "a number");
  return value->number;
}

std::optional<std::vector<double>> TreeSettings::numbers(const std::string& key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != Kind::kList) throw wrongKind(key, *value, "a list of numbers");
  std::vector<double> list;
  for (const SettingValue& item : value->items) {
    if (!isNumber(item)) throw wrongItem(key, item, "a list of numbers");
    list.push_back(item.number);
  }
  return list;
}

std::optional<std::int64_t> TreeSettings::integer(const std::string& key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == Kind::kInteger) return value->integer;
  if (value->kind == Kind::kFraction) {
    // Beyond 2^53 not every whole number is a double, and a cast is undefined where none fits.
    constexpr double kLargest = 9007199254740992.0;
    const double number = value->number;
    if (std::abs(number) <= kLargest && std::trunc(number) == number) return static_cast<std::int64_t>(number);
  }
  throw wrongKind(key, *value, "a whole number");
}

std::optional<bool> TreeSettings::boolean(const std::string& key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != Kind::kBoolean) throw wrongKind(key, *value, "true or false");
  return value->boolean;
}

std::optional<std::string> TreeSettings::text(const std::string& key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != Kind::kText) throw wrongKind(key, *value, "a text");
  return value->text;
}

std::optional<std::vector<std::string>> TreeSettings::texts(const std::string& key) const {
  return list(key, [](const SettingValue& item) { return item.kind == Kind::kText; });
}

std::optional<std::vector<std::string>> TreeSettings::words(const std::string& key) const {
  return list(key, [](const SettingValue& item) { return item.kind == Kind::kText || item.kind == Kind::kInteger; });
}

std::optional<std::vector<std::string>> TreeSettings::list(const std::string& key,
                                                           bool (*is_item)(const SettingValue&)) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (is_item(*value)) return std::vector<std::string>{value->text};
  if (value->kind != Kind::kList) throw wrongKind(key, *value, "a text or a list of texts");
  std::vector<std::string> items;
  for (const SettingValue& item : value->items) {
    if (!is_item(item)) throw wrongItem(key, item, "a list of texts");
    items.push_back(item.text);
  }
  return items;
}

std::string TreeSettings::fullName(const std::string& key) const {
  return prefix_ + (prefix_ == "~" || prefix_.empty() || key.empty() ? "" : "/") + key;
}

std::shared_ptr<TreeSettings> TreeSettings::group(const std::string& key) const {
  const SettingValue* value = find(key);
  return std::make_shared<TreeSettings>(fullName(key), value == nullptr ? SettingValue{} : *value);
}

std::shared_ptr<TreeSettings> TreeSettings::without(const std::string& key) const {
  SettingValue changed = SettingValue::group();
  for (std::size_t i = 0; i < value_.names.size(); ++i) {
    if (value_.names[i] != key) changed.add(value_.names[i], value_.items[i]);
  }
  return std::make_shared<TreeSettings>(prefix_, std::move(changed));
}

std::shared_ptr<TreeSettings> TreeSettings::with(const std::string& key, const std::string& text) const {
  std::shared_ptr<TreeSettings> changed = without(key);
  changed->value_.add(key, SettingValue::ofText(text));
  return changed;
}

std::vector<std::string> TreeSettings::keys() const {
  return value_.names;
}

std::vector<std::string> TreeSettings::keysBelow(const std::string& key) const {
  const SettingValue* const value = value_.find(key);
  return value == nullptr || value->kind != Kind::kGroup ? std::vector<std::string>{} : value->names;
}

// It was asked for itself, or a group it lies in was handed out.
bool TreeSettings::isKnown(const std::string& leaf) const {
  bool known = asked_.count(leaf) != 0;
  for (std::size_t slash = leaf.find('/'); slash != std::string::npos && !known; slash = leaf.find('/', slash + 1)) {
    known = asked_.count(leaf.substr(0, slash)) != 0;
  }
  return known;
}

std::vector<std::string> TreeSettings::unknownKeys(const std::string& node) const {
  std::vector<std::string> sentences;
  std::vector<std::string> leaves;
  collectLeaves(value_, "", leaves);
  for (const std::string& name : leaves) {
    if (isKnown(name)) continue;
    const std::string nearest = nearestName(name, {asked_.begin(), asked_.end()});
    std::string sentence = fullName(name) + " is not known and is ignored";
    if (!nearest.empty()) sentence += "; did you mean " + fullName(nearest) + "?";
    if (!node.empty()) {
      sentence += (nearest.empty() ? "; left" : " Left") +
                  std::string(" over from an earlier start? rosparam delete ") + node + "/" + fullName(name).substr(1);
    }
    sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace nord_driver
