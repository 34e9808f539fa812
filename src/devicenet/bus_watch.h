// Others on the bus: devices that are not configured, another master of our devices. Counted always, told once per
// device or once per second.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>

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
  BusWatch(Counters& counters, DevicenetEvents& events) noexcept : counters_(counters), events_(events) {}

  /// Everything is told again.
  void restart() noexcept;
  /// `mac`: of a device that is not configured.
  void foreignNode(std::uint8_t mac, Instant now) noexcept;
  /// `mac`: the device's; in a strobe command the other master's.
  void secondScanner(const CanFrame& frame, Group2 message, std::uint8_t mac, Instant now) noexcept;
  /// A duplicate-MAC message that is none.
  void malformed(const CanFrame& frame, Instant now) noexcept;
  void tell(DevicenetEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept;

 private:
  static bool again(std::optional<Instant>& told, Instant now) noexcept;

  Counters& counters_;
  DevicenetEvents& events_;
  std::bitset<kMacIds> told_nodes_;
  std::optional<Instant> told_master_, told_malformed_;
};

}  // namespace nord_driver::devicenet
