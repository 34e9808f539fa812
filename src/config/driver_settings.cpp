#include "config/driver_settings.h"

namespace nord_driver {

namespace {

constexpr const char* kDefaultTransport = "nord_driver/profibus_dp";
const std::string kPrefix = "nord_driver/";

}  // namespace

std::string readTransportName(const Settings& settings) {
  const std::string name = settings.text("transport").value_or(kDefaultTransport);
  return name.find('/') == std::string::npos ? kPrefix + name : name;
}

std::string shortTransportName(const std::string& name) {
  return name.compare(0, kPrefix.size(), kPrefix) == 0 ? name.substr(kPrefix.size()) : name;
}

std::vector<DriveSettings> readDriveList(const TreeSettings& settings) {
  const auto group = settings.group("drives");
  std::vector<DriveSettings> drives;
  for (const std::string& name : group->keys()) drives.push_back({name, group->group(name)});
  return drives;
}

}  // namespace nord_driver
