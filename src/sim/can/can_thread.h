// Simulated nodes on a real or virtual CAN bus, in real time, whatever protocol they speak.
//
// A virtual bus between processes, or vcan, has no bit times; a real one has its own: nothing is delayed here but what
// the nodes themselves take.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "link/can/can_link.h"
#include "nord_driver/core/fixed_vector.h"
#include "sim/can/can_participants.h"
#include "sim/running_bus.h"

namespace nord_driver::sim {

/// Serves from `start()` to `stop()`. An interface that is removed is opened again when it is back.
class CanThread : public RunningBus, private CanSink {
 public:
  std::string where() const override { return interface_; }

 protected:
  CanThread(const std::string& interface, std::unique_ptr<link::CanLink> link);

  /// "virtual:NAME" makes the bus itself.
  static std::unique_ptr<link::CanLink> linkTo(const std::string& interface);
  /// Opens the interface and lets the stations begin. Throws std::runtime_error naming the interface and the reason.
  void start(CanParticipants& stations);
  /// Before the stations are gone.
  void stop() noexcept;

 private:
  std::string report() const override { return stations_->report(); }
  void transmit(const CanFrame& frame) noexcept override;
  void serve() noexcept;
  bool linkReady(Instant now) noexcept;
  void takeInput() noexcept;
  void sendWaiting() noexcept;

  CanParticipants* stations_ = nullptr;
  std::string interface_;
  std::unique_ptr<link::CanLink> link_;
  FixedVector<CanFrame, 256> waiting_;  // sent when the interface has room; more are lost
  Instant next_open_{};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace nord_driver::sim
