#include "sim/running_bus.h"

#include "sim/canopen/can_bus_thread.h"
#include "sim/profibus/pty_bus.h"

namespace nord_driver::sim {

std::unique_ptr<RunningBus> runBus(const SimConfig& config) {
  if (config.can) return std::make_unique<CanBusThread>(config);
  return std::make_unique<PtyBus>(config, config.device);
}

}  // namespace nord_driver::sim
