// The communication objects of a node as delivered: COB-IDs, which PDOs are active and what they carry.
#pragma once

#include "sim/canopen/can_communication.h"

namespace nord_driver::sim {

/// BU 0060 p. 58 and 59; of a gateway BU 0260 p. 40-42 and 52.
CanCommunication factoryCommunication(std::uint8_t node, CanConnection connection, bool cia402, bool swap_words_2_3,
                                      bool servers_set);

}  // namespace nord_driver::sim
