// What a drive told about itself in its parameters.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::cycle {

/// In the place of a function the drive did not tell.
constexpr std::uint16_t kUnknownFunction = 0xFFFF;
/// Of setpoint 1 (P546) and actual value 1 (P543): the frequency, in each of the series' tables (BU 0020 6.1.2, 6.2.2;
/// BU 0220 5.1.3; BU 0280 5.1.3).
constexpr std::uint16_t kFrequencyFunction = 1;

/// The functions of the words of one parameter set, setpoint 1 and actual value 1 first.
struct WordFunctions {
  std::array<std::uint16_t, 3> setpoints{kUnknownFunction, kUnknownFunction, kUnknownFunction};
  std::array<std::uint16_t, 3> actual_values{kUnknownFunction, kUnknownFunction, kUnknownFunction};
};

struct DeviceData {
  std::array<std::optional<double>, 4> max_frequency;      ///< Hz, P105 of parameter sets 1..4
  std::array<std::optional<double>, 4> min_frequency;      ///< Hz, P104: at setpoint 0 the motor turns at it
  std::array<std::optional<double>, 4> acceleration_time;  ///< s from 0 Hz to P105, P102 of parameter sets 1..4
  std::array<std::optional<double>, 4> deceleration_time;  ///< s from P105 to 0 Hz, P103 likewise
  std::optional<std::int32_t> software_version;            ///< P707 [-01]: 21 = V2.1
  std::optional<std::int32_t> software_revision;           ///< P707 [-02]
  std::optional<double> telegram_timeout;                  ///< s, P513; 0 = off, -0.1 = bus errors are ignored
  std::optional<double> module_timeout;                    ///< s, P151 of the bus module; 0 = off, negative = as above
  std::optional<std::int32_t> option_monitoring;           ///< P120 [-01]: 0 = a failed module is not noticed
  std::optional<bool> saves_in_eeprom;                     ///< P560: 0 = every write is lost at power off
  /// P543 to P548 of parameter sets 1..4; of sets 2 to 4 only the first, unless further words are in use.
  std::array<WordFunctions, 4> word_functions;
  FixedVector<std::uint16_t, 12> bus_bit_functions;  ///< P480 [-01].., each in its place: what bus I/O bits do
  std::optional<std::uint16_t> out_bit_function;     ///< P481 of the element that DeviceReader was told: what it shows
  std::optional<std::int32_t> control_word_source;   ///< P509: who commands the inverter
  std::optional<std::int32_t> setpoint_source;       ///< P510 (or [-01]): whose setpoint; 0 = as P509
  /// P600 of parameter sets 1..4: 0 = it does not position.
  std::array<std::optional<std::int32_t>, 4> position_control;
  std::optional<std::int32_t> setpoint_mode;  ///< of a drive that is to position, P610: where its target comes from
  /// P607 and P608 of parameter sets 1..4, likewise: a gear between motor and count (BU 2700 6.4.4). Which of them
  /// multiplies is not said.
  std::array<std::optional<std::int32_t>, 4> speed_ratio, reduction;
  std::uint32_t ident = 0;
  bool complete = false;  ///< everything was asked for; what the drive refused is absent
};

}  // namespace nord_driver::cycle
