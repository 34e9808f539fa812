// Asks a module once per connection for the number of poles of one inverter's motor (class 40, attribute 12; BU 0280 4.3.5)
// and says when that is not what is configured: every speed and every way would be wrong by it, and no parameter of the bus
// manuals tells it.
//
// The rated current of class 40 is the motor's. What a current in the process data is a share of is called "the respective
// nominal size" (BU 0020 7.3.7), and of the setpoints the inverter's (BU 0280 7.2.3.1): it is not used for it.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/explicit_message.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

class MotorProbe {
 public:
  /// Between two questions, while the inverter is off.
  static constexpr Duration kPause = std::chrono::seconds{1};

  MotorProbe(std::uint8_t inverter, std::uint16_t tag, int pole_pairs) noexcept
      : inverter_(inverter), tag_(tag), pole_pairs_(pole_pairs) {}

  std::optional<devicenet::ExplicitRequest> pendingRequest(Instant now) const noexcept;
  void handleStarted() noexcept { under_way_ = true; }
  void handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept;
  /// The module is not connected.
  void handleOffline() noexcept;

  /// "its motor has 6 poles by class 40, ...": once for each number that is not the configured one.
  std::optional<Sentence> takeFinding() noexcept;

 private:
  std::uint32_t id() const noexcept { return std::uint32_t{tag_} << 16 | sequence_; }

  std::uint8_t inverter_;
  std::uint16_t tag_;
  int pole_pairs_;
  bool under_way_ = false;
  bool asked_ = false;
  std::uint16_t sequence_ = 0;
  Instant next_{};
  std::uint32_t poles_ = 0;  // as told last; 0: not
  std::uint32_t found_ = 0;  // found to differ, and told of
};

}  // namespace nord_driver
