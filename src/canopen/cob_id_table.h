// What each identifier means on this bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "canopen/master_config.h"

namespace nord_driver::canopen {

constexpr std::size_t kCobIds = 0x800;  // 11 bits
constexpr std::uint32_t kTimeCobId = 0x100;

struct CobIdUse {
  enum class Kind : std::uint8_t {
    kForeign,  ///< of nothing we know
    kIgnored,  ///< anybody may send it and we do not care: TIME, SYNC when we send none
    kNmt,
    kSync,  ///< ours
    kEmergency,
    kTransmitPdo,
    kReceivePdo,  ///< we send it
    kSdoAnswer,
    kSdoRequest,  ///< we send it
    kErrorControl,
    kOwnHeartbeat,
    kForeignNode  ///< emergency or error control of a node that is not configured: `item` is its id
  };
  Kind kind = Kind::kForeign;
  std::uint8_t node = 0;   ///< index
  std::uint16_t item = 0;  ///< index of the PDO or the SDO server
};

/// The whole table, by identifier: `config` is complete and checked.
std::vector<CobIdUse> cobIdTable(const MasterConfig& config);

/// See `Master::receivedIds()` and `Master::receivedRemoteIds()`; sorted.
std::vector<std::uint32_t> receivedIdsOf(const std::vector<CobIdUse>& table);
std::vector<std::uint32_t> receivedRemoteIdsOf(const std::vector<CobIdUse>& table);

/// "the SDO answer of node 5": for sentences.
const char* toText(CobIdUse::Kind kind) noexcept;

}  // namespace nord_driver::canopen
