// What a scanner is told about one device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// How process data are exchanged (BU 0280 4.2.1).
enum class IoKind : std::uint8_t {
  kNone,    ///< explicit messages only
  kPoll,    ///< command and response, once a cycle
  kStrobe,  ///< one command for all, one bit for each, at most 8 bytes back; outputs, if any, by a poll beside it
  kChangeOfState,  ///< sent when changed, and at the expected packet rate
  kCyclic          ///< sent at the expected packet rate
};

const char* toText(IoKind kind) noexcept;

/// Bits of the allocation choice (class 3, services 4Bh and 4Ch; class 3 attribute 5).
namespace choice {
constexpr std::uint8_t kExplicit = 0x01;
constexpr std::uint8_t kPolled = 0x02;
constexpr std::uint8_t kStrobed = 0x04;
constexpr std::uint8_t kMulticastPolled = 0x08;
constexpr std::uint8_t kChangeOfState = 0x10;
constexpr std::uint8_t kCyclic = 0x20;
constexpr std::uint8_t kAcknowledgeSuppressed = 0x40;  ///< with one of the two before only
constexpr std::uint8_t kConnections = 0x3F;            ///< the bits that name a connection
}  // namespace choice

/// Devices round their expected packet rate up to steps of 2, 10 or 100 ms; one that answers more than this above the
/// configured rate is refused.
constexpr Duration kCoarsestStep = std::chrono::milliseconds{100};

/// A device gives up after so many times the expected packet rate.
constexpr int kRatesUntilTimeout = 4;

/// After which one has given up that was asked for `rate`, however it rounds and counts.
constexpr Duration longestOwnTimeOut(Duration rate) noexcept {
  return kRatesUntilTimeout * (rate + kCoarsestStep) + kCoarsestStep;
}

/// Directions are ours: outputs go to the device.
struct IoConfig {
  IoKind kind = IoKind::kPoll;
  std::size_t input_bytes = 0;  ///< what the device produces: 1..64, bit strobe at most 8
  /// What it consumes: 0..64. A bit strobe carries a bit for each device and nothing else: more than 0 there is a second
  /// connection, polled, for the outputs.
  std::size_t output_bytes = 0;
  /// Change of state and cyclic: each side acknowledges what it gets.
  bool acknowledge = true;
  /// Written to the device, whole milliseconds; it gives up after four times what it answers. Nothing: two cycles, at
  /// least 25 ms. With kNone: what a driver of the device has written.
  std::optional<Duration> expected_packet_rate;
  /// Our patience: for an answer to a poll or strobe command, for data or an acknowledge otherwise. Nothing: four times
  /// the expected packet rate the device answered.
  std::optional<Duration> timeout;
};

/// Control supervisors of one device (class 41, instances 1 to 4).
constexpr std::uint8_t kMostSupervisors = 4;

struct NodeConfig {
  std::uint8_t mac = 0;
  IoConfig io;
  /// Which of its control supervisors are asked for their state before process data can act: bit 0 is instance 1. For
  /// process data whose first word would change what stands, so that it must be known before.
  std::uint8_t asked_supervisors = 0;
  // The identity that is demanded; nothing: any.
  std::optional<std::uint16_t> vendor_id;     ///< class 1, attribute 1
  std::optional<std::uint16_t> device_type;   ///< attribute 2
  std::optional<std::uint16_t> product_code;  ///< attribute 3
  /// For an answer to each step of the connecting; it is asked twice.
  Duration connect_timeout = std::chrono::milliseconds{200};
  /// For an answer to a request of the layer above; it is asked twice.
  Duration request_timeout = std::chrono::milliseconds{500};
};

/// The bit strobe brings the inputs, all sampled by one command; the outputs go by a poll beside it.
constexpr bool isPolledBesideStrobe(const IoConfig& io) noexcept {
  return io.kind == IoKind::kStrobe && io.output_bytes > 0;
}

/// What is allocated for the process data; 0 without.
constexpr std::uint8_t ioChoice(const IoConfig& io) noexcept {
  const unsigned suppressed = io.acknowledge ? 0u : choice::kAcknowledgeSuppressed;
  switch (io.kind) {
    case IoKind::kNone:
      return 0;
    case IoKind::kPoll:
      return choice::kPolled;
    case IoKind::kStrobe:
      return isPolledBesideStrobe(io) ? choice::kStrobed | choice::kPolled : choice::kStrobed;
    case IoKind::kChangeOfState:
      return static_cast<std::uint8_t>(choice::kChangeOfState | suppressed);
    case IoKind::kCyclic:
      return static_cast<std::uint8_t>(choice::kCyclic | suppressed);
  }
  return 0;
}

/// The instance of the connection object (class 5) by which the inputs come; BU 0280 4.3.4 ("COS/Cyclic" is 4).
constexpr std::uint8_t connectionInstance(IoKind kind) noexcept {
  switch (kind) {
    case IoKind::kNone:
      return 1;
    case IoKind::kPoll:
      return 2;
    case IoKind::kStrobe:
      return 3;
    case IoKind::kChangeOfState:
    case IoKind::kCyclic:
      return 4;
  }
  return 1;
}

/// "Poll or COS/cyclic consuming" (INFICON Composer Elite table 5-7, Eaton DX-NET-DEVICENET table 10, Rockwell 855T table
/// B.14).
constexpr std::uint8_t kConsumingInstance = connectionInstance(IoKind::kPoll);

/// The instance that carries the outputs, before the device was asked.
constexpr std::uint8_t outputsInstance(const IoConfig& io) noexcept {
  return isPolledBesideStrobe(io) ? kConsumingInstance : connectionInstance(io.kind);
}

/// Change of state and cyclic: with some devices instance 4 produces the inputs and consumes acknowledges alone, of 0 bytes
/// or, at Eaton, 8; the outputs are consumed by `kConsumingInstance`, which has a time-out of its own. With others (Rockwell
/// 193-UM006A) 4 does both. The device tells.
constexpr bool mayTakeBySecond(const IoConfig& io) noexcept {
  return (io.kind == IoKind::kChangeOfState || io.kind == IoKind::kCyclic) && io.output_bytes > 0;
}

/// The bit strobe command carries one bit for each of the 64 MAC ids.
constexpr std::size_t kStrobeCommandLength = 8;

/// What the device must answer as the consumed size of that connection (class 5, attribute 8).
constexpr std::size_t consumedSize(const IoConfig& io, std::uint8_t instance) noexcept {
  return instance == connectionInstance(IoKind::kStrobe) ? kStrobeCommandLength : io.output_bytes;
}

}  // namespace nord_driver::devicenet
