// Which outputs that may move a motor a stop has taken away, and what gives them back.
#pragma once

#include <cstdint>
#include <vector>

#include "cycle/word_commands.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Whoever commands a signal repeats it: "on" may be as old as the stop. So a stop withdraws each signal that is
/// commanded "on"; an "off" that came after the end of the stop gives it back, and so does enabling.
class WithdrawnBits {
 public:
  explicit WithdrawnBits(std::size_t outputs) : withdrawn_(outputs, 0) {}

  /// What is true of the drive in this cycle.
  struct State {
    bool stopping = false;    ///< it, or another drive of its group, is on its way to rest; or it is not heard
    bool enabled = false;     ///< its group is enabled
    std::uint32_t stops = 0;  ///< how often its group was stopped
  };

  /// A stop that leaves no trace in the state: its connection ended, and it answers again.
  void handleStop() noexcept { stopped_ = true; }
  /// Each cycle.
  void update(const State& state, const WordCommands& commands, Instant now) noexcept;
  /// `output`: in the order of WordCommands::outputs.
  bool has(std::size_t output) const noexcept { return withdrawn_[output] != 0; }

 private:
  std::vector<std::uint8_t> withdrawn_;  // of each output
  std::uint32_t stops_ = 0;              // in the last cycle
  bool stopped_ = false;
  Instant stopped_at_{};  // in the last cycle with a stop
};

}  // namespace nord_driver::cycle
