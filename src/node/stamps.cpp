#include "node/stamps.h"

#include <algorithm>

namespace nord_driver::node {

// A thread that is held up between the two clocks would stamp everything of this sample wrongly.
Stamps Stamps::sample() {
  constexpr Duration kAtOnce = std::chrono::microseconds{200};
  constexpr int kAttempts = 5;
  for (int attempt = 1;; ++attempt) {
    const Instant before = std::chrono::steady_clock::now();
    const ros::Time ros_now = ros::Time::now();
    if (std::chrono::steady_clock::now() - before < kAtOnce || attempt == kAttempts) return {ros_now, before};
  }
}

ros::Time Stamps::of(Instant moment) const {
  const Duration age = std::max(steady_now_ - moment, Duration::zero());
  ros::Duration ago;
  ago.fromNSec(age.count());
  return ros_now_ > ros::Time{} + ago ? ros_now_ - ago : ros_now_;
}

}  // namespace nord_driver::node
