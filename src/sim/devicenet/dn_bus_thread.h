// The simulated DeviceNet modules on a real or virtual CAN bus, in real time.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "sim/can/can_thread.h"
#include "sim/devicenet/dn_stations.h"

namespace nord_driver::sim {

/// Serves from construction to destruction.
class DnBusThread final : public CanThread {
 public:
  /// On `DnBusConfig::interface`. Throws std::runtime_error naming the interface and the reason, and ConfigError as
  /// DnStations does.
  explicit DnBusThread(const SimConfig& config) : DnBusThread(config, linkTo(config.bus.as<DnBusConfig>().interface)) {}
  /// On this link.
  DnBusThread(const SimConfig& config, std::unique_ptr<link::CanLink> link)
      : CanThread(config.bus.as<DnBusConfig>().interface, std::move(link)), robot_(config), stations_(robot_) {
    start(stations_);
  }
  ~DnBusThread() override { stop(); }
  DnBusThread(const DnBusThread&) = delete;
  DnBusThread& operator=(const DnBusThread&) = delete;

  /// Runs `function(DnStations&)` while the models stand still. Any thread.
  template <typename Function>
  auto withStations(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(stations_);
  }

 private:
  RobotSim& robot() noexcept override { return robot_; }

  RobotSim robot_;
  DnStations stations_;
};

}  // namespace nord_driver::sim
