// Listens on a CANopen bus before a guest talks: his start-up would take the nodes away from the master that has them.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/can_frame.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// What a node says that nobody works with: its boot-up, a heartbeat that does not say operational, an emergency. An
/// answer to guarding (bit 7 is its toggle bit) is none of these: somebody asks.
bool isSaidUnasked(const CanFrame& frame) noexcept;

/// Silent from `restart()` on for as long as it listens, and for good once somebody who works with the bus was heard.
class CanListenFirst {
 public:
  explicit CanListenFirst(Duration time) noexcept : time_(time) {}

  /// The bus was opened.
  void restart(Instant now) noexcept;
  /// While it listens: whatever was received.
  void handle(const CanFrame& frame) noexcept;
  /// At any time: a frame that only a master sends.
  void handleMaster(std::uint32_t id) noexcept;
  /// After everything received until `now` was handled. Once true, it stays so until a master is heard or `restart()`.
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
