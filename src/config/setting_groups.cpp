#include "config/setting_groups.h"

#include <algorithm>
#include <cctype>

namespace nord_driver {

std::vector<std::string> keysBelow(const Settings& settings, const std::string& key) {
  const auto* const groups = dynamic_cast<const SettingGroups*>(&settings);
  return groups == nullptr ? std::vector<std::string>{} : groups->keysBelow(key);
}

std::vector<std::string> namesIn(const Settings& settings, const std::string& key) {
  std::vector<std::string> names = keysBelow(settings, key);
  const std::vector<std::string> present = settings.keys();
  if (names.empty() && std::find(present.begin(), present.end(), key) != present.end() && settings.has(key)) {
    settings.has(key + "/name");  // throws: a key in what is no group; its sentence has the value
    throw ConfigError(settings.fullName(key) + " is not valid, expected a group of names with what each is");
  }
  for (const std::string& name : names) {
    if (isRosName(name)) continue;
    throw ConfigError(settings.fullName(key) + ": \"" + name +
                      "\" is not valid, expected a name of letters, digits and underscores that begins with a letter");
  }
  return names;
}

bool isRosName(const std::string& name) {
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

}  // namespace nord_driver
