// A simulated bus that runs in real time in a thread of its own, whatever kind of bus it is.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "sim/inheriting_mutex.h"
#include "sim/model_clock.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

class RunningBus {
 public:
  virtual ~RunningBus() = default;

  /// Runs `function(RobotSim&)` while the models stand still, and returns what it returns. Any thread.
  template <typename Function>
  auto withModel(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(robot());
  }

  /// What a driver opens: the link to the pty, the CAN interface.
  virtual std::string where() const = 0;
  /// "no rule broken", or each rule the master broke with its count. Any thread.
  std::string refereeReport() {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return report();
  }

 protected:
  /// The time of the modules at `now`, under the lock. Drives and body have run through what it leaves out.
  Instant modelTime(ModelClock& clock, Instant now) noexcept {
    const Instant model_now = clock.tick(now);
    robot().runOnUnheard(clock.stoodStill());
    return model_now;
  }

  virtual RobotSim& robot() noexcept = 0;
  virtual std::string report() const = 0;

  InheritingMutex mutex_;
};

/// The bus the configuration asks for, by the table of bus_kinds.cpp. Throws std::runtime_error when it cannot be opened, and ConfigError.
std::unique_ptr<RunningBus> runBus(const SimConfig& config);

}  // namespace nord_driver::sim
