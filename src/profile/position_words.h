// Which words of the process data carry a position, found by their functions, and a position in them.
//
// A position counts steps of the drive's own scale, 1000 in a revolution (BU 0020 7.3.5, BU 0280 7.2.3.2). As 32 bits
// it takes two words, low and high, of SK 2xxE, 53xE and 54xE any two in either order, by function code (BU 0020 7.3.5,
// BU 2700 6.4.4); of SK 700E and 750E the field of setpoint 1, which takes the place of setpoint 3 as well (BU 0020
// 7.3.1, 7.3.6). As 16 bits it takes one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

/// The function codes of the setpoints or actual values of one parameter set, that of word 1 first.
using FunctionCodes = std::array<std::uint16_t, kMaxProcessValues>;
/// Setpoints or actual values in the manual's order, as a telegram has them.
using ProcessValues = std::array<std::int16_t, kMaxProcessValues>;

/// Where a position stands.
struct PositionField {
  std::uint8_t bits = 0;  ///< 16 or 32; 0: no word carries it
  std::uint8_t low = 0;   ///< place of the low word, 0..2
  std::uint8_t high = 0;  ///< place of the high word, with 32 bits
  /// What the function itself says of its unit: 1000, or 8192 for the increments of SK 700E and 750E ("corresponding to
  /// an 8192 increment encoder", BU 0020 6.1.2 note 4).
  std::uint16_t steps_per_revolution = 1000;

  bool carried() const noexcept { return bits != 0; }
};

constexpr bool operator==(const PositionField& a, const PositionField& b) noexcept {
  return a.bits == b.bits && a.low == b.low && a.high == b.high && a.steps_per_revolution == b.steps_per_revolution;
}

/// Of SK 700E and 750E, the half that stands in the place of setpoint 1. BU 0280 4.2.1.1 puts the low one first, as
/// DeviceNet does with bytes; of PROFIBUS and InterBus, which send high bytes first, no manual at hand says it.
enum class FieldOrder : std::uint8_t { kLowFirst, kHighFirst };

/// What the words of one parameter set carry for a drive that positions.
struct PositionWords {
  PositionField setpoint;
  PositionField actual;
  std::optional<std::uint8_t> speed_setpoint;  ///< the setpoint that is the frequency, 0..2
  std::optional<std::uint8_t> speed_actual;    ///< the actual value that is the frequency, 0..2
};

/// `carried`: how many setpoints and actual values the bus carries. A low word without a high one is a position of 16
/// bits (BU 2700 6.4.4). Two halves of which one counts increments and the other does not (21 and 24) are none.
PositionWords positionWords(Series series, const FunctionCodes& setpoints, const FunctionCodes& actual_values,
                            std::size_t carried, FieldOrder order = FieldOrder::kHighFirst) noexcept;

/// A field that is not carried changes nothing. Of 16 bits the low half goes out.
void putPosition(const PositionField& field, std::int32_t steps, ProcessValues& words) noexcept;
/// Of 16 bits with its sign spread: -32768 to 32767. A field that is not carried is 0.
std::int32_t getPosition(const PositionField& field, const ProcessValues& words) noexcept;

}  // namespace nord_driver::profile
