// A fault that went before its number was read: what the inverter's own history has of it.
#pragma once

#include <cstdint>
#include <string>

#include "catalogue/fault_words.h"
#include "cycle/snapshot.h"

namespace nord_driver::node {

/// "; the newest of its last faults, P701[-01], is E10.2, bus timeout of the option", for a sentence about the fault
/// `number` there is or was last. Empty where that is known, or the history has not been read or is empty.
std::string rememberedFault(const cycle::DriveSnapshot& drive, std::uint16_t number,
                            const catalogue::FaultWords& words);

}  // namespace nord_driver::node
