// What a reader of the configuration says of a key while it reads it: its kind, unit, range and default. Nobody listens
// while a driver runs; what makes doc/parameters.md does.
#pragma once

#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver {

struct SettingNote {
  std::string kind;      ///< "a number", "a whole number", "true or false", "a text", "one of ..."
  std::string range;     ///< "0.01 to 650"; empty: there is none, or the kind says it
  std::string unit;      ///< "s", "Hz"; empty: there is none
  std::string fallback;  ///< its value where the key is absent, as it would be written; empty: none
};

/// Settings that listen are this as well.
class SettingListener {
 public:
  SettingListener() = default;
  SettingListener(const SettingListener&) = delete;
  SettingListener& operator=(const SettingListener&) = delete;
  virtual ~SettingListener() = default;

  /// A later note of the same key says the same, or it more narrowly.
  virtual void listen(const std::string& key, const SettingNote& note) const = 0;
};

/// Tells `settings`, if they listen. An interface beside Settings: a transport of somebody else, which is built against
/// that one, knows of no notes.
void noteSetting(const Settings& settings, const std::string& key, const SettingNote& note);

}  // namespace nord_driver
