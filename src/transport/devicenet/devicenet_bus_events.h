// What is wrong with the DeviceNet bus as a whole rather than with one drive, in words.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/devicenet_event.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver {

/// Each event is handed on once; the last warning is the text of the bus for ten seconds. Never allocates.
class DevicenetBusEvents {
 public:
  /// `mac`: of the event's device, when it has one. What one drive's own note tells is left out.
  void take(const devicenet::DevicenetEvent& event, unsigned mac) noexcept;
  /// `lost`: received frames this computer took too late, since the start. Told at most once a second.
  void noteLostFrames(const char* interface, std::uint64_t lost, Instant now) noexcept;

  std::optional<BusEvent> poll() noexcept { return events_.takeFront(); }
  /// The last warning; empty when it is too long ago.
  Sentence text(Instant now) const noexcept;
  /// That text tells of another scanner, or of two devices with one MAC id.
  bool isExplained(Instant now) const noexcept;

 private:
  void tell(const Sentence& text, bool warning) noexcept;

  FixedVector<BusEvent, 8> events_;  // what does not fit is in the counters
  Sentence text_;
  Instant text_at_{};
  std::optional<Instant> explained_at_;
  std::uint64_t lost_told_ = 0;
  Instant lost_told_at_{};
};

}  // namespace nord_driver
