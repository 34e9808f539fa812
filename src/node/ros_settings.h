// The private parameters of the node as Settings, with a memory of what was asked for.
#pragma once

#include <XmlRpcValue.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver::node {

/// A group of parameters ("~", "~bus", "~drives/left") taken from the parameter server once. Keys may hold slashes
/// ("linear/x/max_velocity"). Not thread-safe: used while configuring.
class RosSettings final : public Settings {
 public:
  /// `value` is a struct, or invalid for an absent group. Throws ConfigError when it is anything else.
  RosSettings(std::string prefix, const XmlRpc::XmlRpcValue& value);

  bool has(const std::string& key) const override;
  std::optional<double> number(const std::string& key) const override;
  std::optional<std::int64_t> integer(const std::string& key) const override;
  std::optional<bool> boolean(const std::string& key) const override;
  std::optional<std::string> text(const std::string& key) const override;
  std::optional<std::vector<std::string>> texts(const std::string& key) const override;
  std::vector<std::string> keys() const override;
  std::string fullName(const std::string& key) const override;

  /// A list of numbers.
  std::optional<std::vector<double>> numbers(const std::string& key) const;
  /// The group below `key`; an empty one when it is absent.
  std::shared_ptr<RosSettings> group(const std::string& key) const;
  /// The same group with `text` at `key`.
  std::shared_ptr<RosSettings> with(const std::string& key, const std::string& text) const;
  /// Marks a key as known without reading it.
  void accept(const std::string& key) const { asked_.insert(key); }

  /// One sentence per key that is there and that nobody asked for, with the nearest known name.
  std::vector<std::string> unknownKeys() const;

 private:
  std::optional<XmlRpc::XmlRpcValue> find(const std::string& key) const;
  ConfigError wrongKind(const std::string& key, const XmlRpc::XmlRpcValue& value, const std::string& expected) const;

  std::string prefix_;
  XmlRpc::XmlRpcValue value_;
  mutable std::set<std::string> asked_;
};

}  // namespace nord_driver::node
