// 32 bit positions in the process data, which are 16 bit words: where the low and the high word of one stand.
//
// SK 700E and SK 750E have one field of 32 bits in PZD2 and PZD3; setpoint 2 keeps PZD4 and there is no setpoint 3 (BU
// 0020 7.3.5, 7.3.6). The others carry the two words in any two setpoints or actual values, chosen by their functions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

/// Functions of values 1..3: P546..P548 or P546[-01..-03] of setpoints, P543..P545 or P543[-01..-03] of actual values.
using ValueFunctions = std::array<std::uint16_t, kMaxProcessValues>;
/// SW1..SW3 or IW1..IW3 in the manual's order, as in ProcessOutput and ProcessInput.
using ProcessValues = std::array<std::int16_t, kMaxProcessValues>;

/// Which of the values (0 = SW1/IW1) holds which word.
struct PositionWords {
  std::uint8_t low = 0;
  std::uint8_t high = 0;
};

/// +-50000.000 revolutions, in thousandths (BU 0020 7.3.5).
constexpr std::int32_t kMaxPosition = 50'000'000;

/// Where a 32 bit setpoint position goes; none when the functions carry no complete one, or the series has none.
std::optional<PositionWords> setpointPositionWords(Series series, const ValueFunctions& setpoints) noexcept;

/// Where a 32 bit actual position comes from. On SK 7x0E its width follows P546: pass both.
std::optional<PositionWords> actualPositionWords(Series series, const ValueFunctions& setpoints,
                                                 const ValueFunctions& actual_values) noexcept;

/// Puts a position (thousandths of a revolution) into its two words; the third value is left alone. False beyond
/// +-kMaxPosition: nothing is written.
bool splitPosition(std::int32_t thousandths, PositionWords where, ProcessValues& values) noexcept;
std::int32_t joinPosition(PositionWords where, const ProcessValues& values) noexcept;

}  // namespace nord_driver::profile
