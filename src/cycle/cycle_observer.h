// Who looks on while the bus cycle runs.
#pragma once

#include <vector>

#include "cycle/snapshot.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

class CycleObserver {
 public:
  virtual ~CycleObserver() = default;

  /// The cycle's thread, once per cycle before its snapshot is published, with what was exchanged and what became of
  /// it. Neither waits nor allocates.
  virtual void handleCycle(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
                           const CycleSnapshot& snapshot) noexcept = 0;
};

}  // namespace nord_driver::cycle
