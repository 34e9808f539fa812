// The time of the modules on a bus whose thread is run by the clock of the machine: the steady clock, without the spans
// the thread was kept from running.
#pragma once

#include "nord_driver/core/time.h"

namespace nord_driver::sim {

/// SCHED_FIFO and fine timers where they are permitted; without the right to them the simulator answers a little later.
void becomeRealTime() noexcept;

class ModelClock {
 public:
  explicit ModelClock(Instant now) noexcept : last_(now) {}

  /// Model time at `now`. A thread that was kept from running lets the modules' time stand still meanwhile: the master
  /// is not to blame. Wheels turn on: RobotSim::runOnUnheard.
  Instant tick(Instant now) noexcept;
  /// How long the modules' time stood still before the last tick.
  Duration stoodStill() const noexcept { return stood_still_; }

 private:
  Instant last_;
  Duration standstill_{0};
  Duration stood_still_{0};
};

}  // namespace nord_driver::sim
