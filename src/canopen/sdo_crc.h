// The check sum of SDO block transfers.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::canopen {

/// CRC-16-CCITT: x^16 + x^12 + x^5 + 1, starting with 0, most significant bit first (CiA 301 7.2.4.3.16: "123456789"
/// gives 31C3h).
std::uint16_t sdoCrc(ByteView bytes) noexcept;

}  // namespace nord_driver::canopen
