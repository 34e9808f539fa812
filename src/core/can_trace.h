// CAN frames as records of a trace: as pcap's link type 227 lays them out, and as candump writes them.
#pragma once

#include <optional>
#include <string>

#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver {

/// Four bytes identifier and flags (high byte first), length, three reserved, then the data
/// (www.tcpdump.org/linktypes/LINKTYPE_CAN_SOCKETCAN.html).
using CanPacket = FixedBytes<8 + kCanDataLength>;

CanPacket toPacket(const CanFrame& frame) noexcept;
/// None when the bytes are no such packet.
std::optional<CanFrame> fromPacket(ByteView packet) noexcept;

/// "232#7E040000", "732#R1": what candump -L and cansend understand.
std::string candumpText(const CanFrame& frame);

}  // namespace nord_driver
