// Lets a service call wait for the bus cycle's answer without the cycle ever waiting for it.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "cycle/cycle_ports.h"

namespace nord_driver::node {

/// Numbers requests, hands them to the cycle and wakes the caller whose completion has come. `call` may be used by
/// several threads at once.
class RequestBroker {
 public:
  explicit RequestBroker(cycle::CyclePorts& ports);
  ~RequestBroker();
  RequestBroker(const RequestBroker&) = delete;
  RequestBroker& operator=(const RequestBroker&) = delete;

  /// Blocks until the cycle has answered, at most the request's patience and a second more. Never throws for a refusal:
  /// the completion says why; its id is 0 when the request did not reach the cycle.
  /// `taken`, if any, is called once the cycle has the request, before the answer is waited for: what may take its time
  /// then holds up nothing.
  cycle::Completion call(cycle::Request request, const std::function<void()>& taken = {});
  /// The bus cycle runs no more: whoever waits is answered now, and so is who still calls.
  void end();
  /// Parameter writes that come from now on are answered at once: the node is ending.
  void refuseWrites();
  /// Parameter writes that the cycle has not answered yet.
  std::size_t writesUnderWay();

 private:
  struct Waiting {
    bool write;
    std::optional<cycle::Completion> completion;
  };

  void dispatch();
  static void tell(const std::function<void()>& taken, std::unique_lock<std::mutex>& lock);

  cycle::CyclePorts& ports_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::uint32_t, Waiting> waiting_;
  std::uint32_t next_id_ = 1;
  bool stop_ = false;
  bool ended_ = false;
  bool writes_refused_ = false;
  std::thread dispatcher_;
};

}  // namespace nord_driver::node
