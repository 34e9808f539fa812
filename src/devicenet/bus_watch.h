// Others on the bus: devices that are not configured, another master of our devices. Counted always, told once per
// device or once per second.
#pragma once

#include <cstdint>

#include "core/bus_findings.h"
#include "core/can_frame.h"
#include "devicenet/counters.h"
#include "devicenet/devicenet_event.h"
#include "devicenet/identifier.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

class BusWatch {
 public:
  /// The references live longer than this.
  BusWatch(Counters& counters, DevicenetEvents& events) noexcept : counters_(counters), findings_(events) {}

  /// Everything is told again.
  void restart() noexcept { findings_.restart(); }
  /// `mac`: of a device that is not configured.
  void foreignNode(std::uint8_t mac, Instant now) noexcept;
  /// `mac`: the device's; in a strobe command the other master's.
  void secondScanner(const CanFrame& frame, Group2 message, std::uint8_t mac, Instant now) noexcept;
  /// A duplicate-MAC message that is none.
  void malformed(const CanFrame& frame, Instant now) noexcept;
  /// What the scanner has found out of the bus as a whole.
  void tell(DevicenetEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept {
    findings_.tell(kind, text, value, now);
  }

 private:
  enum class Finding : std::uint8_t { kSecondScanner, kMalformed, kCount };

  Counters& counters_;
  BusFindings<DevicenetEvents, Finding> findings_;
};

}  // namespace nord_driver::devicenet
