// What a CANopen master is told, and the check of the whole before the bus is opened.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopen/node_config.h"

namespace nord_driver::canopen {

struct MasterConfig {
  std::vector<NodeConfig> nodes;                    ///< 1..126
  std::optional<std::uint32_t> sync_cob_id;         ///< 080h usually; nothing: no SYNC is sent
  std::optional<std::uint8_t> own_id;               ///< our own node id; nothing: no heartbeat is sent
  Duration heartbeat_time{};                        ///< ours; 0: only a boot-up. Whole milliseconds
  Duration ask_interval = std::chrono::seconds{1};  ///< at most so long between two questions to an absent node
};

/// Throws std::invalid_argument with a sentence naming node and value: an id twice or out of range, a COB-ID twice or
/// reserved, a PDO longer than 8 bytes or numbered twice, a time out of range, SYNC needed but not sent.
void checkConfig(const MasterConfig& config);

/// The configuration with everything filled in that was left to the predefined connection set.
MasterConfig completed(MasterConfig config);

/// Of all nodes together.
std::size_t receivePdosOf(const MasterConfig& config) noexcept;

}  // namespace nord_driver::canopen
