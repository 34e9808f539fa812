// What a DeviceNet scanner knows of one device.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "devicenet/node_config.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

enum class NodeState : std::uint8_t {
  kAbsent,      ///< has not answered since the bus was opened; it is asked again and again
  kConnecting,  ///< answers, and is being checked and connected
  kExchanging,  ///< connected: process data are exchanged, requests are taken
  kLost,        ///< was there, and is silent or gone; it is asked again and again
  kRefused,     ///< answers, but must not or will not run: see `reason`. Tried again after a pause
  kReleased     ///< `Scanner::releaseAll()`: let go, and left alone until `restart()`
};

const char* toText(NodeState state) noexcept;

/// Counted since construction.
struct NodeCounters {
  std::uint64_t allocations = 0;  ///< of its explicit connection
  std::uint64_t connections = 0;  ///< times it came to exchange
  std::uint64_t losses = 0;       ///< times it was exchanging and was lost
  std::uint64_t refusals = 0;
  std::uint64_t outputs = 0;         ///< messages given out whole: poll commands, change-of-state or cyclic data
  std::uint64_t inputs = 0;          ///< messages received whole
  std::uint64_t empty_inputs = 0;    ///< messages of no bytes: the device lives and has nothing to say
  std::uint64_t missed = 0;          ///< commands without an answer before the next cycle
  std::uint64_t unacknowledged = 0;  ///< change-of-state or cyclic data nobody acknowledged, repeated
  std::uint64_t repeated = 0;        ///< explicit requests, or fragments of these, that were sent again
  std::uint64_t broken_inputs = 0;   ///< fragmented messages with a gap
  std::uint64_t malformed = 0;       ///< frames of a wrong length or with a value that does not exist
  std::uint64_t superseded = 0;      ///< messages that were not sent whole in their cycle; never sent later
  std::uint64_t keep_alives = 0;
  std::uint64_t reopened = 0;          ///< times the explicit connection had to be allocated again beside the exchange
  std::uint64_t heartbeats = 0;        ///< device heartbeat messages
  std::uint64_t foreign_requests = 0;  ///< of another master
  /// Those that another master works with it by: process data, and what it asks over a connection of its own. A request for
  /// a connection that the device refuses is none.
  std::uint64_t foreign_use = 0;
};

struct NodeStatus {
  NodeState state = NodeState::kAbsent;
  /// Why it does not run: one sentence for a technician without the device's name; empty while all is well.
  Sentence reason;
  std::uint16_t vendor_id = 0;  ///< class 1, once read
  std::uint16_t device_type = 0;
  std::uint16_t product_code = 0;
  std::uint8_t major_revision = 0;
  std::uint8_t minor_revision = 0;
  std::uint16_t produced_size = 0;  ///< class 5, attribute 7, once read: bytes it sends us
  std::uint16_t consumed_size = 0;  ///< attribute 8
  Duration packet_rate{};           ///< of the process data, as the device answered; it gives up after four times that
  Duration explicit_rate{};         ///< of the explicit connection
  /// By instance, from 1: the state of the control supervisor (class 41, attribute 6) before the process data of this
  /// connection began. None: not asked, or not told.
  std::array<std::optional<std::uint8_t>, kMostSupervisors> supervisors{};
  /// Whose it is when it refused to be ours, where known (class 3, attribute 5).
  std::optional<std::uint8_t> owner;
  std::optional<std::uint8_t> device_state;  ///< of its last heartbeat message
  std::optional<std::uint8_t> fault_flags;
  Instant heard_at{};  ///< last message of any kind
  Instant since{};     ///< of `state`
  NodeCounters counters;
};

}  // namespace nord_driver::devicenet
