#include "transport/devicenet/devicenet_counters.h"

#include "transport/can/can_line_counters.h"

namespace nord_driver {

// CAN repeats frames and checks them in the controller, which tells neither: there are no checksum errors here.
BusCounters devicenetCounters(const devicenet::Scanner& scanner, const link::CanCounters& line) noexcept {
  const devicenet::Counters& from = scanner.counters();
  std::uint64_t missed = 0, repeated = 0, unacknowledged = 0, broken = 0, losses = 0, empty = 0, reopened = 0;
  for (std::size_t i = 0; i < scanner.nodeCount(); ++i) {
    const devicenet::NodeCounters& node = scanner.status(i).counters;
    missed += node.missed;
    repeated += node.repeated;
    unacknowledged += node.unacknowledged;
    broken += node.broken_inputs;
    losses += node.losses;
    empty += node.empty_inputs;
    reopened += node.reopened;
  }

  BusCounters to;
  to.add(bus_counter::kCycles, from.cycles);
  to.add(bus_counter::kTelegramsSent, from.frames_sent);
  to.add(bus_counter::kTelegramsReceived, from.frames_received);
  to.add(bus_counter::kRetries, unacknowledged + repeated);
  to.add(bus_counter::kTimeouts, from.request_timeouts + missed);
  to.add({"explicit_timeouts", "explicit requests without an answer in time"}, from.request_timeouts);
  to.add({"missed_answers", "polls without an answer before the next cycle"}, missed);
  to.add({"explicit_errors", "explicit requests a device has refused"}, from.request_errors);
  to.add({"losses", "times a device was exchanging and was lost"}, losses);
  to.add({"reopened", "explicit connections allocated again beside the exchange"}, reopened);
  to.add({"broken_inputs", "fragmented messages with a gap, left out"}, broken);
  to.add({"empty_inputs", "process data of no bytes: the device has nothing to say"}, empty);
  to.add(bus_counter::kUnexpected, from.foreign + from.malformed + from.second_scanner + from.own_mac_used);
  to.add({"foreign", "frames of identifiers and devices that are not configured"}, from.foreign);
  to.add({"malformed", "frames of our devices of a wrong length or content"}, from.malformed);
  to.add({"second_scanner", "frames only another scanner sends to our devices"}, from.second_scanner);
  to.add({"own_mac_used", "duplicate-MAC messages of a device with our own MAC id"}, from.own_mac_used);
  to.add({"mac_answers", "questions about our MAC id that were answered"}, from.mac_answers);
  to.add(bus_counter::kStale, from.superseded + from.stray_answers);
  to.add({"superseded", "process data dropped for newer ones, because they could not be sent in their cycle"},
         from.superseded);
  to.add({"stray_answers", "explicit answers nobody waited for"}, from.stray_answers);
  to.add({"not_sent", "frames the interface had no room for, tried again or dropped for newer ones"}, from.not_sent);
  addLineCounters(line, to);
  return to;
}

}  // namespace nord_driver
