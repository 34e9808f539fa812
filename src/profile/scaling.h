// Setpoint 1 and actual value 1 as shares of the maximum frequency P105, and a joint's speed as a frequency.
#pragma once

#include <cstdint>

#include "core/units.h"

namespace nord_driver::profile {

/// 100 % of every setpoint and actual value (BU 2700 6.4.4).
constexpr std::int16_t kHundredPercent = 16384;

/// How a joint's speed relates to the motor's electrical frequency.
struct JointScaling {
  double gear_ratio = 1.0;  ///< motor turns per joint turn, > 0
  int pole_pairs = 2;       ///< of the motor, > 0
  bool inverted = false;    ///< a right-hand field turns the joint backwards
};

Hertz toHertz(RadPerSec joint, const JointScaling& scaling) noexcept;
RadPerSec toRadPerSec(Hertz frequency, const JointScaling& scaling) noexcept;

struct Setpoint {
  std::int16_t word = 0;
  bool saturated = false;  ///< the wanted frequency lay beyond P105
  bool invalid = false;    ///< not a number, infinite, or no usable P105: the word is 0
};

/// Setpoint 1 for a frequency, given P105 of the parameter set the same telegram commands (BU 0020 7.3.5). Saturates at
/// +-100 %: as a setpoint frequency, that is the inverter's limit.
Setpoint toSetpoint1(Hertz wanted, Hertz max_frequency) noexcept;

/// The frequency an actual value 1 stands for, given P105 of the parameter set in force (BU 2700 6.4.4).
Hertz fromActualValue1(std::int16_t word, Hertz max_frequency) noexcept;

/// A speed for a word of whole rpm: one that is not 0 is at least 1, so that rounding does not take its direction away.
/// At 0 rpm an enabled motor with P104 > 0 turns to the right.
double atLeastOneRpm(double rpm) noexcept;

}  // namespace nord_driver::profile
