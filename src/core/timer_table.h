// The deadlines of one protocol engine, by name: one small table, and the next moment something is due.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver {

/// The earlier one of two deadlines, of which either may be missing.
constexpr std::optional<Instant> earlier(const std::optional<Instant>& one, const std::optional<Instant>& other) {
  if (!one || (other && *other < *one)) return other;
  return one;
}

/// `Timer`: an enum class from 0 on whose last enumerator is kCount. A timer that was never set, or was stopped,
/// neither runs nor is over. One that is over stays so until it is set or stopped.
template <typename Timer>
class TimerTable {
 public:
  void set(Timer timer, Instant at) noexcept { due_[index(timer)] = at; }
  /// Sets it, unless it is set to a later moment.
  void prolong(Timer timer, Instant to) noexcept {
    if (!isRunning(timer, to)) set(timer, to);
  }
  void stop(Timer timer) noexcept { due_[index(timer)].reset(); }
  void stopAll() noexcept { due_.fill(std::nullopt); }

  const std::optional<Instant>& at(Timer timer) const noexcept { return due_[index(timer)]; }
  bool isSet(Timer timer) const noexcept { return at(timer).has_value(); }
  bool isRunning(Timer timer, Instant now) const noexcept { return isSet(timer) && now < *at(timer); }
  bool isOver(Timer timer, Instant now) const noexcept { return isSet(timer) && now >= *at(timer); }
  /// True once when it is over: it is stopped then.
  bool takeDue(Timer timer, Instant now) noexcept {
    if (!isOver(timer, now)) return false;
    stop(timer);
    return true;
  }
  /// The earliest of all that are set, those that are over included.
  std::optional<Instant> nextTimeout() const noexcept {
    std::optional<Instant> next;
    for (const std::optional<Instant>& due : due_) next = earlier(next, due);
    return next;
  }

 private:
  static constexpr std::size_t index(Timer timer) noexcept { return static_cast<std::size_t>(timer); }

  std::array<std::optional<Instant>, static_cast<std::size_t>(Timer::kCount)> due_{};
};

}  // namespace nord_driver
