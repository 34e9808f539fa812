// What the kernel says about a CAN interface: read once at the opening, and told again whenever it changes.
#pragma once

#include <cstdint>

#include "link/can/can_link.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

using InterfaceWord = FixedText<15>;

struct CanInterface {
  int index = 0;
  InterfaceWord name;
  InterfaceWord kind;   ///< "can" (a controller), "vcan", "vxcan"; empty where the driver says nothing (slcan)
  InterfaceWord queue;  ///< queueing discipline ("pfifo_fast", "fq_codel", "noqueue")
  bool is_can = false;  ///< and not Ethernet, for example
  bool up = false;
  bool removed = false;          ///< the message said that the interface was removed
  bool has_controller = false;   ///< what follows was told
  bool listen_only = false;      ///< the controller may neither send nor acknowledge
  std::uint32_t bit_rate = 0;    ///< bit/s; 0: not told, or not set yet
  std::uint32_t restart_ms = 0;  ///< time from bus-off to the automatic restart; 0: none
  CanState state = CanState::kUnknown;
};

/// Takes one message of rtnetlink (RTM_NEWLINK or RTM_DELLINK, header included). False when it is something else or
/// not well-formed.
bool parseLinkMessage(ByteView message, CanInterface& interface) noexcept;

}  // namespace nord_driver::link
