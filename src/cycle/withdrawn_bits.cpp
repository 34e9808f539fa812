#include "cycle/withdrawn_bits.h"

namespace nord_driver::cycle {

void WithdrawnBits::Withdrawal::update(bool stop, bool enabled, const BitCommand& command, Instant now) noexcept {
  if (stop) {
    stopped_at = now;
    stands = command.given && command.on;
  } else if (enabled || !command.on || (command.off && *command.off > stopped_at)) {
    stands = false;
  }
}

void WithdrawnBits::update(const State& state, const WordCommands& commands, Instant now) noexcept {
  const bool began = stopped_ || state.stopping || state.stops != stops_;
  stopped_ = false;
  stops_ = state.stops;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const BitCommand& command = commands.outputs[i];
    outputs_[i].by_whole_stop.update(began || state.stands, state.enabled, command, now);
    outputs_[i].by_beginning.update(began, state.enabled, command, now);
  }
}

}  // namespace nord_driver::cycle
