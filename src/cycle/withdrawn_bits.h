// Which outputs that may move a motor a stop has taken away, and what gives them back.
#pragma once

#include <cstdint>
#include <vector>

#include "cycle/word_commands.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Whoever commands a signal repeats it: "on" may be as old as the stop. So a stop withdraws each signal that is
/// commanded "on"; an "off" that came after the end of the stop gives it back, and so does enabling. What may end a stop
/// that stands at a drive must not wait for its end: there the beginning counts. Which of them a signal is may be known
/// only later than its stop, and later than the end of that: it is followed as both.
class WithdrawnBits {
 public:
  explicit WithdrawnBits(std::size_t outputs) : outputs_(outputs) {}

  /// What is true of the drive in this cycle.
  struct State {
    bool stopping = false;    ///< it, or another drive of its group, is on its way to rest; or it is not heard
    bool stands = false;      ///< a fault, OFF2, OFF3 or local control, at it or at another drive of its group
    bool enabled = false;     ///< its group is enabled
    std::uint32_t stops = 0;  ///< how often its group was stopped
  };

  /// A stop that leaves no trace in the state: its connection ended, and it answers again.
  void handleStop() noexcept { stopped_ = true; }
  /// Each cycle.
  void update(const State& state, const WordCommands& commands, Instant now) noexcept;
  /// `output`: in the order of WordCommands::outputs; `may_end_stop`: what it does in the drive may end a fault, OFF2,
  /// OFF3 or local control.
  bool has(std::size_t output, bool may_end_stop) const noexcept {
    return may_end_stop ? outputs_[output].by_beginning.stands : outputs_[output].by_whole_stop.stands;
  }

 private:
  struct Withdrawal {
    bool stands = false;
    Instant stopped_at{};  // in the last cycle with a stop
    void update(bool stop, bool enabled, const BitCommand& command, Instant now) noexcept;
  };
  struct Output {
    Withdrawal by_whole_stop;
    Withdrawal by_beginning;  // of one that may end the stop
  };

  std::vector<Output> outputs_;
  std::uint32_t stops_ = 0;  // in the last cycle
  bool stopped_ = false;
};

}  // namespace nord_driver::cycle
