// Which waits of a test program ended later than asked for, or than what they waited for: replaces ppoll(), clock_nanosleep()
// and write() of the whole program. To be included by one source of it.
//
// A wait for a pty ends after its time-out where the kernel's own worker that carries the bytes, a thread of ordinary
// priority, is late: n_tty_poll() waits for it, whatever the time-out and the priority of who polls (Linux,
// drivers/tty/n_tty.c, tty_buffer_flush_work()). By the same worker bytes come late to a wait that is not due yet: what one
// thread has written before, another one that waits for a tty has to see at once. It has one sender at a time, as a bus of
// one master has.
#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <vector>

#include "nord_driver/core/time.h"

namespace nord_driver::test {

/// From when a wait was due, or its bytes were there to be carried, to when it ended.
struct Overslept {
  Instant due{};
  Instant end{};
  long thread = 0;
};

/// A timer that fires so late is none of these: that is how timers are.
constexpr Duration kTimersPass = std::chrono::microseconds{200};
constexpr std::size_t kMostOverslept = std::size_t{1} << 18U;

inline std::array<Overslept, kMostOverslept> overslept;
inline std::atomic<std::size_t> overslept_count{0};

inline long thisThread() noexcept {
  return ::syscall(SYS_gettid);
}

inline void noteWait(Instant due) noexcept {
  const Instant now = std::chrono::steady_clock::now();
  if (now - due <= kTimersPass) return;
  const std::size_t place = overslept_count++;
  if (place < kMostOverslept) overslept[place] = {due, now, thisThread()};
}

/// What was written to a tty last.
struct Sent {
  std::atomic<Instant::rep> when{0};  // after it was written
  std::atomic<long> thread{0};
};
inline Sent last_sent;

/// A wait for a tty, which began at `begin`, has bytes.
inline void noteArrival(Instant begin) noexcept {
  const Instant sent{Instant::duration{last_sent.when}};
  const long by = last_sent.thread;
  if (by != 0 && by != thisThread()) noteWait(std::max(begin, sent));
}

inline Duration spanOf(const timespec& time) noexcept {
  return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

/// How much of the time between these two any thread but `others` was in a wait that was due. Once they have ended.
inline Duration oversleptBetween(Instant from, Instant to, const std::vector<long>& others) {
  std::vector<Overslept> waits;
  const std::size_t count = std::min<std::size_t>(overslept_count, kMostOverslept);
  for (std::size_t i = 0; i < count; ++i) {
    const Overslept& wait = overslept[i];
    const bool counts = std::find(others.begin(), others.end(), wait.thread) == others.end();
    if (counts && wait.due < to && wait.end > from) waits.push_back(wait);
  }
  std::sort(waits.begin(), waits.end(), [](const Overslept& a, const Overslept& b) { return a.due < b.due; });
  Duration all{};
  for (const Overslept& wait : waits) {
    const Instant begin = std::max(from, wait.due);
    const Instant end = std::min(to, wait.end);
    if (end > begin) all += end - begin;
    from = std::max(from, end);
  }
  return all;
}

}  // namespace nord_driver::test

extern "C" {
inline __attribute__((used, visibility("default"))) int ppoll(pollfd* fds, nfds_t count, const timespec* timeout,
                                                              const sigset_t* mask) {
  using namespace nord_driver::test;
  timespec left{};  // the kernel writes to it
  if (timeout != nullptr) left = *timeout;
  const nord_driver::Instant begin = std::chrono::steady_clock::now();
  const nord_driver::Instant due = begin + spanOf(left);
  const long ready = ::syscall(SYS_ppoll, fds, count, timeout == nullptr ? nullptr : &left, mask, _NSIG / 8);
  const int error = errno;
  if (timeout != nullptr) noteWait(due);
  if (ready > 0 && count == 1 && ::isatty(fds->fd) != 0) noteArrival(begin);
  errno = error;
  return static_cast<int>(ready);
}

inline __attribute__((used, visibility("default"))) int clock_nanosleep(clockid_t clock, int flags,
                                                                        const timespec* time, timespec* left) {
  using namespace nord_driver::test;
  const auto due =
      flags == TIMER_ABSTIME ? nord_driver::Instant{spanOf(*time)} : std::chrono::steady_clock::now() + spanOf(*time);
  const bool ended = ::syscall(SYS_clock_nanosleep, clock, flags, time, left) == 0;
  const int error = ended ? 0 : errno;
  if (clock == CLOCK_MONOTONIC) noteWait(due);
  return error;
}

inline __attribute__((used, visibility("default"))) ssize_t write(int descriptor, const void* bytes, size_t count) {
  using namespace nord_driver::test;
  const long written = ::syscall(SYS_write, descriptor, bytes, count);
  const int error = errno;
  if (written > 0 && ::isatty(descriptor) != 0) {
    last_sent.when = std::chrono::steady_clock::now().time_since_epoch().count();
    last_sent.thread = thisThread();
  }
  errno = error;
  return written;
}
}
