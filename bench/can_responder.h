// The nodes at the far end of a pair, on a thread of their own.
#pragma once

#include <functional>
#include <thread>

#include "can_ends.h"

namespace nord_driver::bench {

/// Hands on what answers a frame, in its order; false: the near end is gone.
using CanSay = std::function<bool(const can_frame&)>;
/// What nodes are: what they say to a frame. False when one could not be said.
using CanAnswers = std::function<bool(const can_frame&, const CanSay&)>;

class CanResponder {
 public:
  /// `ends` must outlive it.
  CanResponder(CanEnds& ends, CanAnswers answers, unsigned processor);
  ~CanResponder();
  CanResponder(const CanResponder&) = delete;
  CanResponder& operator=(const CanResponder&) = delete;

 private:
  void run();

  CanEnds& ends_;
  CanAnswers answers_;
  std::thread thread_;
};

}  // namespace nord_driver::bench
