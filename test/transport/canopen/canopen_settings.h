// The settings of a CANopen bus with a few drives, to be changed one by one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "support/map_settings.h"
#include "transport/canopen/canopen_config.h"

namespace nord_driver::test {

struct CanopenSettings {
  explicit CanopenSettings(std::size_t count = 2) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "drive" + std::to_string(i);
      settings.push_back(std::make_shared<MapSettings>("~drives/" + name + "/"));
      settings.back()->set("address", static_cast<int>(3 + i)).set("series", "sk5xxe").set("pole_pairs", 2);
      drives.push_back({name, settings.back()});
    }
  }
  /// Two inverters behind one SK CU4-CAO.
  static CanopenSettings gateway() {
    CanopenSettings result;
    for (std::size_t i = 0; i < 2; ++i) {
      result.settings[i]->set("address", 10).set("series", "sk2xxe").set("connection", "gateway");
      result.settings[i]->set("inverter", static_cast<int>(i + 1));
    }
    return result;
  }
  MapSettings& drive(std::size_t i = 0) { return *settings[i]; }
  CanopenConfig read(double cycle_rate = 100.0) const { return readCanopenConfig(bus, drives, cycle_rate); }
  std::string refusal(double cycle_rate = 100.0) const {
    try {
      read(cycle_rate);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}}};
  std::vector<std::shared_ptr<MapSettings>> settings;
  std::vector<DriveSettings> drives;
};

}  // namespace nord_driver::test
