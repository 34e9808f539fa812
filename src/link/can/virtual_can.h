// A member of a CAN bus between processes, for kernels without CAN.
#pragma once

#include <string>

#include "link/can/can_id_filter.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// Somebody else, the simulator as a rule, makes the bus (VirtualCanHub). Frames take no time, there is no bit rate and
/// no error state. The bus that went away closes the link; open() joins it when it is there again.
class VirtualCan final : public CanLink {
 public:
  explicit VirtualCan(const CanSettings& settings);
  ~VirtualCan() override;
  VirtualCan(const VirtualCan&) = delete;
  VirtualCan& operator=(const VirtualCan&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return descriptor_ >= 0; }
  CanSend send(const CanFrame& frame) noexcept override;
  bool receive(ReceivedCanFrame& received) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  bool waitWritable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override;
  Instant now() const noexcept override;
  CanState state() const noexcept override { return CanState::kUnknown; }
  CanCounters counters() const noexcept override { return counters_; }
  const std::string& lastError() const noexcept override { return error_; }
  const char* advice() const noexcept override { return ""; }

 private:
  bool fail(const char* what, int error = 0) noexcept;
  bool takeNext(ReceivedCanFrame& received) noexcept;

  CanSettings settings_;
  CanIdFilter filter_;
  Sentence problem_;  // with the settings
  std::string error_;
  int descriptor_ = -1;
  std::uint16_t next_number_ = 0;
  bool has_pending_ = false;
  ReceivedCanFrame pending_;
  CanCounters counters_;
};

}  // namespace nord_driver::link
