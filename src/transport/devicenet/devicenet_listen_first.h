// Listens on a DeviceNet bus before a program for parameters sends anything: a second scanner would be in the way of the
// one that has the devices.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// A frame that only a master of the predefined connection set sends, or that a slave sends to its master only.
bool isOfMaster(const CanFrame& frame) noexcept;

/// Silent from `restart()` on for as long as it listens, and for good where a scanner works with the bus.
class DevicenetListenFirst {
 public:
  explicit DevicenetListenFirst(Duration time) noexcept : time_(time) {}

  /// The bus was opened.
  void restart(Instant now) noexcept;
  /// While it listens: whatever was received.
  void handle(const CanFrame& frame) noexcept;
  /// At any time: another scanner works with one of our devices.
  void handleScanner(std::uint32_t id) noexcept;
  /// After everything received until `now` was handled.
  bool mayTalk(Instant now) noexcept;

  /// As `mayTalk()` has told it last.
  bool isSilent() const noexcept { return listening_ || heard_; }
  /// The identifier heard first.
  std::optional<std::uint32_t> heard() const noexcept { return heard_; }
  /// When listening is over; not once somebody was heard.
  std::optional<Instant> nextDeadline() const noexcept;
  /// Why nothing is sent: one sentence; empty when it may talk.
  Sentence text() const noexcept;

 private:
  Duration time_;
  bool listening_ = true;
  Instant end_{};
  std::optional<std::uint32_t> heard_;
};

}  // namespace nord_driver
