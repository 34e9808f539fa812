// What is asked of one SDO server, and what came of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::canopen {

/// Most bytes of one object that a client can carry. NORD's objects have 1 to 4; strings have some tens. A multiple of
/// the 7 bytes of a segment, since the last one of a block comes filled up.
constexpr std::size_t kSdoCapacity = 1022;

/// The two identifiers of one SDO server. A gateway has several servers (BU 0260: 1200h to 1203h, one per inverter).
struct SdoChannel {
  std::uint32_t request_id = 0;   ///< from us to the server
  std::uint32_t response_id = 0;  ///< from the server to us
};

/// Server 0 of a node, which every node has (CiA 301, pre-defined connection set).
constexpr SdoChannel defaultSdoChannel(std::uint8_t node_id) noexcept {
  return {0x600u + node_id, 0x580u + node_id};
}

struct SdoRequest {
  std::uint32_t id = 0;  ///< the asker's own; comes back in the answer
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  bool write = false;
  /// Ask for a block transfer. A server that has none is asked again in plain.
  bool block = false;
  /// Of a write, least significant byte first; longer data: see `SdoClient::start()`.
  FixedBytes<8> data;
};

SdoRequest sdoRead(std::uint32_t id, std::uint16_t index, std::uint8_t sub_index) noexcept;
/// `size`: 1, 2 or 4 bytes of `value` are written; negative values in two's complement.
SdoRequest sdoWrite(std::uint32_t id, std::uint16_t index, std::uint8_t sub_index, std::uint32_t value,
                    std::size_t size) noexcept;

enum class SdoEnd : std::uint8_t {
  kDone,
  kAbortedByServer,  ///< `abort_code` is the server's
  kAbortedByUs,      ///< the server broke the rules; `abort_code` says which one
  kTimedOut,         ///< the server did not answer; `abort_code` is 0504 0000h, which we sent it
};

struct SdoAnswer {
  std::uint32_t id = 0;
  SdoEnd end = SdoEnd::kDone;
  std::uint32_t abort_code = 0;  ///< see `abortText()`
  ByteView data;                 ///< of a read; in the client, valid until its next `start()`
  /// False when the server did not tell how many of the 4 bytes are meant.
  bool size_told = true;

  bool ok() const noexcept { return end == SdoEnd::kDone; }
  /// The number in 1 to 4 bytes, least significant first, without sign. Nothing for other sizes or when not `ok()`.
  std::optional<std::uint32_t> number() const noexcept;
};

}  // namespace nord_driver::canopen
