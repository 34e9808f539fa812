// A simulated InterBus ring of SK 500E for tests.
#pragma once

#include <string>

#include "sim/interbus/ibs_config.h"

namespace nord_driver::sim {

inline DriveConfig ringDrive(const std::string& name, std::uint8_t place, const IbsDriveConfig& bus = {}) {
  DriveConfig drive;
  drive.name = name;
  drive.address = place;
  drive.bus = bus;
  return drive;
}

/// Inputs at register 0, outputs at 100, running at 200, watchdog at 300.
inline SimConfig ringConfig(std::size_t drives = 2) {
  IbsBusConfig bus;
  bus.output_address = 100;
  bus.running = IbsRunning{200, 1, 1};
  bus.watchdog = 300;
  SimConfig config;
  config.bus = bus;
  for (std::size_t i = 0; i < drives; ++i) {
    config.drives.push_back(ringDrive("drive" + std::to_string(i), static_cast<std::uint8_t>(i + 1)));
  }
  return config;
}

}  // namespace nord_driver::sim
