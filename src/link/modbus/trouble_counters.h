// Which counter a trouble belongs to.
#pragma once

#include "link/modbus/modbus_connection.h"
#include "link/modbus/register_link.h"

namespace nord_driver::link {

void countTrouble(ModbusTrouble trouble, LinkCounters& counters) noexcept;
/// Adds what happened on a second connection; exchanges, those refused, skipped outputs and losses are of images and stay.
void addConnection(const LinkCounters& second, LinkCounters& to) noexcept;

}  // namespace nord_driver::link
