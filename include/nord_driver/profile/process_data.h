// The process data of one inverter, free of any bus: what goes to it and what comes back.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::profile {

/// The most setpoints and actual values any NORD bus module carries (BU 2700 6.4).
constexpr std::size_t kMaxProcessValues = 3;

/// Control word and setpoints SW1..SW3 in the manual's order, whatever the order on the wire.
/// The default is the word with bit 10 = 0: the inverter ignores the whole process data (BU 2700 6.4.1 note 2).
struct ProcessOutput {
  Word control_word = 0;
  std::array<std::int16_t, kMaxProcessValues> setpoints{};
  /// Of the bus module in front of the inverter: its digital outputs, DO1 in bit 0. A module that several inverters
  /// share has those of any of them on. Ignored where the bus does not carry them (DriveIdentity::module_io).
  std::uint8_t module_outputs = 0;
};

/// Status word and actual values IW1..IW3 in the manual's order.
struct ProcessInput {
  Word status_word = 0;
  std::array<std::int16_t, kMaxProcessValues> actual_values{};
};

constexpr bool operator==(const ProcessOutput& a, const ProcessOutput& b) noexcept {
  return a.control_word == b.control_word && a.setpoints[0] == b.setpoints[0] && a.setpoints[1] == b.setpoints[1] &&
         a.setpoints[2] == b.setpoints[2] && a.module_outputs == b.module_outputs;
}
constexpr bool operator==(const ProcessInput& a, const ProcessInput& b) noexcept {
  return a.status_word == b.status_word && a.actual_values[0] == b.actual_values[0] &&
         a.actual_values[1] == b.actual_values[1] && a.actual_values[2] == b.actual_values[2];
}

}  // namespace nord_driver::profile
