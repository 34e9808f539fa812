// Which process-data words carry positions and POSICON control bits, by series and function code.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sim/inverter/parameter_definitions.h"

namespace nord_driver::sim {

/// What one word means to the position control.
enum class PositionWord : std::uint8_t {
  kNone,
  kWhole,  ///< 16 bits of their own, signed
  kWide,   ///< 32 bits in a field (SK 700E, 750E)
  kLow,    ///< of 32 bits in two words anywhere
  kHigh,
  kControlBits,  ///< POSICON control bits
};

struct PositionFunction {
  PositionWord word = PositionWord::kNone;
  bool set_position = false;  ///< of an actual value: where the shaft shall be, not where it is
  bool increments = false;    ///< in increments of the encoder, not in 0.001 revolutions
};

/// The series has POSICON: SK 700E and 750E, SK 53xE and above, SK 2xxE (BU 0020 7.3.5, BU 2700 6.4.4).
bool hasPosicon(Series series) noexcept;
/// Setpoint `n` (0 to 2) with this code in P546 to P548 or P546 [-01] to [-03].
PositionFunction positionSetpoint(const Device& device, unsigned n, std::int32_t code) noexcept;
/// The same of actual values, P543 to P545.
PositionFunction positionActual(const Device& device, std::int32_t code) noexcept;

}  // namespace nord_driver::sim
