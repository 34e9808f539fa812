// CANopen nodes on a CAN bus in simulated time.
#pragma once

#include "sim/can/timed_can_bus.h"
#include "sim/canopen/can_stations.h"

namespace nord_driver::sim {

class SimulatedCanBus : public TimedCanBus {
 public:
  /// `CanBusConfig` gives the bit rate. Throws ConfigError as CanStations does.
  explicit SimulatedCanBus(const SimConfig& config, const CanBusSettings& settings = CanBusSettings{})
      : TimedCanBus(config.bus.as<CanBusConfig>().bit_rate, settings), robot_(config), stations_(robot_) {
    start(stations_);
  }

  RobotSim& robot() noexcept { return robot_; }
  CanStations& stations() noexcept { return stations_; }
  CanReferee& referee() noexcept { return stations_.referee(); }
  DriveUnit& drive(std::size_t index) noexcept { return robot_.drive(index); }
  /// The node of drive `index`.
  CanNode& node(std::size_t index) noexcept { return stations_.nodeOf(index); }

 private:
  RobotSim robot_;
  CanStations stations_;
};

}  // namespace nord_driver::sim
