// Which path to open now: an adapter that was unplugged may come back under another name.
#pragma once

#include <string>
#include <utility>

#include "link/serial/serial_system.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

/// A link (below /dev/serial/by-id or a rule's own) is followed at every opening: what it leads to is its owner's
/// business. A plain device such as /dev/ttyUSB0 is another adapter as soon as two are plugged in the other way round;
/// so the first opening remembers which adapter it was, and later ones take that adapter or none. Adapters without a
/// USB serial number cannot be told apart: their name is all there is.
class DeviceFinder {
 public:
  DeviceFinder(std::string configured, bool follow_adapter)
      : configured_(std::move(configured)), follow_adapter_(follow_adapter) {}

  /// The device to open. False: `reason` says why there is none.
  bool find(SerialSystem& system, DevicePath& device, Sentence& reason) const noexcept;
  /// `device` was opened.
  void opened(SerialSystem& system, const DevicePath& device) noexcept;

  const std::string& configured() const noexcept { return configured_; }
  /// The remembered link below /dev/serial/by-id; empty when there is none.
  const DevicePath& adapter() const noexcept { return adapter_; }

 private:
  std::string configured_;
  bool follow_adapter_;
  DevicePath adapter_;
};

}  // namespace nord_driver::link
