// A value of a configuration, whatever it was read from: a parameter server or a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nord_driver {

struct SettingValue {
  enum class Kind : std::uint8_t {
    kNone,  ///< absent, or a key without a value
    kText,
    kInteger,
    kFraction,
    kBoolean,
    kList,
    kGroup,
    kOther,  ///< of a kind no setting has
  };

  Kind kind = Kind::kNone;
  std::string text;  ///< of a text itself; of the others what a refusal prints
  std::int64_t integer = 0;
  double number = 0.0;  ///< of an integer as well
  bool boolean = false;
  std::vector<SettingValue> items;  ///< of a list, and the values of a group
  std::vector<std::string> names;   ///< of a group: the keys of `items`, sorted

  static SettingValue ofText(std::string text);
  static SettingValue ofInteger(std::int64_t value, std::string printed);
  static SettingValue ofFraction(double value, std::string printed);
  static SettingValue ofBoolean(bool value, std::string printed);
  static SettingValue list();
  static SettingValue group();
  static SettingValue other(std::string printed);

  /// Into a group, in any order.
  void add(const std::string& name, SettingValue value);
  /// The same where the name may be a path: "linear/x" becomes the group "x" in the group "linear", which others may
  /// fill as well. Two groups of one name become one.
  void addAt(const std::string& path, SettingValue value);
  /// Of a group; nullptr when there is none.
  const SettingValue* find(const std::string& name) const;
  /// As a refusal names it: "\"fast\"", "2.5", "a list".
  std::string printed() const;
};

}  // namespace nord_driver
