// What a word of the process data carries: the function codes of setpoints (P546 to P548) and actual values (P543 to
// P545). Each series has a table of its own, SK 300E, 700E and 750E one more for setpoint 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

/// What a function means, whatever number a series gives it. Those without a use in this driver are kOther: they are
/// known by name, and their words travel raw.
enum class WordUse : std::uint8_t {
  kOff,
  kOther,
  kDisputed,  ///< two issues of the manual name it differently: not used before somebody knows which one counts
  kFrequency,
  kFrequencyAddition,
  kFrequencySubtraction,
  kMinimumFrequency,
  kMaximumFrequency,
  kTorqueLimit,
  kTorqueSwitchOff,  ///< the inverter switches off where it is exceeded
  kCurrentLimit,
  kCurrentSwitchOff,
  kTorquePrecontrol,
  kBusBits,  ///< bus I/O in bits 0 to 7 of a setpoint, out bits 0 to 7 of an actual value
  kPositionLow,
  kPositionHigh,
  kPosition16,
  kPosition32,
  kIncrement16,  ///< a position in increments of an encoder (BU 0020 6.1.2 note 4)
  kIncrement32,
  kPosiconBits,
  kSpeed,
  kCurrent,
  kTorqueCurrent,
  kDigitalIo,
  kAnalogInput1,
  kAnalogInput2,
};

/// What 4000h (16384) of such a word stands for.
enum class Nominal : std::uint8_t {
  kNone,              ///< no manual at hand says it
  kBits,              ///< single bits
  kRaw,               ///< a number of its own
  kMaximumFrequency,  ///< P105 of the parameter set (BU 0020 7.3.6, BU 0220 7.2.1.3)
  kOwnFrequency,      ///< P105 by BU 0220 7.2.1.3, P411, 50 Hz or 100 Hz by BU 0200 p. 297: has to be told
  kTorqueLimit,       ///< P112, the torque current limit
  kRatedCurrent,      ///< the inverter's rated current (BU 0020 7.3.6); the tables name P536 beside it
  kPrecontrol,        ///< P214
  kNominalSize,       ///< "the respective nominal size" (BU 0020 7.3.7)
  kThousandthTurn,    ///< no share: 1 is 0.001 revolutions (BU 0020 7.3.5)
};

struct WordFunction {
  std::uint16_t code;
  std::uint8_t series;  ///< one bit per series, 1 << Series
  const char* name;     ///< as in the files of the catalogue
  WordUse use;
  Nominal nominal;
};

/// `place`: 1 for setpoint 1, 2 and 3 for the others. nullptr: reserved, or in no manual.
const WordFunction* findSetpointFunction(Series series, std::size_t place, std::uint16_t code) noexcept;
const WordFunction* findActualValueFunction(Series series, std::uint16_t code) noexcept;

/// The code that gives the setpoint in `place` this use; none where the series has no such function there.
std::optional<std::uint16_t> setpointCode(Series series, std::size_t place, WordUse use) noexcept;
std::optional<std::uint16_t> actualValueCode(Series series, WordUse use) noexcept;

/// "P105", "P112, the torque current limit": what 100 % of it is, for people; empty where it is no share of anything.
const char* toString(Nominal nominal) noexcept;

/// "Torque current limit"; "reserved or unknown" for a code without a name.
const char* setpointName(Series series, std::size_t place, std::uint16_t code) noexcept;
const char* actualValueName(Series series, std::uint16_t code) noexcept;

/// Where a function is set: P547, or P546 [-02] where the series has an array (BU 2700 6.4.4).
struct WordParameter {
  std::uint16_t number = 0;
  std::uint8_t index = 1;  ///< of an array
  bool is_array = false;
};
/// `place`: 1 to 3.
WordParameter setpointParameter(Series series, std::size_t place) noexcept;
WordParameter actualValueParameter(Series series, std::size_t place) noexcept;

}  // namespace nord_driver::profile
