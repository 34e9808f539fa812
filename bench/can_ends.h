// What carries the frames between a master and the nodes of a benchmark: two ends, and the way the driver reaches one.
#pragma once

#include <linux/can.h>

#include <algorithm>

#include "core/can_frame.h"
#include "link/can/can_system.h"

namespace nord_driver::bench {

/// Both ends are descriptors that block and carry the kernel's struct can_frame.
class CanEnds {
 public:
  virtual ~CanEnds() = default;

  /// For a master that writes and reads by itself.
  virtual int near() = 0;
  virtual int far() const = 0;
  /// For the driver's link in its place: what it has to open, and by whom.
  virtual const char* interface() const = 0;
  virtual link::CanSystem& system() = 0;
};

inline can_frame toKernel(const CanFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.remote ? CAN_RTR_FLAG : 0u);
  raw.can_dlc = frame.size;
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

}  // namespace nord_driver::bench
