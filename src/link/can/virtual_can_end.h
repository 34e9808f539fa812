// What the two ends of a virtual CAN bus share: the hub that makes it, and a member of it.
#pragma once

#include <string>

#include "link/can/can_id_filter.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

class VirtualCanEnd : public CanLink {
 public:
  VirtualCanEnd(const VirtualCanEnd&) = delete;
  VirtualCanEnd& operator=(const VirtualCanEnd&) = delete;

  bool receive(ReceivedCanFrame& received) noexcept override;
  void sleepUntil(Instant when) noexcept override;
  Instant now() const noexcept override;
  CanState state() const noexcept override { return CanState::kUnknown; }
  const std::string& lastError() const noexcept override { return error_; }
  const char* advice() const noexcept override { return ""; }

 protected:
  explicit VirtualCanEnd(const CanSettings& settings);

  /// The next frame that passes the filter, or false.
  virtual bool takeNext(ReceivedCanFrame& received) noexcept = 0;
  /// Looks whether a frame has come, and keeps it for receive(): true when one is kept.
  bool keepNext() noexcept;
  bool hasKept() const noexcept { return has_kept_; }
  void forgetKept() noexcept { has_kept_ = false; }

  /// A new socket, or -1 when there is none or the settings are wrong: lastError() tells.
  int openSocket() noexcept;
  void opened() noexcept { error_.clear(); }
  /// Closes; lastError() tells. Always false.
  bool fail(const char* what, int error = 0) noexcept;
  const std::string& interface() const noexcept { return settings_.interface; }
  bool passes(const CanFrame& frame) const noexcept { return filter_.passes(frame); }

  Sentence problem_;  // with the settings

 private:
  CanSettings settings_;
  CanIdFilter filter_;
  std::string error_;
  bool has_kept_ = false;
  ReceivedCanFrame kept_;
};

}  // namespace nord_driver::link
