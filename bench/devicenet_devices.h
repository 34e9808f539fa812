// DeviceNet devices of a benchmark: they let themselves be allocated, answer what they are asked, and each poll with five
// bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "can_responder.h"

namespace nord_driver::bench {

class DevicenetDevices {
 public:
  /// MAC ids 1 to `devices`; the scanner has 0.
  explicit DevicenetDevices(std::size_t devices) : devices_(devices) {}
  bool operator()(const can_frame& frame, const CanSay& say) const;

 private:
  std::size_t devices_;
};

}  // namespace nord_driver::bench
