// The configuration of the registers by which a gateway offers Compact PCP: the group bus/pcp.
#pragma once

#include <optional>
#include <vector>

#include "transport/interbus/interbus_config.h"

namespace nord_driver {

// Each throws ConfigError naming key, value and what was expected.
/// None where the group is not there.
std::optional<PcpMap> readPcp(const Settings& bus);
/// Its registers are no words of the output image and not the watchdog's, and the blocks not each other's.
void checkPcp(const Settings& bus, const PcpMap& map, const link::ModbusSettings& server);
/// The communication reference of each drive: its own, or counted from bus/pcp/first_reference in the order of the ring.
void readReferences(const Settings& bus, const std::vector<DriveSettings>& sources, std::vector<InterbusDrive>& drives);

}  // namespace nord_driver
