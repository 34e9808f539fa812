#include "cycle/withdrawn_bits.h"

namespace nord_driver::cycle {

// Of a fault and of local control the beginning counts: a bit may be what acknowledges the one, or ends the other
// (functions 12 and 14 of P480).
void WithdrawnBits::update(const State& state, const WordCommands& commands, Instant now) noexcept {
  const bool stop = stopped_ || state.stopping || state.stops != last_.stops || (state.fault && !last_.fault) ||
                    (!state.bus_control && last_.bus_control);
  stopped_ = false;
  last_ = state;
  if (stop) stopped_at_ = now;
  for (std::size_t i = 0; i < withdrawn_.size(); ++i) {
    const BitCommand& command = commands.outputs[i];
    if (stop) {
      withdrawn_[i] = command.given && command.on;
    } else if (state.enabled || !command.on || (command.off && *command.off > stopped_at_)) {
      withdrawn_[i] = 0;
    }
  }
}

}  // namespace nord_driver::cycle
