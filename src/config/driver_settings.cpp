#include "config/driver_settings.h"

#include <algorithm>

#include "config/nearest_name.h"
#include "config/setting_checks.h"

namespace nord_driver {

namespace {

constexpr const char* kDefaultTransport = "nord_driver/profibus_dp";
const std::string kPrefix = "nord_driver/";

// "nord_driver: {bus: ..., drives: ...}": a file for rosparam in the root namespace, loaded below the node's name.
void refuseDeeperDrives(const TreeSettings& settings) {
  for (const std::string& key : settings.keys()) {
    const auto names = settings.keysBelow(key);
    if (std::find(names.begin(), names.end(), "drives") == names.end()) continue;
    throw ConfigError(settings.fullName("drives") + " is missing, but there is " + settings.fullName(key + "/drives") +
                      ": the file is nested one level too deep; take the line \"" + key +
                      ":\" away and move what is below it to the left");
  }
}

}  // namespace

std::string readTransportName(const Settings& settings) {
  const std::string name = textOr(settings, "transport", kDefaultTransport);
  return name.find('/') == std::string::npos ? kPrefix + name : name;
}

std::string shortTransportName(const std::string& name) {
  return name.compare(0, kPrefix.size(), kPrefix) == 0 ? name.substr(kPrefix.size()) : name;
}

ConfigError unknownTransport(const Settings& settings, const std::string& name,
                             const std::vector<std::string>& declared) {
  std::string known;
  std::vector<std::string> names;
  for (const std::string& transport : declared) {
    names.push_back(shortTransportName(transport));
    known += (known.empty() ? "" : ", ") + names.back();
  }
  const std::string given = shortTransportName(name);
  std::string nearest = nearestName(given, names);
  for (const std::string& candidate : names) {  // "profibus": shortened, not slipped
    if (nearest.empty() && candidate.compare(0, given.size(), given) == 0) nearest = candidate;
  }
  return ConfigError(settings.fullName("transport") + ": \"" + given +
                     "\" is not valid, expected one of the declared transports: " +
                     (known.empty() ? "none (is the workspace's setup file sourced?)" : known) +
                     (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

std::vector<DriveSettings> readDriveList(const TreeSettings& settings) {
  if (!settings.has("drives")) refuseDeeperDrives(settings);
  const auto group = settings.group("drives");
  std::vector<DriveSettings> drives;
  for (const std::string& name : group->keys()) drives.push_back({name, group->group(name)});
  return drives;
}

}  // namespace nord_driver
