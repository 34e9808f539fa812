// Asks a module for the state of one of its inverters by the control supervisor object (class 41, attribute 6; BU 0280
// 4.3.6): where the process data do not tell whether there is an inverter, or are not exchanged at all.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/explicit_message.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

class StateProbe {
 public:
  static constexpr Duration kPause = std::chrono::milliseconds{250};

  /// `always`: in doubt the inverter is off until it was heard. Otherwise it is there until a parameter access was
  /// answered "resource unavailable" (BU 0280 4.1.2), and then asked for until it answers again.
  StateProbe(std::uint8_t inverter, std::uint16_t tag, bool always) noexcept
      : inverter_(inverter), tag_(tag), always_(always) {}

  std::optional<devicenet::ExplicitRequest> pendingRequest(Instant now) const noexcept;
  void handleStarted() noexcept { under_way_ = true; }
  void handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept;
  /// A parameter access was answered "resource unavailable".
  void handleAbsence() noexcept;
  /// The module is not connected.
  void handleOffline() noexcept;

  bool present() const noexcept { return always_ ? known_ && !absent_ : !absent_; }
  /// As told last; none when the module does not have the object, or was not asked yet.
  std::optional<std::uint8_t> state() const noexcept { return state_; }

 private:
  std::uint32_t id() const noexcept { return std::uint32_t{tag_} << 16 | sequence_; }

  std::uint8_t inverter_;
  std::uint16_t tag_;
  bool always_;
  bool under_way_ = false;
  bool known_ = false;
  bool absent_ = false;
  std::uint16_t sequence_ = 0;
  std::optional<std::uint8_t> state_;
  Instant next_{};
};

}  // namespace nord_driver
