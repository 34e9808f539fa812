#include "node/ros_settings.h"

#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "config/nearest_name.h"

namespace nord_driver::node {

using XmlRpc::XmlRpcValue;

namespace {

std::string printed(const XmlRpcValue& value) {
  std::ostringstream text;
  XmlRpcValue copy = value;  // XmlRpcValue prints only non-const values in some versions
  switch (copy.getType()) {
    case XmlRpcValue::TypeString:
      return "\"" + static_cast<std::string>(copy) + "\"";
    case XmlRpcValue::TypeStruct:
      return "a group";
    case XmlRpcValue::TypeArray:
      return "a list";
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(copy) ? "true" : "false";
    default:
      copy.write(text);
      return text.str();
  }
}

// rosparam makes an integer of "1": a number all the same.
std::optional<double> asNumber(XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<double>(value);
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<double>(static_cast<int>(value));
  return std::nullopt;
}

void collectLeaves(XmlRpcValue& value, const std::string& prefix, std::vector<std::string>& names) {
  for (auto& member : value) {
    const std::string name = prefix + member.first;
    if (member.second.getType() == XmlRpcValue::TypeStruct) {
      collectLeaves(member.second, name + "/", names);
    } else {
      names.push_back(name);
    }
  }
}

}  // namespace

RosSettings::RosSettings(std::string prefix, const XmlRpcValue& value) : prefix_(std::move(prefix)), value_(value) {
  if (value_.valid() && value_.getType() != XmlRpcValue::TypeStruct) {
    throw ConfigError(prefix_ + ": " + printed(value_) + " is not valid, expected a group of keys and values");
  }
}

std::optional<XmlRpcValue> RosSettings::find(const std::string& key) const {
  asked_.insert(key);
  if (!value_.valid()) return std::nullopt;
  XmlRpcValue at = value_;
  std::istringstream parts(key);
  std::string path;
  for (std::string part; std::getline(parts, part, '/'); path += (path.empty() ? "" : "/") + part) {
    if (at.getType() != XmlRpcValue::TypeStruct) throw wrongKind(path, at, "a group of keys and values");
    if (!at.hasMember(part)) return std::nullopt;
    XmlRpcValue next = at[part];
    at = next;
  }
  return at;
}

ConfigError RosSettings::wrongKind(const std::string& key, const XmlRpcValue& value,
                                   const std::string& expected) const {
  return ConfigError(fullName(key) + ": " + printed(value) + " is not valid, expected " + expected);
}

bool RosSettings::has(const std::string& key) const {
  return find(key).has_value();
}

std::optional<double> RosSettings::number(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  const auto number = asNumber(*value);
  if (!number) throw wrongKind(key, *value, "a number");
  return number;
}

std::optional<std::vector<double>> RosSettings::numbers(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  if (value->getType() != XmlRpcValue::TypeArray) throw wrongKind(key, *value, "a list of numbers");
  std::vector<double> list;
  for (int i = 0; i < value->size(); ++i) {
    const auto number = asNumber((*value)[i]);
    if (!number) throw wrongKind(key, (*value)[i], "a list of numbers");
    list.push_back(*number);
  }
  return list;
}

std::optional<std::int64_t> RosSettings::integer(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeInt) return static_cast<int>(*value);
  if (value->getType() == XmlRpcValue::TypeDouble) {
    const double number = static_cast<double>(*value);
    // Beyond 2^53 not every whole number is a double, and a cast is undefined where none fits.
    constexpr double kLargest = 9007199254740992.0;
    if (std::abs(number) <= kLargest && std::trunc(number) == number) return static_cast<std::int64_t>(number);
  }
  throw wrongKind(key, *value, "a whole number");
}

std::optional<bool> RosSettings::boolean(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  if (value->getType() != XmlRpcValue::TypeBoolean) throw wrongKind(key, *value, "true or false");
  return static_cast<bool>(*value);
}

std::optional<std::string> RosSettings::text(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  if (value->getType() != XmlRpcValue::TypeString) throw wrongKind(key, *value, "a text");
  return static_cast<std::string>(*value);
}

std::optional<std::vector<std::string>> RosSettings::texts(const std::string& key) const {
  auto value = find(key);
  if (!value) return std::nullopt;
  if (value->getType() == XmlRpcValue::TypeString) return std::vector<std::string>{static_cast<std::string>(*value)};
  if (value->getType() != XmlRpcValue::TypeArray) throw wrongKind(key, *value, "a text or a list of texts");
  std::vector<std::string> list;
  for (int i = 0; i < value->size(); ++i) {
    XmlRpcValue item = (*value)[i];
    if (item.getType() != XmlRpcValue::TypeString) throw wrongKind(key, item, "a list of texts");
    list.push_back(static_cast<std::string>(item));
  }
  return list;
}

std::string RosSettings::fullName(const std::string& key) const {
  return prefix_ + (prefix_ == "~" || prefix_.empty() || key.empty() ? "" : "/") + key;
}

std::shared_ptr<RosSettings> RosSettings::group(const std::string& key) const {
  const auto value = find(key);
  return std::make_shared<RosSettings>(fullName(key), value.value_or(XmlRpcValue{}));
}

std::shared_ptr<RosSettings> RosSettings::with(const std::string& key, const std::string& text) const {
  XmlRpcValue changed = value_;
  changed[key] = text;
  return std::make_shared<RosSettings>(prefix_, changed);
}

std::vector<std::string> RosSettings::keys() const {
  std::vector<std::string> names;
  if (!value_.valid()) return names;
  XmlRpcValue copy = value_;
  for (auto& member : copy) names.push_back(member.first);
  return names;
}

std::vector<std::string> RosSettings::unknownKeys() const {
  std::vector<std::string> sentences;
  if (!value_.valid()) return sentences;
  std::vector<std::string> leaves;
  XmlRpcValue copy = value_;
  collectLeaves(copy, "", leaves);
  for (const std::string& name : leaves) {
    // Known when it was asked for itself, or when a group it lies in was handed out.
    bool known = asked_.count(name) != 0;
    for (std::size_t slash = name.find('/'); slash != std::string::npos && !known; slash = name.find('/', slash + 1)) {
      known = asked_.count(name.substr(0, slash)) != 0;
    }
    if (known) continue;
    const std::string nearest = nearestName(name, {asked_.begin(), asked_.end()});
    sentences.push_back(fullName(name) + " is not known and is ignored" +
                        (nearest.empty() ? "" : "; did you mean " + fullName(nearest) + "?"));
  }
  return sentences;
}

}  // namespace nord_driver::node
