#include "config/setting_value.h"

#include <algorithm>
#include <utility>

namespace nord_driver {

SettingValue SettingValue::ofText(std::string text) {
  SettingValue result;
  result.kind = Kind::kText;
  result.text = std::move(text);
  return result;
}

SettingValue SettingValue::ofInteger(std::int64_t value, std::string printed) {
  SettingValue result;
  result.kind = Kind::kInteger;
  result.text = std::move(printed);
  result.integer = value;
  result.number = static_cast<double>(value);
  return result;
}

SettingValue SettingValue::ofFraction(double value, std::string printed) {
  SettingValue result;
  result.kind = Kind::kFraction;
  result.text = std::move(printed);
  result.number = value;
  return result;
}

SettingValue SettingValue::ofBoolean(bool value, std::string printed) {
  SettingValue result;
  result.kind = Kind::kBoolean;
  result.text = std::move(printed);
  result.boolean = value;
  return result;
}

SettingValue SettingValue::list() {
  SettingValue result;
  result.kind = Kind::kList;
  return result;
}

SettingValue SettingValue::group() {
  SettingValue result;
  result.kind = Kind::kGroup;
  return result;
}

SettingValue SettingValue::other(std::string printed) {
  SettingValue result;
  result.kind = Kind::kOther;
  result.text = std::move(printed);
  return result;
}

void SettingValue::add(const std::string& name, SettingValue value) {
  const auto at = std::lower_bound(names.begin(), names.end(), name);
  items.insert(items.begin() + (at - names.begin()), std::move(value));
  names.insert(at, name);
}

void SettingValue::addAt(const std::string& path, SettingValue value) {
  const std::size_t slash = path.find('/');
  const std::string name = path.substr(0, slash);
  const auto at = std::lower_bound(names.begin(), names.end(), name);
  const bool there = at != names.end() && *at == name;
  SettingValue* below = there ? &items[static_cast<std::size_t>(at - names.begin())] : nullptr;
  if (slash != std::string::npos) {
    if (below == nullptr) {
      add(name, group());
      return addAt(path, std::move(value));
    }
    if (below->kind != Kind::kGroup) *below = group();
    return below->addAt(path.substr(slash + 1), std::move(value));
  }
  if (below != nullptr && below->kind == Kind::kGroup && value.kind == Kind::kGroup) {
    for (std::size_t i = 0; i < value.names.size(); ++i) below->addAt(value.names[i], std::move(value.items[i]));
  } else if (below != nullptr) {
    *below = std::move(value);
  } else {
    add(name, std::move(value));
  }
}

const SettingValue* SettingValue::find(const std::string& name) const {
  const auto at = std::lower_bound(names.begin(), names.end(), name);
  if (at == names.end() || *at != name) return nullptr;
  return &items[static_cast<std::size_t>(at - names.begin())];
}

std::string SettingValue::printed() const {
  switch (kind) {
    case Kind::kText:
      return "\"" + text + "\"";
    case Kind::kList:
      return "a list";
    case Kind::kGroup:
      return "a group";
    default:
      return text;
  }
}

}  // namespace nord_driver
