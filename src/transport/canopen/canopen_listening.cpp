#include "transport/canopen/canopen_listening.h"

namespace nord_driver {

namespace {

// The pre-defined connection set (CiA 301 7.3.3).
constexpr std::uint32_t kEmergencyBase = 0x080;
constexpr std::uint32_t kErrorControlBase = 0x700;
constexpr std::uint32_t kMaxNode = 127;
constexpr std::uint8_t kEmergencySize = 8;
constexpr std::uint8_t kBootUp = 0x00, kStopped = 0x04, kPreOperational = 0x7F;

bool isOfNode(std::uint32_t id, std::uint32_t base) noexcept {
  return id > base && id <= base + kMaxNode;
}

}  // namespace

const ListenRules kCanopenListening{
    showsCanopenMaster, "another master has the bus: nothing is sent beside it",
    "it is listened for other masters before anything is sent",
    "another master, nor to nodes that one has left operational: end it, or switch them off and on"};

bool showsCanopenMaster(const CanFrame& frame) noexcept {
  if (frame.extended || frame.remote) return true;
  if (isOfNode(frame.id, kEmergencyBase)) return frame.size != kEmergencySize;
  if (!isOfNode(frame.id, kErrorControlBase) || frame.size != 1) return true;
  const std::uint8_t state = frame.data[0];
  return state != kBootUp && state != kStopped && state != kPreOperational;
}

}  // namespace nord_driver
