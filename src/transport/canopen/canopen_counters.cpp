#include "transport/canopen/canopen_counters.h"

#include "transport/can/can_line_counters.h"

namespace nord_driver {

// CAN repeats frames and checks them in the controller, which tells neither: there are no retries and no checksum
// errors here.
BusCounters canopenCounters(const canopen::Master& master, const link::CanCounters& line) noexcept {
  const canopen::Counters& from = master.counters();
  std::uint64_t missed_guards = 0;
  for (std::size_t i = 0; i < master.nodeCount(); ++i) missed_guards += master.status(i).counters.missed_guards;

  BusCounters to;
  to.add(bus_counter::kCycles, from.cycles);
  to.add(bus_counter::kTelegramsSent, from.frames_sent);
  to.add(bus_counter::kTelegramsReceived, from.frames_received);
  to.add(bus_counter::kTimeouts, from.sdo_timeouts + missed_guards);
  to.add({"sdo_timeouts", "SDO requests without an answer in time"}, from.sdo_timeouts);
  to.add({"missed_guards", "node guarding requests without an answer in time"}, missed_guards);
  to.add({"sdo_aborts", "SDO requests a node has refused"}, from.sdo_aborts);
  to.add(bus_counter::kUnexpected, from.foreign + from.malformed + from.second_master + from.own_id_used);
  to.add({"foreign", "frames of identifiers and nodes that are not configured, and NMT commands for such nodes"},
         from.foreign);
  to.add({"malformed", "frames of our nodes of a wrong length or content, and NMT commands of others"}, from.malformed);
  to.add({"second_master", "frames only another master sends"}, from.second_master);
  to.add({"own_id_used", "frames with this master's own node id"}, from.own_id_used);
  to.add(bus_counter::kStale, from.superseded + from.stray_sdo);
  to.add({"superseded", "RPDOs and SYNCs dropped for newer ones, because they could not be sent in their cycle"},
         from.superseded);
  to.add({"stray_sdo", "SDO answers nobody waited for"}, from.stray_sdo);
  to.add({"not_sent", "frames the interface had no room for, tried again or dropped for newer ones"}, from.not_sent);
  addLineCounters(line, to);
  return to;
}

}  // namespace nord_driver
