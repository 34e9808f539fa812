// One group of keys of the simulator's configuration, and the sentence that refuses a wrong value.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "sim/sim_config.h"

namespace nord_driver::sim {

inline std::string asText(const YAML::Node& node) {
  if (node.IsScalar()) return node.Scalar().empty() ? "\"\"" : node.Scalar();
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  return emitter.c_str();
}

[[noreturn]] inline void refuse(const std::string& key, const YAML::Node& node, const std::string& expected) {
  throw ConfigError(key + ": " + asText(node) + " is not valid; expected " + expected);
}

/// A whole number may be written as a fraction, 3.0, as the driver has it. Throws YAML::Exception.
template <typename T>
T valueOf(const YAML::Node& node) {
  T value{};
  if (YAML::convert<T>::decode(node, value)) return value;
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    static_assert(sizeof(T) < sizeof(double), "not every one is a double");
    const auto number = node.as<double>();
    const bool fits = number >= std::numeric_limits<T>::min() && number <= std::numeric_limits<T>::max();
    if (fits && std::trunc(number) == number) return static_cast<T>(number);
  }
  throw YAML::TypedBadConversion<T>(node.Mark());
}

/// One map of the configuration with the name a user knows it by.
class Group {
 public:
  Group(const YAML::Node& node, std::string name) : node_(node), name_(std::move(name)) {
    if (node_.IsDefined() && !node_.IsNull() && !node_.IsMap()) refuse(name_, node_, "a group of keys");
  }

  std::string keyName(const std::string& key) const { return name_.empty() ? key : name_ + "/" + key; }
  bool has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined() && !node_[key].IsNull(); }
  YAML::Node operator[](const std::string& key) const { return node_[key]; }

  template <typename T>
  T get(const std::string& key, T fallback, const std::string& expected,
        const std::function<bool(const T&)>& good = nullptr) const {
    if (!has(key)) return fallback;
    T value{};
    try {
      value = valueOf<T>(node_[key]);
    } catch (const YAML::Exception&) {
      refuse(keyName(key), node_[key], expected);
    }
    if (good && !good(value)) refuse(keyName(key), node_[key], expected);
    return value;
  }
  double positive(const std::string& key, double fallback) const {
    return get<double>(key, fallback, "a number greater than 0",
                       [](const double& value) { return std::isfinite(value) && value > 0.0; });
  }
  double notNegative(const std::string& key, double fallback) const {
    return get<double>(key, fallback, "a number not less than 0",
                       [](const double& value) { return std::isfinite(value) && value >= 0.0; });
  }
  int integer(const std::string& key, int fallback, int minimum, int maximum) const {
    return get<int>(key, fallback, "a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum),
                    [&](const int& value) { return value >= minimum && value <= maximum; });
  }
  /// One text or a list of them.
  std::vector<std::string> texts(const std::string& key) const {
    const YAML::Node node = node_[key];
    try {
      if (node.IsScalar()) return {node.as<std::string>()};
      return node.as<std::vector<std::string>>();
    } catch (const YAML::Exception&) {
      refuse(keyName(key), node, "a name or a list of names");
    }
  }

 private:
  YAML::Node node_;
  std::string name_;
};

}  // namespace nord_driver::sim
