// DRIVECOM profile 21 as NORD has it on InterBus (P551 = on, PPO 1 only), and NORD's own process data, one told as the
// other (BU 0070 4.1, 6.4).
//
// It is the velocity mode of CiA 402 under an older name: bits 0 to 7, the direction in bit 11 of the control and bit
// 14 of the status word, "remote" and "setpoint reached" in bits 9 and 10, rpm, parameter set 1 only. So the
// translation is that of profile/cia402.h, and what gets lost is told there. What is different: the words are on the
// ring in every cycle. Where NORD's words ask to be ignored nothing could be left out, and 0000 would be "block
// voltage", a coasting wheel; the idle word goes out instead. There is no parameter set to learn before it; but it takes
// the enable away, which acknowledges a fault (BU 0020 8): whoever sends it first has looked at the status word.
#pragma once

#include <cstdint>

#include "nord_driver/profile/process_data.h"
#include "profile/cia402.h"

namespace nord_driver::profile {

/// OFF1: down the ramp, then "ready to switch on".
constexpr Word kDrivecomIdle = 0x007E;

/// The profile's words after the PCP word (BU 0070 4.2.1).
struct DrivecomOutput {
  Word control_word = kDrivecomIdle;
  std::int16_t speed_setpoint = 0;  ///< rpm
};
struct DrivecomInput {
  Word status_word = 0;
  std::int16_t actual_speed = 0;  ///< rpm
};

/// A minimum or maximum holds the speed (bit 11; BU 0070 6.4.2). NORD's status word has no place for it.
constexpr bool drivecomLimitReached(Word status_word) noexcept {
  return (status_word >> 11 & 1u) != 0;
}

class DrivecomScaling {
 public:
  /// `pole_pairs` > 0: of the motor. Without `max_frequency` (P105 of set 1) every speed is 0.
  explicit DrivecomScaling(int pole_pairs) noexcept : velocity_mode_(pole_pairs) {}

  void setMaxFrequency(std::optional<Hertz> max_frequency) noexcept { velocity_mode_.setMaxFrequency(max_frequency); }

  DrivecomOutput toDrivecom(const ProcessOutput& output) const noexcept;
  /// An all-zero status word stays all zero: there is no inverter behind it.
  ProcessInput fromDrivecom(const DrivecomInput& input) const noexcept;

 private:
  Cia402Scaling velocity_mode_;
};

}  // namespace nord_driver::profile
