#include "link/modbus/trouble_counters.h"

namespace nord_driver::link {

void countTrouble(ModbusTrouble trouble, LinkCounters& counters) noexcept {
  switch (trouble) {
    case ModbusTrouble::kNoConnection:
      ++counters.connect_failures;
      ++counters.lost;
      break;
    case ModbusTrouble::kClosed:
      ++counters.closed;
      ++counters.lost;
      break;
    case ModbusTrouble::kSilent:
      ++counters.timeouts;
      break;
    case ModbusTrouble::kPartial:
      ++counters.partial;
      break;
    case ModbusTrouble::kUnasked:
      ++counters.unasked;
      break;
    case ModbusTrouble::kBadAnswer:
      ++counters.bad_answers;
      break;
    case ModbusTrouble::kException:
      ++counters.exceptions;
      break;
    case ModbusTrouble::kNone:
    case ModbusTrouble::kCancelled:
      break;
  }
}

void addConnection(const LinkCounters& second, LinkCounters& to) noexcept {
  to.requests += second.requests;
  to.connections += second.connections;
  to.connect_failures += second.connect_failures;
  to.closed += second.closed;
  to.timeouts += second.timeouts;
  to.late += second.late;
  to.partial += second.partial;
  to.unasked += second.unasked;
  to.bad_answers += second.bad_answers;
  to.exceptions += second.exceptions;
}

}  // namespace nord_driver::link
