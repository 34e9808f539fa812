// Waiting as the kernel does it, by the steady clock.
#pragma once

#include <errno.h>
#include <time.h>

#include "nord_driver/core/time.h"

namespace nord_driver::link {

inline timespec toTimespec(Duration span) noexcept {
  timespec time{};
  time.tv_sec = static_cast<time_t>(span.count() / 1'000'000'000);
  time.tv_nsec = static_cast<long>(span.count() % 1'000'000'000);
  return time;
}

/// For ppoll(), which takes no negative span. Not poll() or epoll: a millisecond is longer than the pauses of a bus.
inline timespec toTimeout(Duration span) noexcept {
  return toTimespec(span > Duration::zero() ? span : Duration::zero());
}

inline void sleepUntilInstant(Instant when) noexcept {
  const timespec wake = toTimespec(when.time_since_epoch());
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
  }
}

}  // namespace nord_driver::link
