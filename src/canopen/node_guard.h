// Watches one node by asking for its state with remote frames (node guarding, CiA 301 7.2.8.3.2.1).
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/node_timers.h"
#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

enum class GuardAnswer : std::uint8_t {
  kAccepted,
  kWrongToggle,  ///< the same toggle bit as in the answer before: treated as not received
  kNotAsked      ///< no question is open
};

/// The node toggles bit 7 with every answer and begins with 0 after its reset. Its life time is guard time times life
/// time factor: without a good answer for so long it is lost; without a question for so long it counts us as lost.
/// A question without an answer is put again after half a guard time: a frame or two lost on a bad line must not use up
/// a life time that has time for three questions only.
class NodeGuard {
 public:
  /// `timers`: of the node; they live longer than this.
  NodeGuard(std::uint8_t node, Duration guard_time, std::uint8_t life_time_factor, NodeTimers& timers) noexcept;

  /// Asks from now on, the first time at once. `fresh`: the node has just been reset, its toggle bit begins with 0.
  void start(bool fresh, Instant now) noexcept;
  void stop() noexcept;
  /// One question now, without watching for its answer.
  void askOnce() noexcept { due_ = true; }
  bool running() const noexcept { return timers_.isSet(NodeTimer::kGuardQuestion); }

  /// `value`: the data byte.
  GuardAnswer handle(std::uint8_t value, Instant now) noexcept;
  /// Another master asked: the node toggles in the answer to that as well.
  void handleForeignQuestion() noexcept {
    expected_toggle_.reset();
    doubled_ = 0;
  }
  /// Some questions in a row had one answer more than they asked for, this one among them, and nobody else asked: two nodes
  /// answer. A frame may be received twice (ISO 11898-1: an error in its last bit but one), but not so often.
  bool answeredTwice() const noexcept { return surplus_ && doubled_ + 1 >= kOfTwoNodes; }
  /// Makes the next question due. True once for each question that stayed without an answer.
  bool poll(Instant now) noexcept;
  /// No good answer for the node life time, as `poll()` saw it.
  bool expired() const noexcept { return over_; }

  /// The question, when one is due.
  bool pollTransmit(CanFrame& frame) noexcept;
  /// It was not sent: it is due again.
  void notSent() noexcept {
    due_ = true;
    open_ = false;
  }
  bool due() const noexcept { return due_; }

 private:
  static constexpr std::uint8_t kOfTwoNodes = 5;

  std::uint8_t node_;
  Duration guard_time_;
  Duration life_time_;
  NodeTimers& timers_;
  bool over_ = false;  // the life time is over
  bool due_ = false;   // a question waits to be sent
  bool open_ = false;  // a question was sent and not answered
  bool half_ = false;  // the timer of the question is at half the guard time: it looks for the answer
  std::optional<std::uint8_t> expected_toggle_;
  bool surplus_ = false;      // the question before had more than one answer
  std::uint8_t doubled_ = 0;  // questions in a row, before this one, that had
};

}  // namespace nord_driver::canopen
