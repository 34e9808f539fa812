// The times of a node's start-up that are in no configuration.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "canopen/node_config.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

constexpr Duration kFirstAskPause = std::chrono::milliseconds{100};
constexpr Duration kFirstRefusePause = std::chrono::seconds{1};
constexpr Duration kLongestRefusePause = std::chrono::seconds{4};
/// Two nodes with one id get stop words for so long.
constexpr Duration kStopBoth = std::chrono::seconds{4};

/// Of the bus cycle, after a loss: in the first the drive layer learns of it, with the two after it goes its word that
/// stops, of which one may be lost.
constexpr std::uint8_t kCyclesToTell = 3;

/// Bounds the end of a driver whose node does not answer.
constexpr Duration kLongestRelease = std::chrono::seconds{1};

/// From NMT start until error control must have shown the node operational.
inline Duration startTimeout(const NodeConfig& config) noexcept {
  const Duration period = config.error_control.mode == ErrorControlMode::kHeartbeat
                              ? config.error_control.heartbeat_timeout
                              : config.error_control.guard_time * 2;
  return std::max(config.start_timeout, period);
}

}  // namespace nord_driver::canopen
