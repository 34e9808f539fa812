// One node's voice on a CAN bus: its status, and what is told and counted of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// `Status` has state, reason, since and counters; `Counters` those of the bus; `Events` is the ring of the engine.
template <typename Status, typename Counters, typename Events>
class NodeReport {
 public:
  using Event = typename Events::Event;
  using Kind = decltype(Event::kind);
  using State = decltype(Status::state);

  /// The references live longer than this.
  NodeReport(std::size_t node, Counters& counters, Events& events) noexcept
      : node_(node), counters_(counters), events_(events) {}

  Status& status() noexcept { return status_; }
  const Status& status() const noexcept { return status_; }
  Counters& busCounters() noexcept { return counters_; }

  /// Sets state and reason; an empty one clears it.
  void enter(State state, const Sentence& reason, Instant now) noexcept {
    if (status_.state != state) status_.since = now;
    status_.state = state;
    status_.reason = reason;
  }

  void tell(Kind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept {
    Event event;
    event.kind = kind;
    event.node = node_;
    event.value = value;
    event.at = now;
    event.text = text;
    events_.push(event);
  }

  /// Counts every frame, tells of one per second: a broken node must not fill the queue of events.
  void malformed(const CanFrame& frame, const char* what, Instant now) noexcept {
    ++counters_.malformed;
    ++status_.counters.malformed;
    if (told_malformed_ && now - *told_malformed_ < std::chrono::seconds{1}) return;
    told_malformed_ = now;
    Sentence text;
    text.format("sent a malformed frame %03Xh: %s (%u bytes%s)", static_cast<unsigned>(frame.id), what,
                static_cast<unsigned>(frame.size), frame.remote ? ", remote" : "");
    tell(Kind::kMalformed, text, frame.id, now);
  }

 private:
  std::size_t node_;
  Counters& counters_;
  Events& events_;
  Status status_;
  std::optional<Instant> told_malformed_;
};

}  // namespace nord_driver
