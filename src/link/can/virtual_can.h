// A member of a CAN bus between processes, for kernels without CAN.
#pragma once

#include <cstdint>

#include "link/can/virtual_can_end.h"

namespace nord_driver::link {

/// Somebody else, the simulator as a rule, makes the bus (VirtualCanHub). Frames take no time, there is no bit rate and
/// no error state. The bus that went away closes the link; open() joins it when it is there again.
class VirtualCan final : public VirtualCanEnd {
 public:
  explicit VirtualCan(const CanSettings& settings);
  ~VirtualCan() override;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return descriptor_ >= 0; }
  CanSend send(const CanFrame& frame) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  bool waitWritable(Instant until) noexcept override;
  CanCounters counters() const noexcept override { return counters_; }

 private:
  bool takeNext(ReceivedCanFrame& received) noexcept override;

  int descriptor_ = -1;
  std::uint16_t next_number_ = 0;
  CanCounters counters_;
};

}  // namespace nord_driver::link
