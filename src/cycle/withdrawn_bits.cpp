#include "cycle/withdrawn_bits.h"

namespace nord_driver::cycle {

void WithdrawnBits::update(const State& state, const WordCommands& commands, Instant now) noexcept {
  const bool began = stopped_ || state.stopping || state.stops != stops_;
  stopped_ = false;
  stops_ = state.stops;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const BitCommand& command = commands.outputs[i];
    Output& output = outputs_[i];
    if (began || (state.stands && !output.may_end_stop)) {
      output.stopped_at = now;
      output.withdrawn = command.given && command.on;
    } else if (state.enabled || !command.on || (command.off && *command.off > output.stopped_at)) {
      output.withdrawn = false;
    }
  }
}

}  // namespace nord_driver::cycle
