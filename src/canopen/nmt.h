// Network management (CiA 301 7.2.8): commands of the master, states of the nodes.
#pragma once

#include <cstdint>

#include "core/can_frame.h"

namespace nord_driver::canopen {

/// Node ids are 1..127; 0 addresses all nodes in an NMT command.
constexpr std::uint8_t kMaxNodeId = 127;
constexpr std::uint32_t kNmtCobId = 0x000;
constexpr std::uint32_t kErrorControlBase = 0x700;  ///< + node id: boot-up, heartbeat, guarding

/// Command specifiers (CiA 301 7.2.8.3.1).
enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82
};

/// As heartbeat and guarding report it (CiA 301 7.2.8.3.2).
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F,
  kUnknown = 0xFF  ///< nothing heard yet; never on the bus
};

/// "operational"; "unknown" for a value no standard names.
const char* toText(NmtState state) noexcept;
const char* toText(NmtCommand command) noexcept;

/// What heartbeat or guarding carried, bit 7 (toggle) left out. kUnknown for a value that is none of the four.
NmtState nmtStateOf(std::uint8_t value) noexcept;

/// Of a node that has followed the command; kUnknown while it starts anew.
NmtState stateAfter(NmtCommand command) noexcept;

/// 000#<command><node>; `node` 0 means all of them.
CanFrame nmtFrame(NmtCommand command, std::uint8_t node) noexcept;
/// Of a frame with that identifier: two bytes, a command that exists, and a node, or 0, that may exist.
bool isNmtCommand(const CanFrame& frame) noexcept;

}  // namespace nord_driver::canopen
