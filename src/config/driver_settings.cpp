#include "config/driver_settings.h"

namespace nord_driver {

namespace {

constexpr const char* kDefaultTransport = "nord_driver/profibus_dp";

}  // namespace

std::string readTransportName(const Settings& settings) {
  const std::string name = settings.text("transport").value_or(kDefaultTransport);
  return name.find('/') == std::string::npos ? "nord_driver/" + name : name;
}

std::vector<DriveSettings> readDriveList(const TreeSettings& settings) {
  const auto group = settings.group("drives");
  std::vector<DriveSettings> drives;
  for (const std::string& name : group->keys()) drives.push_back({name, group->group(name)});
  return drives;
}

}  // namespace nord_driver
