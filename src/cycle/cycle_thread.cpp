#include "cycle/cycle_thread.h"

#include <pthread.h>
#include <sched.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>

namespace nord_driver::cycle {

CycleThread::CycleThread(BusCycle& cycle, Transport& transport, const RealTimeOptions& options)
    : cycle_(cycle), transport_(transport) {
  if (options.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    refused_ = "memory cannot be locked (the limit memlock is too small): the bus cycle may be late by page faults";
  }
  thread_ = std::thread([this] { run(); });
  if (options.priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = options.priority;
    if (pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &parameters) != 0) {
      refused_ += (refused_.empty() ? "" : "; ") + std::string("SCHED_FIFO priority ") +
                  std::to_string(options.priority) +
                  " is not allowed (the limit rtprio is too small): the bus cycle may be late under load";
    }
  }
}

CycleThread::~CycleThread() {
  stop_ = true;
  thread_.join();
}

void CycleThread::run() noexcept {
  pthread_setname_np(pthread_self(), "bus cycle");
  prctl(PR_SET_TIMERSLACK, 1);  // the pauses of the bus are shorter than the usual slack of 50 us
  const Duration period = cycle_.period();
  Instant next = transport_.now();
  while (!stop_) {
    cycle_.runOnce();
    next += period;
    const Instant now = transport_.now();
    if (now > next) {
      next = now;  // a late cycle is not caught up with: two at once would tell the drives nothing new
    } else {
      transport_.sleepUntil(next);
    }
  }
}

}  // namespace nord_driver::cycle
