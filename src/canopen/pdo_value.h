// The last process data a node sent in one PDO.
#pragma once

#include <cstdint>

#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

struct PdoValue {
  FixedBytes<kCanDataLength> bytes;  ///< of the mapped length; of any, when the mapping is not configured
  Instant at{};                      ///< when it was received
  std::uint64_t count = 0;           ///< received since the node became operational
};

}  // namespace nord_driver::canopen
