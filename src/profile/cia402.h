// The velocity mode of CiA 402 (objects 6040h to 6044h, P551 = on) and NORD's own process data, one told as the other.
//
// The drive layer speaks NORD's words only. With P551 on, an inverter takes 6040h, 6041h and speeds in rpm instead, and
// only parameter set 1 counts (BU 0060 p. 57; bits: BU 0070 6.4.2, the same profile on InterBus). What gets lost:
//  - bit 10, "data valid": there is no such bit, and 0000 would be "disable voltage": where NORD's words ask to be
//    ignored, nothing may be sent at all;
//  - the bus bits 8 and 9, status bits 10 and 13 and the parameter set: read as 0 and set 1;
//  - setpoints and actual values 2 and 3; the resolution of value 1, which is 1 rpm, and never less of a
//    setpoint that is not 0.
#pragma once

#include <cstdint>
#include <optional>

#include "core/units.h"
#include "nord_driver/profile/process_data.h"

namespace nord_driver::profile {

/// What goes out as 6040h and 6042h.
struct Cia402Output {
  Word control_word = 0;
  std::int16_t target_velocity = 0;  ///< rpm
};

/// What comes in as 6041h and 6044h.
struct Cia402Input {
  Word status_word = 0;
  std::int16_t actual_velocity = 0;  ///< rpm
};

/// rpm are those of the field, 60 * frequency / pole pairs: no manual says whether the inverter counts slip in.
class Cia402Scaling {
 public:
  /// `pole_pairs` > 0: of the motor. Without `max_frequency` (P105 of set 1) every speed is 0.
  explicit Cia402Scaling(int pole_pairs) noexcept : pole_pairs_(pole_pairs) {}

  void setMaxFrequency(std::optional<Hertz> max_frequency) noexcept { max_frequency_ = max_frequency; }
  std::optional<Hertz> maxFrequency() const noexcept { return max_frequency_; }

  /// None where the inverter is to ignore the words (bit 10 = 0): send nothing.
  std::optional<Cia402Output> toCia402(const ProcessOutput& output) const noexcept;
  /// An all-zero status word stays all zero: there is no inverter behind it.
  ProcessInput fromCia402(const Cia402Input& input) const noexcept;

 private:
  double rpmOfHundredPercent() const noexcept;

  int pole_pairs_;
  std::optional<Hertz> max_frequency_;
};

}  // namespace nord_driver::profile
