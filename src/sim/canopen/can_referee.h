// The referee of a CAN bus: counts every rule of CANopen and of NORD's modules that the master breaks.
//
// It judges by what the master can know: a node that fell back by itself is no mistake of the master, talking on as if
// nothing had happened is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/can_frame.h"
#include "sim/canopen/can_communication.h"
#include "sim/rule_counts.h"

namespace nord_driver::sim {

enum class CanRule : std::uint8_t {
  kExtendedFrame,
  kIdOfANode,
  kUnknownId,
  kNmtLength,
  kNmtCommand,
  kNmtUnknownNode,
  kSyncLength,
  kSdoLength,
  kSdoWhilePending,
  kSdoToStopped,
  kRpdoBeforeOperational,
  kRpdoLength,
  kMappingOrder,
  kRemotePdo,
  kRemoteLength,
  kGuardingBesideHeartbeat,
  kZeroControlWord,
  kCount,
};

/// One sentence on the rule, with its source.
const char* toString(CanRule rule) noexcept;

class CanReferee : public RuleCounts<CanRule> {
 public:
  static constexpr std::size_t kNodes = 128;
  /// RPDOs that may still follow the message that a node is no longer operational: they were on their way. Behind a
  /// gateway each inverter has one of its own in a cycle, so that as many may be.
  static constexpr unsigned kRpdoTolerance = 3;

  /// There is a node of this number on the bus, powered or not, with so many inverters.
  void nodeExists(std::uint8_t node, std::size_t inverters) noexcept {
    views_[node].exists = true;
    views_[node].tolerated = std::max(kRpdoTolerance, static_cast<unsigned>(inverters));
  }
  /// A frame of the master: what can be judged without the nodes.
  void masterFrame(const CanFrame& frame) noexcept;
  /// A frame that reached the master; `is_operational`: its sender is by now.
  void delivered(const CanFrame& frame, bool is_operational) noexcept;
  /// An RPDO of `length` bytes reached a node that maps `expected`.
  void rpdo(std::uint8_t node, std::size_t length, std::size_t expected) noexcept;
  /// An SDO request reached a server. `pending`: its last one is not answered yet.
  void sdoRequest(std::uint8_t node, const CanFrame& frame, bool pending) noexcept;

 private:
  /// What the master can know of a node.
  struct View {
    bool exists = false;
    bool started = false;  ///< by an NMT command
    bool says_so = false;  ///< that it is operational, since the last NMT command: somebody may have started it
    bool stopped = false;
    unsigned tolerated = kRpdoTolerance;
    unsigned since_told = 0;  ///< RPDOs still tolerated since the node told that it is not operational
  };

  void nmt(const CanFrame& frame) noexcept;

  std::array<View, kNodes> views_{};
};

}  // namespace nord_driver::sim
