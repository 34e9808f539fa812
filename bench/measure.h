// How a measurement is taken on a machine that does other things too: pinned, paired, medians.
#pragma once

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <thread>
#include <utility>
#include <vector>

#include "nord_driver/core/time.h"

namespace nord_driver::bench {

inline void pinTo(unsigned processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

/// The calling thread no longer takes the processor from another as soon as it could go on (SCHED_BATCH): two threads
/// on one processor then change places where one waits, and not in the middle of a burst, where it would depend on how
/// long each has run before.
inline void runUntilWaiting() {
  sched_param none{};
  pthread_setschedparam(pthread_self(), SCHED_BATCH, &none);
}

/// Keeps the other processors from idling, so that the scheduler has no reason to move anybody there and clocks stay
/// up. SCHED_IDLE: whoever else has work there gets it done.
class BusyOthers {
 public:
  explicit BusyOthers(unsigned ours) {
    for (unsigned other = 0; other < std::thread::hardware_concurrency(); ++other) {
      if (other == ours) continue;
      threads_.emplace_back([this, other] {
        pinTo(other);
        sched_param none{};
        pthread_setschedparam(pthread_self(), SCHED_IDLE, &none);
        while (!stop_) {
        }
      });
    }
  }
  ~BusyOthers() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  BusyOthers(const BusyOthers&) = delete;
  BusyOthers& operator=(const BusyOthers&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Microseconds one call takes.
template <typename Work>
double microseconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return toSeconds(std::chrono::steady_clock::now() - start) * 1e6;
}

struct Pair {
  double first = 0;  ///< median, us
  double second = 0;
};

/// Both in turn, in blocks: whatever slows the machine down slows both down.
template <typename First, typename Second>
Pair measurePairs(std::size_t pairs, std::size_t block, First&& first, Second&& second) {
  std::vector<double> of_first, of_second;
  of_first.reserve(pairs);
  of_second.reserve(pairs);
  while (of_first.size() < pairs) {
    for (std::size_t i = 0; i < block; ++i) of_first.push_back(microseconds(first));
    for (std::size_t i = 0; i < block; ++i) of_second.push_back(microseconds(second));
  }
  return {median(std::move(of_first)), median(std::move(of_second))};
}

/// Prints a figure against its bound; true when it is kept.
inline bool report(const char* what, double value, const char* unit, double bound) {
  const bool kept = value <= bound;
  std::printf("%-66s %9.3f %-3s at most %9.3f  %s\n", what, value, unit, bound, kept ? "ok" : "MISSED");
  std::fflush(stdout);
  return kept;
}

/// The same for a figure that must not be smaller.
inline bool reportAtLeast(const char* what, double value, double bound) {
  const bool kept = value >= bound;
  std::printf("%-66s %9.3f     at least %8.3f  %s\n", what, value, bound, kept ? "ok" : "MISSED");
  std::fflush(stdout);
  return kept;
}

}  // namespace nord_driver::bench
