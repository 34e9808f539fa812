// Settings over a tree of values: what the parameter server and a file have in common.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "config/setting_groups.h"
#include "config/setting_value.h"
#include "nord_driver/config/settings.h"

namespace nord_driver {

/// A group of the configuration ("~", "~bus", "drives/left"), taken once. Keys may hold slashes
/// ("linear/x/max_velocity"). Remembers what was asked for. Not thread-safe: used while configuring.
class TreeSettings : public Settings, public SettingGroups {
 public:
  /// `value` is a group, or kNone for an absent one. Throws ConfigError when it is anything else.
  TreeSettings(std::string prefix, SettingValue value);

  bool has(const std::string& key) const override;
  std::optional<double> number(const std::string& key) const override;
  std::optional<std::int64_t> integer(const std::string& key) const override;
  std::optional<bool> boolean(const std::string& key) const override;
  std::optional<std::string> text(const std::string& key) const override;
  std::optional<std::vector<std::string>> texts(const std::string& key) const override;
  /// Sorted.
  std::vector<std::string> keys() const override;
  std::string fullName(const std::string& key) const override;

  /// As texts(), where a whole number is the text of it: "728".
  virtual std::optional<std::vector<std::string>> words(const std::string& key) const;
  /// Of the group at `key`, which is no path; empty when it is none. Does not count as asking.
  std::vector<std::string> keysBelow(const std::string& key) const override;
  /// A list of numbers.
  virtual std::optional<std::vector<double>> numbers(const std::string& key) const;
  /// The group below `key`; an empty one when it is absent.
  virtual std::shared_ptr<TreeSettings> group(const std::string& key) const;
  /// The same group without `key`, which is no path.
  std::shared_ptr<TreeSettings> without(const std::string& key) const;
  /// The same group with `text` at `key`, which is no path.
  std::shared_ptr<TreeSettings> with(const std::string& key, const std::string& text) const;
  /// Marks a key as known without reading it.
  void accept(const std::string& key) const { asked_.insert(key); }

  /// One sentence per key that is there and that nobody asked for, with the nearest known name. `node`: whose
  /// parameters they are, if any node's: parameters outlive the node that had them, so the sentence says how to delete
  /// one.
  std::vector<std::string> unknownKeys(const std::string& node = {}) const;

 private:
  const SettingValue* find(const std::string& key) const;  // nullptr when it is absent or has no value
  /// A list, or the one item of one.
  std::optional<std::vector<std::string>> list(const std::string& key, bool (*is_item)(const SettingValue&)) const;
  ConfigError wrongKind(const std::string& key, const SettingValue& value, const std::string& expected) const;
  /// The same for an item of a list.
  ConfigError wrongItem(const std::string& key, const SettingValue& item, const std::string& expected) const;
  bool isKnown(const std::string& leaf) const;

  std::string prefix_;
  SettingValue value_;
  mutable std::set<std::string> asked_;
};

}  // namespace nord_driver
