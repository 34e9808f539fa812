// A mutex whose holder runs with the priority of whoever waits for it.
//
// The bus thread of the simulator is a real-time one where that is permitted. A ROS thread that is looking at the
// models when somebody else takes its processor would keep it waiting for as long: the answers would come late for no
// reason that a simulated station has.
#pragma once

#include <pthread.h>

namespace nord_driver::sim {

class InheritingMutex {
 public:
  InheritingMutex() noexcept {
    pthread_mutexattr_t attributes;
    ::pthread_mutexattr_init(&attributes);
    ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    ::pthread_mutex_init(&mutex_, &attributes);
    ::pthread_mutexattr_destroy(&attributes);
  }
  ~InheritingMutex() { ::pthread_mutex_destroy(&mutex_); }
  InheritingMutex(const InheritingMutex&) = delete;
  InheritingMutex& operator=(const InheritingMutex&) = delete;

  void lock() noexcept { ::pthread_mutex_lock(&mutex_); }
  void unlock() noexcept { ::pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_;
};

}  // namespace nord_driver::sim
