// The simulated CANopen nodes on a real or virtual CAN bus, in real time.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "sim/can/can_thread.h"
#include "sim/canopen/can_stations.h"

namespace nord_driver::sim {

/// Serves from construction to destruction.
class CanBusThread final : public CanThread {
 public:
  /// On `CanBusConfig::interface`. Throws std::runtime_error naming the interface and the reason, and ConfigError as
  /// CanStations does.
  explicit CanBusThread(const SimConfig& config)
      : CanBusThread(config, linkTo(config.bus.as<CanBusConfig>().interface)) {}
  /// On this link.
  CanBusThread(const SimConfig& config, std::unique_ptr<link::CanLink> link)
      : CanThread(config.bus.as<CanBusConfig>().interface, std::move(link)), robot_(config), stations_(robot_) {
    start(stations_);
  }
  ~CanBusThread() override { stop(); }
  CanBusThread(const CanBusThread&) = delete;
  CanBusThread& operator=(const CanBusThread&) = delete;

  /// Runs `function(CanStations&)` while the models stand still. Any thread.
  template <typename Function>
  auto withStations(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(stations_);
  }

 private:
  RobotSim& robot() noexcept override { return robot_; }

  RobotSim robot_;
  CanStations stations_;
};

}  // namespace nord_driver::sim
