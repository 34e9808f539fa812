#include "cycle/withdrawn_bits.h"

namespace nord_driver::cycle {

void WithdrawnBits::update(const State& state, const WordCommands& commands, Instant now) noexcept {
  const bool stop = stopped_ || state.stopping || state.stops != stops_;
  stopped_ = false;
  stops_ = state.stops;
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
