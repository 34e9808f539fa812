// The simulated CANopen nodes on a real or virtual CAN bus, in real time.
//
// A virtual bus between processes, or vcan, has no bit times; a real one has its own: nothing is delayed here but what
// the nodes themselves take.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "link/can/can_link.h"
#include "sim/canopen/can_stations.h"
#include "sim/running_bus.h"

namespace nord_driver::sim {

/// Serves from construction to destruction. An interface that is removed is opened again when it is back.
class CanBusThread : public RunningBus, private CanSink {
 public:
  /// On `CanBusConfig::interface`; "virtual:NAME" makes the bus itself. Throws std::runtime_error naming the interface
  /// and the reason, and ConfigError as CanStations does.
  explicit CanBusThread(const SimConfig& config);
  /// On this link.
  CanBusThread(const SimConfig& config, std::unique_ptr<link::CanLink> link);
  ~CanBusThread() override;
  CanBusThread(const CanBusThread&) = delete;
  CanBusThread& operator=(const CanBusThread&) = delete;

  std::string where() const override { return interface_; }
  /// Runs `function(CanStations&)` while the models stand still. Any thread.
  template <typename Function>
  auto withStations(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(stations_);
  }

 private:
  RobotSim& robot() noexcept override { return robot_; }
  std::string report() const override { return stations_.report(); }
  void transmit(const CanFrame& frame) noexcept override;
  void serve() noexcept;
  bool linkReady(Instant now) noexcept;
  void takeInput() noexcept;
  void sendWaiting() noexcept;

  RobotSim robot_;
  CanStations stations_;
  std::string interface_;
  std::unique_ptr<link::CanLink> link_;
  FixedVector<CanFrame, 256> waiting_;  // sent when the interface has room; more are lost
  Instant next_open_{};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace nord_driver::sim
