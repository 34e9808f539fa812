// The settings of a DeviceNet bus with a few drives, to be changed one by one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "support/map_settings.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver::test {

struct DevicenetSettings {
  /// Modules with one inverter each, MAC ids 5, 6, ...
  explicit DevicenetSettings(std::size_t count = 2) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "drive" + std::to_string(i);
      settings.push_back(std::make_shared<MapSettings>("~drives/" + name + "/"));
      settings.back()->set("address", static_cast<int>(5 + i)).set("series", "sk2xxe").set("pole_pairs", 2);
      drives.push_back({name, settings.back()});
    }
  }
  /// Inverters behind one SK CU4-DEV at MAC id 5.
  static DevicenetSettings gateway(std::size_t count = 2, int assembly = 102) {
    DevicenetSettings result{count};
    for (std::size_t i = 0; i < count; ++i) {
      result.settings[i]->set("address", 5).set("inverter", static_cast<int>(i + 1)).set("assembly", assembly);
    }
    return result;
  }
  MapSettings& drive(std::size_t i = 0) { return *settings[i]; }
  DevicenetConfig read(double cycle_rate = 100.0) const { return readDevicenetConfig(bus, drives, cycle_rate); }
  std::string refusal(double cycle_rate = 100.0) const {
    try {
      read(cycle_rate);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", 500'000}, {"serial_number", 0x11223344}}};
  std::vector<std::shared_ptr<MapSettings>> settings;
  std::vector<DriveSettings> drives;
};

}  // namespace nord_driver::test
