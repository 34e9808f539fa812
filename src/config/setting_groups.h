// Groups whose keys are names a user has chosen: the signals and the setpoints of a drive.
#pragma once

#include <string>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver {

/// Settings that can tell what stands in a group are this as well. An interface beside Settings: a transport of
/// somebody else, which is built against that one, knows of none.
class SettingGroups {
 public:
  SettingGroups() = default;
  SettingGroups(const SettingGroups&) = default;
  SettingGroups& operator=(const SettingGroups&) = default;
  virtual ~SettingGroups() = default;

  /// The keys in the group at `key`, which is no path, sorted; none when it is no group. Does not count as asking.
  virtual std::vector<std::string> keysBelow(const std::string& key) const = 0;
};

/// The same; none where `settings` cannot tell.
std::vector<std::string> keysBelow(const Settings& settings, const std::string& key);

/// The names in the group at `key`, each checked: topics are named after them. None when it is absent. Throws
/// ConfigError where it is no group, or a name is not letters, digits and underscores beginning with a letter.
std::vector<std::string> namesIn(const Settings& settings, const std::string& key);

/// Letters, digits and underscores, beginning with a letter: what may be a part of a topic's name.
bool isRosName(const std::string& name);

}  // namespace nord_driver
