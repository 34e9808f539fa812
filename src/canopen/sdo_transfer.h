// What the four kinds of long SDO transfers have in common.
#pragma once

#include <array>
#include <cstdint>

#include "canopen/sdo_request.h"
#include "core/can_frame.h"

namespace nord_driver::canopen {

/// The data of one SDO frame: always eight bytes (CiA 301 7.2.4.3).
using SdoBytes = std::array<std::uint8_t, kCanDataLength>;
/// What is read or written, in the client.
using SdoBuffer = FixedBytes<kSdoCapacity>;

/// Data bytes of one segment.
constexpr std::size_t kSdoSegmentLength = 7;

/// What a frame of the server did to a transfer.
struct SdoStep {
  enum class Kind : std::uint8_t {
    kStale,     ///< nothing: a repeated frame, or one of an earlier transfer
    kAccepted,  ///< the transfer goes on; its time-out begins anew
    kDone,
    kAbort,  ///< the server broke a rule: `abort_code` goes to it and ends the transfer
  };
  Kind kind = Kind::kStale;
  std::uint32_t abort_code = 0;

  static constexpr SdoStep stale() noexcept { return {Kind::kStale, 0}; }
  static constexpr SdoStep accepted() noexcept { return {Kind::kAccepted, 0}; }
  static constexpr SdoStep done() noexcept { return {Kind::kDone, 0}; }
  static constexpr SdoStep abort(std::uint32_t code) noexcept { return {Kind::kAbort, code}; }
};

}  // namespace nord_driver::canopen
