// How long driver and simulator themselves have lived: what the machine kept them from running does not count.
#pragma once

#include <ros/ros.h>

#include <algorithm>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {

/// Counted in messages: both publish at a steady rate and make up for no message they missed. Begins when it is made.
class LivedTime {
 public:
  explicit LivedTime(const DriveTopics& drive)
      : drive_(drive), status_from_(drive.status.mark()), truth_from_(drive.truth.mark()) {}

  /// Of the driver, until it published `seen`.
  Seconds ofDriver(const DriveStatus& seen) const {
    const auto messages = drive_.status.since(status_from_);
    const auto at = std::find_if(messages.begin(), messages.end(), [&](const auto& one) { return one.get() == &seen; });
    return static_cast<double>(at - messages.begin()) / ros::param::param("nord_driver/status_rate", 50.0) * Seconds{1};
  }
  /// Of the driver and of the simulator, whichever was held up more.
  Seconds ofBoth(const DriveStatus& seen) const {
    const auto truths = drive_.truth.since(truth_from_);
    const auto count = std::count_if(truths.begin(), truths.end(),
                                     [&](const auto& truth) { return truth->header.stamp < seen.header.stamp; });
    constexpr double kTruthRate = 50.0;  // Hz
    return std::min(ofDriver(seen), static_cast<double>(count) / kTruthRate * Seconds{1});
  }

 private:
  const DriveTopics& drive_;
  std::size_t status_from_, truth_from_;
};

}  // namespace nord_driver::test
