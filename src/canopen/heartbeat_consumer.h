// Watches one node by the heartbeat it sends (CiA 301 7.2.8.3.2.2).
#pragma once

#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class HeartbeatConsumer {
 public:
  explicit HeartbeatConsumer(Duration timeout) noexcept : timeout_(timeout) {}

  /// Watches from now on: the next heartbeat is due within the time-out.
  void start(Instant now) noexcept { deadline_ = now + timeout_; }
  void stop() noexcept { deadline_.reset(); }
  void heard(Instant now) noexcept {
    if (deadline_) deadline_ = now + timeout_;
  }
  bool expired(Instant now) const noexcept { return deadline_ && now >= *deadline_; }
  std::optional<Instant> nextDeadline() const noexcept { return deadline_; }

 private:
  Duration timeout_;
  std::optional<Instant> deadline_;
};

}  // namespace nord_driver::canopen
