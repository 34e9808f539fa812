// How often the node looks whether it is asked to end.
#pragma once

#include <algorithm>

#include "nord_driver/core/time.h"

namespace nord_driver::node {

/// From a signal to the first smaller setpoint there are two bus cycles: half a cycle until it is seen leaves the cycle
/// that takes the stop, and the next one to say it. Not less than 1 ms, which is one or two cycles of the fastest bus
/// anyway; not more than 20 ms, where cycles are long.
inline Duration endPollPeriod(Duration cycle) noexcept {
  return std::clamp<Duration>(cycle / 2, std::chrono::milliseconds{1}, std::chrono::milliseconds{20});
}

}  // namespace nord_driver::node
