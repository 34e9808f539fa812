// The deadlines of an engine in one table: no timer objects, no callbacks.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// `Timer` is an enumeration from 0 whose last name is kCount.
template <typename Timer>
class TimerTable {
 public:
  void set(Timer timer, Instant due) noexcept { due_[at(timer)] = due; }
  void stop(Timer timer) noexcept { due_[at(timer)].reset(); }
  void stopAll() noexcept { due_.fill(std::nullopt); }
  bool running(Timer timer) const noexcept { return due_[at(timer)].has_value(); }
  std::optional<Instant> due(Timer timer) const noexcept { return due_[at(timer)]; }

  /// True once when its time has come: it does not run any more then.
  bool takeDue(Timer timer, Instant now) noexcept {
    std::optional<Instant>& due = due_[at(timer)];
    if (!due || now < *due) return false;
    due.reset();
    return true;
  }
  std::optional<Instant> nextDeadline() const noexcept {
    std::optional<Instant> earliest;
    for (const std::optional<Instant>& due : due_) {
      if (due && (!earliest || *due < *earliest)) earliest = due;
    }
    return earliest;
  }

 private:
  static constexpr std::size_t at(Timer timer) noexcept { return static_cast<std::size_t>(timer); }

  std::array<std::optional<Instant>, static_cast<std::size_t>(Timer::kCount)> due_{};
};

inline void takeEarlier(std::optional<Instant>& earliest, std::optional<Instant> other) noexcept {
  if (other && (!earliest || *other < *earliest)) earliest = other;
}

}  // namespace nord_driver::devicenet
