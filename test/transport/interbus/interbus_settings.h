// The settings of an InterBus ring with a few drives, to be changed one by one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "support/map_settings.h"
#include "transport/interbus/interbus_config.h"

namespace nord_driver::test {

struct InterbusSettings {
  explicit InterbusSettings(std::size_t count = 2) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "drive" + std::to_string(i);
      settings.push_back(std::make_shared<MapSettings>("~drives/" + name + "/"));
      settings.back()->set("address", static_cast<int>(1 + i)).set("series", "sk5xxe").set("pole_pairs", 2);
      settings.back()->set("max_frequency", 50.0);
      drives.push_back({name, settings.back()});
    }
  }
  MapSettings& drive(std::size_t i = 0) { return *settings[i]; }
  InterbusConfig read(double cycle_rate = 100.0) const { return readInterbusConfig(bus, drives, cycle_rate); }
  std::string refusal(double cycle_rate = 100.0) const {
    try {
      read(cycle_rate);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  MapSettings bus{"~bus/", {{"gateway", std::string{"192.168.0.10:502"}}}};
  std::vector<std::shared_ptr<MapSettings>> settings;
  std::vector<DriveSettings> drives;
};

}  // namespace nord_driver::test
