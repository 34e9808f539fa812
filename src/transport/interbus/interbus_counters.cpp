#include "transport/interbus/interbus_counters.h"

namespace nord_driver {

// TCP repeats and checks what is lost, and tells nobody: there are no retries and no checksum errors here. What happens
// on the ring is the gateway's own to count.
BusCounters interbusCounters(const InterbusCounts& own, const link::LinkCounters& link) noexcept {
  BusCounters to;
  to.add(bus_counter::kCycles, own.cycles);
  to.add({"without_inputs", "cycles that brought no new inputs, because the gateway is slow or silent"},
         own.without_inputs);
  to.add({"exchanges", "outputs written and inputs read, whole images"}, link.exchanges);
  to.add({"skipped_outputs", "output images a newer one took the place of, because the gateway is slower than a cycle"},
         link.skipped_outputs);
  to.add(bus_counter::kTelegramsReceived, link.requests);
  to.add(bus_counter::kTimeouts, link.timeouts);
  to.add(bus_counter::kStale, link.late);
  to.add(bus_counter::kUnexpected, link.unasked);
  to.add({"partial_answers", "answers of which only the beginning came"}, link.partial);
  to.add({"bad_answers", "answers that did not fit the request"}, link.bad_answers);
  to.add({"exceptions", "requests the gateway has refused (Modbus exceptions)"}, link.exceptions);
  to.add({"connections", "connections made to the gateway"}, link.connections);
  to.add({"connect_failures", "connections that could not be made"}, link.connect_failures);
  to.add({"closed_connections", "connections the gateway or the network has ended"}, link.closed);
  to.add({"ring_stops", "times the gateway began to say that its ring does not run"}, own.ring_stops);
  return to;
}

}  // namespace nord_driver
