#include "sim/model_clock.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

namespace nord_driver::sim {

namespace {

constexpr int kPriority = 10;
constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr Duration kLongestGap = std::chrono::milliseconds(20);

}  // namespace

void becomeRealTime() noexcept {
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  sched_param parameter{};
  parameter.sched_priority = kPriority;
  static_cast<void>(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter));
}

Instant ModelClock::tick(Instant now) noexcept {
  stood_still_ = now - last_ > kLongestGap ? now - last_ - kStep : Duration::zero();
  standstill_ += stood_still_;
  last_ = now;
  return now - standstill_;
}

}  // namespace nord_driver::sim
