// Settings for tests, written down as key and value.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/setting_groups.h"
#include "nord_driver/config/settings.h"

namespace nord_driver::test {

class MapSettings final : public Settings, public SettingGroups {
 public:
  using Value = std::variant<double, int, bool, std::string, std::vector<std::string>>;

  MapSettings() = default;
  MapSettings(std::initializer_list<std::pair<const std::string, Value>> values) : values_(values) {}
  explicit MapSettings(std::string prefix, std::map<std::string, Value> values = {})
      : prefix_(std::move(prefix)), values_(std::move(values)) {}

  MapSettings& set(const std::string& key, Value value) {
    values_[key] = std::move(value);
    return *this;
  }
  /// Overload for literals, which would become a bool otherwise.
  MapSettings& set(const std::string& key, const char* value) { return set(key, Value{std::string{value}}); }
  MapSettings& erase(const std::string& key) {
    values_.erase(key);
    return *this;
  }

  bool has(const std::string& key) const override { return values_.count(key) != 0; }
  std::optional<double> number(const std::string& key) const override {
    if (const auto* value = find<int>(key)) return *value;
    return get<double>(key, "a number");
  }
  std::optional<std::int64_t> integer(const std::string& key) const override { return get<int>(key, "a whole number"); }
  std::optional<bool> boolean(const std::string& key) const override { return get<bool>(key, "true or false"); }
  std::optional<std::string> text(const std::string& key) const override { return get<std::string>(key, "a text"); }
  std::optional<std::vector<std::string>> texts(const std::string& key) const override {
    if (const auto* value = find<std::string>(key)) return std::vector<std::string>{*value};
    return get<std::vector<std::string>>(key, "a text or a list of texts");
  }
  std::vector<std::string> keys() const override {
    std::vector<std::string> names;
    for (const auto& entry : values_) names.push_back(entry.first);
    return names;
  }
  std::vector<std::string> keysBelow(const std::string& key) const override {
    std::set<std::string> names;
    for (const auto& entry : values_) {
      if (entry.first.compare(0, key.size() + 1, key + "/") != 0) continue;
      const std::string rest = entry.first.substr(key.size() + 1);
      names.insert(rest.substr(0, rest.find('/')));
    }
    return {names.begin(), names.end()};
  }
  std::string fullName(const std::string& key) const override { return prefix_ + key; }

 private:
  template <typename T>
  const T* find(const std::string& key) const {
    const auto at = values_.find(key);
    return at == values_.end() ? nullptr : std::get_if<T>(&at->second);
  }
  template <typename T>
  std::optional<T> get(const std::string& key, const std::string& expected) const {
    if (!has(key)) return std::nullopt;
    if (const T* value = find<T>(key)) return *value;
    throw ConfigError(fullName(key) + " is not valid, expected " + expected);
  }

  std::string prefix_;
  std::map<std::string, Value> values_;
};

}  // namespace nord_driver::test
