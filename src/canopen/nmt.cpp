#include "canopen/nmt.h"

#include <array>

namespace nord_driver::canopen {

const char* toText(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "booting";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
    case NmtState::kUnknown:
      break;
  }
  return "unknown";
}

const char* toText(NmtCommand command) noexcept {
  switch (command) {
    case NmtCommand::kStart:
      return "start";
    case NmtCommand::kStop:
      return "stop";
    case NmtCommand::kEnterPreOperational:
      return "enter pre-operational";
    case NmtCommand::kResetNode:
      return "reset node";
    case NmtCommand::kResetCommunication:
      return "reset communication";
  }
  return "unknown command";
}

NmtState nmtStateOf(std::uint8_t value) noexcept {
  constexpr std::uint8_t kToggle = 0x80;
  switch (static_cast<NmtState>(value & ~kToggle)) {
    case NmtState::kBootUp:
      return NmtState::kBootUp;
    case NmtState::kStopped:
      return NmtState::kStopped;
    case NmtState::kOperational:
      return NmtState::kOperational;
    case NmtState::kPreOperational:
      return NmtState::kPreOperational;
    case NmtState::kUnknown:
      break;
  }
  return NmtState::kUnknown;
}

NmtState stateAfter(NmtCommand command) noexcept {
  switch (command) {
    case NmtCommand::kStart:
      return NmtState::kOperational;
    case NmtCommand::kStop:
      return NmtState::kStopped;
    case NmtCommand::kEnterPreOperational:
      return NmtState::kPreOperational;
    case NmtCommand::kResetNode:
    case NmtCommand::kResetCommunication:
      break;
  }
  return NmtState::kUnknown;
}

CanFrame nmtFrame(NmtCommand command, std::uint8_t node) noexcept {
  return dataFrame(kNmtCobId, std::array<std::uint8_t, 2>{static_cast<std::uint8_t>(command), node});
}

bool isNmtCommand(const CanFrame& frame) noexcept {
  constexpr std::array<NmtCommand, 5> kCommands{NmtCommand::kStart, NmtCommand::kStop, NmtCommand::kEnterPreOperational,
                                                NmtCommand::kResetNode, NmtCommand::kResetCommunication};
  bool known = false;
  for (const NmtCommand command : kCommands) known = known || frame.data[0] == static_cast<std::uint8_t>(command);
  return !frame.remote && frame.size == 2 && known && frame.data[1] <= kMaxNodeId;
}

}  // namespace nord_driver::canopen
