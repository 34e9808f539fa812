// The thread of one bus: runs the cycle at its rate until it is told to end.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "cycle/bus_cycle.h"

namespace nord_driver::cycle {

/// Destroying it ends the thread after the running cycle; whoever owns it has brought the drives to rest before.
class CycleThread {
 public:
  CycleThread(BusCycle& cycle, Transport& transport, const RealTimeOptions& options);
  ~CycleThread();
  CycleThread(const CycleThread&) = delete;
  CycleThread& operator=(const CycleThread&) = delete;

  /// What of the options the system refused, in words; empty when nothing.
  const std::string& refused() const noexcept { return refused_; }

 private:
  void run() noexcept;

  BusCycle& cycle_;
  Transport& transport_;
  std::atomic<bool> stop_{false};
  std::string refused_;
  std::thread thread_;
};

}  // namespace nord_driver::cycle
