// The objects by which a node and its master watch each other (CiA 301 7.5.2).
#pragma once

#include <cstdint>

#include "canopen/sdo_request.h"

namespace nord_driver::canopen {

constexpr std::uint16_t kGuardTimeIndex = 0x100C;
constexpr std::uint16_t kLifeTimeFactorIndex = 0x100D;
constexpr std::uint16_t kHeartbeatConsumerIndex = 0x1016;
constexpr std::uint16_t kHeartbeatProducerIndex = 0x1017;

/// Changes how long the node waits for the next question.
inline bool setsLifeTime(const SdoRequest& request) noexcept {
  return request.write && (request.index == kGuardTimeIndex || request.index == kLifeTimeFactorIndex);
}

}  // namespace nord_driver::canopen
