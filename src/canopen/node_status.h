// What a CANopen master knows of one node.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/emergency.h"
#include "canopen/nmt.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

enum class NodeState : std::uint8_t {
  kAbsent,       ///< has not answered since the bus was opened; it is asked again and again
  kBooting,      ///< answers, and is being checked and configured
  kOperational,  ///< seen operational (without error control: started): PDOs are exchanged
  kLost,         ///< was there, and is silent; it is asked again and again
  kRefused,      ///< answers, but must not or will not run: see `reason`. Tried again after a pause
  kReleased      ///< `Master::releaseAll()`: let go, and left alone until `restart()`
};

const char* toText(NodeState state) noexcept;

/// What was heard of a node's drives before the node was begun with; the later ones matter more.
enum class FoundMotion : std::uint8_t {
  kRests,    ///< none is enabled, or nothing was heard that tells
  kUnknown,  ///< nothing was heard, but its process data comes with the next SYNC
  kDriven    ///< one is enabled, by control words nobody sends any more
};

/// Counted since construction.
struct NodeCounters {
  std::uint64_t boot_ups = 0;  ///< boot-up frames
  std::uint64_t boots = 0;     ///< times it became operational
  std::uint64_t losses = 0;    ///< times it was operational and was lost
  std::uint64_t refusals = 0;
  std::uint64_t receive_pdos = 0;  ///< sent to it
  std::uint64_t transmit_pdos = 0;
  std::uint64_t foreign_receive_pdos = 0;  ///< sent to it by another master
  std::uint64_t emergencies = 0;
  std::uint64_t heartbeats = 0;  ///< or answers to guarding
  std::uint64_t sdo_timeouts = 0;
  std::uint64_t sdo_aborts = 0;
  std::uint64_t toggle_errors = 0;  ///< guarding answers with the wrong toggle bit
  std::uint64_t missed_guards = 0;  ///< guarding questions without an answer
  std::uint64_t malformed = 0;      ///< frames of a wrong length or with a value that does not exist
  std::uint64_t superseded = 0;     ///< RPDOs that were not sent in their cycle; never sent later
};

struct NodeStatus {
  NodeState state = NodeState::kAbsent;
  /// As it last reported itself, or was told by another master; see `ErrorControlMode::kNone`, too.
  NmtState nmt = NmtState::kUnknown;
  /// Why it does not run: one sentence for a technician without the node's name; empty while all is well. The memory
  /// is the node's for ever, and never moves.
  Sentence reason;
  std::uint32_t device_type = 0;  ///< 1000h, once read
  std::uint32_t vendor_id = 0;    ///< 1018h:1..4; of 3 and 4 only what is configured to be checked
  std::uint32_t product_code = 0;
  std::uint32_t revision_number = 0;
  std::uint32_t serial_number = 0;
  EmergencyHistory emergencies;
  /// Operational, but two nodes have its id: only to be stopped.
  bool doubled = false;
  /// It was found driven, and is given the words that stop its drives before anything else.
  bool stops_first = false;
  Instant heard_at{};                        ///< last frame of error control
  std::optional<Instant> booted_up_at;       ///< last boot-up frame
  std::optional<Instant> other_commands_at;  ///< another master's last RPDO for it
  Instant since{};                           ///< of `state`
  NodeCounters counters;

  /// Lost by its error control alone: nobody has told it to leave operation, and it may hear its RPDOs.
  bool fellSilent() const noexcept { return state == NodeState::kLost && nmt == NmtState::kOperational; }
};

}  // namespace nord_driver::canopen
