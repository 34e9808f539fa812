#include "catalogue/device.h"

namespace nord_driver::catalogue {

namespace {

const char* moduleName(Module module) noexcept {
  switch (module) {
    case Module::kProfibus:
      return "module_profibus";
    case Module::kCanopen:
      return "module_canopen";
    case Module::kDevicenet:
      return "module_devicenet";
    case Module::kInterbus:
      return "module_interbus";
  }
  return "";
}

}  // namespace

std::optional<Module> moduleOf(const std::string& transport) {
  if (transport == "profibus_dp" || transport == "profibus_ms2") return Module::kProfibus;
  if (transport == "canopen") return Module::kCanopen;
  if (transport == "devicenet") return Module::kDevicenet;
  if (transport == "interbus") return Module::kInterbus;
  return std::nullopt;
}

std::string toString(const Device& device) {
  if (const auto* series = std::get_if<profile::Series>(&device)) return profile::toString(*series);
  return moduleName(std::get<Module>(device));
}

std::optional<Device> deviceFrom(const std::string& name) {
  for (const Device& device : allDevices()) {
    if (toString(device) == name) return device;
  }
  return std::nullopt;
}

std::vector<Device> allDevices() {
  std::vector<Device> devices(profile::kAllSeries.begin(), profile::kAllSeries.end());
  devices.insert(devices.end(), kAllModules.begin(), kAllModules.end());
  return devices;
}

}  // namespace nord_driver::catalogue
