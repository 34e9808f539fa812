#include "transport/can/can_line_counters.h"

namespace nord_driver {

void addLineCounters(const link::CanCounters& line, BusCounters& to) noexcept {
  to.add(bus_counter::kOverruns, line.dropped);
  to.add({"error_frames", "protocol violations on the bus, as the controller reports them"}, line.bus_errors);
  to.add({"no_acknowledge", "frames nobody else on the bus acknowledged"}, line.no_acknowledge);
  to.add({"controller_errors", "overflow, error warning and error passive of the controller"}, line.controller_errors);
  to.add({"bus_off", "times the controller has left the bus"}, line.bus_off);
  to.add({"restarts", "times the controller came back from bus off"}, line.restarts);
}

}  // namespace nord_driver
