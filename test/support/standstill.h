// Whether the machine kept a program from running: judged from time stamps and counters that somebody has taken.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

namespace nord_driver::test {

/// The longest that something which could run did not run, in s, and what that was.
struct HoldUp {
  std::chrono::duration<double> length{0.0};
  std::string of;  ///< empty: this machine as a whole
};

/// The wake-ups of a thread that only sleeps: nothing but the machine can make it late.
class SleepRecord {
 public:
  using Moment = std::chrono::steady_clock::time_point;
  using Span = std::chrono::duration<double>;

  SleepRecord(Span step, Moment begin) : step_(step), last_(begin) {}

  void woke(Moment at) {
    longest_ = longestUntil(at);
    last_ = at;
  }
  /// How late it was at most, `now` included: it may be late just then.
  Span longestUntil(Moment now) const { return std::max<Span>(longest_, now - last_ - step_); }

 private:
  Span step_;
  Moment last_;
  Span longest_{0.0};
};

/// How long a thread has been ready to run and was not run since it began: /proc/<pid>/task/<tid>/schedstat, whose
/// three numbers are the time it ran, the time it waited, both in ns, and how often it was given a processor
/// (sched-stats.rst of the kernel). What a thread waits for of its own accord, a lock, an answer, a sleep, is not in
/// it.
struct RunDelay {
  std::uint64_t waited = 0;  ///< ns
  std::uint64_t turns = 0;

  static std::optional<RunDelay> from(const std::string& schedstat) {
    char* end = nullptr;
    const char* text = schedstat.c_str();
    std::strtoull(text, &end, 10);
    if (end == text) return std::nullopt;
    RunDelay delay;
    text = end;
    delay.waited = std::strtoull(text, &end, 10);
    if (end == text) return std::nullopt;
    text = end;
    delay.turns = std::strtoull(text, &end, 10);
    if (end == text) return std::nullopt;
    return delay;
  }
};

/// One of the waits that ended in the last `window` was at least that long. The kernel tells their sum and their
/// number: one is not shorter than the mean, and all but the first lay within the window.
inline SleepRecord::Span longestWait(const RunDelay& before, const RunDelay& after, SleepRecord::Span window) {
  if (after.turns <= before.turns || after.waited <= before.waited) return SleepRecord::Span{0.0};
  const SleepRecord::Span sum{static_cast<double>(after.waited - before.waited) * 1e-9};
  return std::max(sum / static_cast<double>(after.turns - before.turns), sum - window);
}

}  // namespace nord_driver::test
