// What is found out about others on a CAN bus, as events: told once per node or once per second, however often it is
// seen.
#pragma once

#include <bitset>
#include <cstdint>

#include "core/timer_table.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// `Events` is the ring of the engine; `Finding` an enum class from 0 on whose last enumerator is kCount. Nodes have
/// the numbers 0 to 127.
template <typename Events, typename Finding>
class BusFindings {
 public:
  using Event = typename Events::Event;

  /// The reference lives longer than this.
  explicit BusFindings(Events& events) noexcept : events_(events) {}

  /// Everything is told again.
  void restart() noexcept {
    told_nodes_.reset();
    pauses_.stopAll();
  }
  /// True once for each node.
  bool isNew(std::uint8_t node) noexcept {
    const bool is_new = !told_nodes_[node];
    told_nodes_[node] = true;
    return is_new;
  }
  /// True once per second for each finding.
  bool mayTell(Finding finding, Instant now) noexcept {
    if (pauses_.isRunning(finding, now)) return false;
    pauses_.set(finding, now + std::chrono::seconds{1});
    return true;
  }
  /// Of no node of ours.
  void tell(decltype(Event::kind) kind, const Sentence& text, std::uint32_t value, Instant now) noexcept {
    Event event;
    event.kind = kind;
    event.value = value;
    event.at = now;
    event.text = text;
    events_.push(event);
  }

 private:
  Events& events_;
  std::bitset<128> told_nodes_;
  TimerTable<Finding> pauses_;  // until then the same finding is not told again
};

}  // namespace nord_driver
