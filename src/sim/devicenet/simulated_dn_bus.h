// DeviceNet modules on a CAN bus in simulated time.
#pragma once

#include "sim/can/timed_can_bus.h"
#include "sim/devicenet/dn_stations.h"

namespace nord_driver::sim {

class SimulatedDnBus : public TimedCanBus {
 public:
  /// `DnBusConfig` gives the bit rate. Throws ConfigError as DnStations does.
  explicit SimulatedDnBus(const SimConfig& config, const CanBusSettings& settings = CanBusSettings{})
      : TimedCanBus(config.bus.as<DnBusConfig>().bit_rate, settings), robot_(config), stations_(robot_) {
    start(stations_);
  }

  RobotSim& robot() noexcept { return robot_; }
  DnStations& stations() noexcept { return stations_; }
  DnReferee& referee() noexcept { return stations_.referee(); }
  DriveUnit& drive(std::size_t index) noexcept { return robot_.drive(index); }
  /// The module of drive `index`.
  DnModule& module(std::size_t index) noexcept { return stations_.moduleOf(index); }

 private:
  RobotSim robot_;
  DnStations stations_;
};

}  // namespace nord_driver::sim
