#include "transport/profibus/profibus_counters.h"

namespace nord_driver {

BusCounters profibusCounters(const profibus::Counters& master, const link::LineCounters& line,
                             std::uint64_t stale) noexcept {
  BusCounters to;
  to.add(bus_counter::kCycles, master.cycles);
  to.add(bus_counter::kTelegramsSent, master.telegrams_sent);
  to.add(bus_counter::kTelegramsReceived, master.telegrams_received);
  to.add(bus_counter::kRetries, master.retries);
  to.add(bus_counter::kTimeouts, master.timeouts);
  to.add(bus_counter::kChecksumErrors, master.checksum_errors);
  to.add(bus_counter::kParityErrors, line.parity_errors);
  to.add({"framing_errors", "characters received without a stop bit"}, line.framing_errors);
  to.add(bus_counter::kOverruns, line.overruns);
  to.add(bus_counter::kDiscardedBytes, master.discarded_bytes);
  to.add(bus_counter::kUnexpected, master.unexpected + line.collisions);
  to.add({"foreign_telegrams", "tokens and requests of another master"}, master.foreign_telegrams);
  to.add({"collisions", "own telegrams that came back changed: another station spoke at once"}, line.collisions);
  to.add({"busy_line", "cycles ended early because the line never fell silent"}, master.busy);
  to.add(bus_counter::kStale, stale);
  return to;
}

}  // namespace nord_driver
