// How many bus cycles the messages about a drive show until something holds.
#pragma once

#include <ros/time.h>

#include <functional>
#include <set>
#include <vector>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {

using Statuses = std::vector<Topic<DriveStatus>::Pointer>;
using Condition = std::function<bool(const DriveStatus&)>;

/// How many cycles ended before the first for which `good` holds, from `since` on; -1: none. The publisher has its own
/// clock and may tell of a cycle twice, with one stamp.
inline int cyclesUntil(const Statuses& statuses, ros::Time since, const Condition& good) {
  std::set<ros::Time> cycles;
  for (const auto& status : statuses) {
    if (status->header.stamp < since) continue;
    if (good(*status)) return static_cast<int>(cycles.size());
    cycles.insert(status->header.stamp);
  }
  return -1;
}

}  // namespace nord_driver::test
