#include "transport/canopen/canopen_listening.h"

#include <array>

namespace nord_driver {

namespace {

// The pre-defined connection set (CiA 301 7.3.3).
constexpr std::uint32_t kEmergencyBase = 0x080;
constexpr std::uint32_t kErrorControlBase = 0x700;
constexpr std::uint32_t kMaxNode = 127;
constexpr std::uint8_t kEmergencySize = 8;
constexpr std::array<std::uint32_t, 4> kTransmitPdoBases{0x180, 0x280, 0x380, 0x480};
constexpr std::uint8_t kAnswersGuarding = 0x80;  // its toggle bit: each second answer has it
// BU 2700 6.4.3, state "operation enabled": bits 0, 1, 2, 3, 5 and 6 of the status word, low byte first.
constexpr std::uint8_t kStateBits = 0x6F, kOperationEnabled = 0x27, kQuickStopActive = 0x07;
constexpr std::uint8_t kFaultBits = 0x4F, kFaultReactionActive = 0x0F;
constexpr std::uint8_t kBootUp = 0x00, kStopped = 0x04, kPreOperational = 0x7F;

bool isOfNode(std::uint32_t id, std::uint32_t base) noexcept {
  return id > base && id <= base + kMaxNode;
}

}  // namespace

const ListenRules kCanopenListening{
    showsCanopenMaster, "another master has the bus: nothing is sent beside it",
    "it is listened for other masters before anything is sent",
    "another master, nor to nodes that one has left operational: end it, or switch them off and on"};

const ListenRules kCanopenSetFree{showsCanopenMasterOrMotion,
                                  "another master has the bus, or a drive runs: nothing is sent beside it",
                                  "it is listened for other masters and running drives before anything is sent",
                                  "another master, nor to a drive that runs: end it, or stop the drive"};

bool showsCanopenMasterOrMotion(const CanFrame& frame) noexcept {
  if (frame.extended || frame.remote) return true;
  if (isOfNode(frame.id, kEmergencyBase)) return frame.size != kEmergencySize;
  if (isOfNode(frame.id, kErrorControlBase)) return frame.size != 1 || (frame.data[0] & kAnswersGuarding) != 0;
  for (const std::uint32_t base : kTransmitPdoBases) {
    // Whatever PDO it is: the first word of those that tell of an inverter is its status word.
    if (!isOfNode(frame.id, base)) continue;
    if (frame.size < 2) return false;
    const unsigned state = frame.data[0] & kStateBits;
    return state == kOperationEnabled || state == kQuickStopActive ||
           (frame.data[0] & kFaultBits) == kFaultReactionActive;
  }
  return true;
}

bool showsCanopenMaster(const CanFrame& frame) noexcept {
  if (frame.extended || frame.remote) return true;
  if (isOfNode(frame.id, kEmergencyBase)) return frame.size != kEmergencySize;
  if (!isOfNode(frame.id, kErrorControlBase) || frame.size != 1) return true;
  const std::uint8_t state = frame.data[0];
  return state != kBootUp && state != kStopped && state != kPreOperational;
}

}  // namespace nord_driver
