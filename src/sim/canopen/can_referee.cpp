#include "sim/canopen/can_referee.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kStart = 0x01;
constexpr std::uint8_t kStop = 0x02;
constexpr std::uint8_t kPreOperational = 0x80;
constexpr std::uint8_t kResetNode = 0x81;
constexpr std::uint8_t kResetCommunication = 0x82;

constexpr std::uint32_t kSync = 0x80;
constexpr std::uint32_t kErrorControl = 0x700;
constexpr std::uint8_t kToggleBit = 0x80;

}  // namespace

const char* toString(CanRule rule) noexcept {
  switch (rule) {
    case CanRule::kExtendedFrame:
      return "a frame with a 29 bit identifier: CANopen uses 11 bits (CiA 301 6.3)";
    case CanRule::kIdOfANode:
      return "a frame with an identifier that a node sends itself: TPDO, EMCY, SDO answer, heartbeat";
    case CanRule::kUnknownId:
      return "a frame with an identifier that no node listens to";
    case CanRule::kNmtLength:
      return "an NMT command that is not two bytes long (CiA 301 7.2.8.2.1)";
    case CanRule::kNmtCommand:
      return "an NMT command other than 01h, 02h, 80h, 81h and 82h (CiA 301 7.2.8.2.1)";
    case CanRule::kNmtUnknownNode:
      return "an NMT command to a node that is not on the bus";
    case CanRule::kSyncLength:
      return "a SYNC with more than a counter (CiA 301 7.2.5)";
    case CanRule::kSdoLength:
      return "an SDO request that is not eight bytes long (CiA 301 7.2.4.3)";
    case CanRule::kSdoWhilePending:
      return "an SDO request to a server that has not answered the one before";
    case CanRule::kSdoToStopped:
      return "an SDO request to a node the master has stopped (CiA 301 7.3.2.2.4)";
    case CanRule::kRpdoBeforeOperational:
      return "an RPDO to a node that is not operational (BU 0060 p. 57)";
    case CanRule::kRpdoLength:
      return "an RPDO whose length is not that of its mapping";
    case CanRule::kMappingOrder:
      return "a PDO changed out of order: pre-operational, off, count 0, entries, count, on (BU 0060 p. 63)";
    case CanRule::kRemotePdo:
      return "a PDO asked for by a remote frame: bit 30 is always 1 (BU 0060 p. 63)";
    case CanRule::kRemoteLength:
      return "a guarding request for another length than one byte (CiA 301 7.2.8.3.2.1)";
    case CanRule::kGuardingBesideHeartbeat:
      return "guarding of a node that sends heartbeats: only one of the two (CiA 301 7.2.8.3)";
    case CanRule::kZeroControlWord:
      return "a control word with bit 10 = 0 after valid ones: it is not evaluated, the drive runs on (BU 2700 6.4.1)";
    case CanRule::kCount:
      break;
  }
  return "?";
}

void CanReferee::masterFrame(const CanFrame& frame) noexcept {
  if (frame.extended) return broken(CanRule::kExtendedFrame);
  if (frame.id == 0) return nmt(frame);
  if (frame.id == kSync && (frame.remote || frame.size > 1)) broken(CanRule::kSyncLength);
  if (frame.remote && frame.id > kErrorControl && frame.size != 1) broken(CanRule::kRemoteLength);
}

void CanReferee::nmt(const CanFrame& frame) noexcept {
  if (frame.remote || frame.size != 2) return broken(CanRule::kNmtLength);
  const std::uint8_t command = frame.data[0];
  const std::uint8_t node = frame.data[1];
  const bool known = command == kStart || command == kStop || command == kPreOperational || command == kResetNode ||
                     command == kResetCommunication;
  if (!known) return broken(CanRule::kNmtCommand);
  if (node >= kNodes || (node != 0 && !views_[node].exists)) return broken(CanRule::kNmtUnknownNode);
  for (std::size_t i = 1; i < kNodes; ++i) {
    if (node != 0 && i != node) continue;
    views_[i].started = command == kStart;
    views_[i].says_so = false;
    views_[i].stopped = command == kStop;
    views_[i].since_told = 0;
  }
}

void CanReferee::delivered(const CanFrame& frame, bool is_operational) noexcept {
  if (frame.extended || frame.remote || frame.id <= kErrorControl || frame.id > kErrorControl + 127) return;
  if (frame.size != 1) return;
  View& view = views_[frame.id - kErrorControl];
  const auto state = static_cast<NmtState>(frame.data[0] & ~unsigned{kToggleBit});
  if (state == NmtState::kOperational) {
    view.says_so = true;
    return;
  }
  // A state that waited for the bus may be over already: it is nothing to judge by.
  if (is_operational) return;
  if (state != NmtState::kStopped) view.stopped = false;
  if (view.started || view.says_so) view.since_told = view.tolerated;
  view.started = view.says_so = false;
}

void CanReferee::rpdo(std::uint8_t node, std::size_t length, std::size_t expected) noexcept {
  if (length != expected) broken(CanRule::kRpdoLength);
  View& view = views_[node];
  if (view.started || view.says_so) return;
  if (view.since_told > 0) {
    --view.since_told;
    return;
  }
  broken(CanRule::kRpdoBeforeOperational);
}

void CanReferee::sdoRequest(std::uint8_t node, const CanFrame& frame, bool pending) noexcept {
  if (frame.size != 8) broken(CanRule::kSdoLength);
  const bool abort = frame.size > 0 && frame.data[0] == 0x80;
  if (pending && !abort) broken(CanRule::kSdoWhilePending);
  if (views_[node].stopped) broken(CanRule::kSdoToStopped);
}

}  // namespace nord_driver::sim
