// The words of a drive that positions, and what its inverter is set to for them. No bus.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/inverter/parameter_definitions.h"
#include "sim/sim_config.h"

namespace nord_driver::test {

/// The functions of the words, as P546 to P548 and P543 to P545 have them.
struct LiftWords {
  const char* name;
  const char* series;
  sim::Series simulated;
  std::array<std::int32_t, 3> setpoints;
  std::array<std::int32_t, 3> actual_values;
  int bits;
};

constexpr LiftWords kSk53x{"SK 53xE", "sk5xxe", sim::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 32};
constexpr LiftWords kSk2xx{"SK 2xxE", "sk2xxe", sim::Series::kSk2xxe, {1, 23, 24}, {1, 10, 15}, 32};
constexpr LiftWords kSk700{"SK 700E", "sk700e", sim::Series::kSk700e, {3, 1, 0}, {6, 1, 0}, 32};

inline std::vector<sim::ParameterPreset> liftParameters(const LiftWords& words, std::int32_t control = 2) {
  const bool is_array = words.simulated == sim::Series::kSk2xxe || words.simulated == sim::Series::kSk54xe;
  std::vector<sim::ParameterPreset> parameters;
  for (unsigned set = 0; set < 4; ++set) {
    for (unsigned place = 0; place < 3; ++place) {
      const auto number = [&](unsigned first) { return static_cast<std::uint16_t>(is_array ? first : first + place); };
      parameters.push_back({number(546), set, is_array ? place : 0, words.setpoints[place]});
      parameters.push_back({number(543), set, is_array ? place : 0, words.actual_values[place]});
    }
    parameters.push_back({600, set, 0, control});
    parameters.push_back({102, set, 0, 100});  // 1.0 s to 50 Hz
    parameters.push_back({103, set, 0, 100});
  }
  return parameters;
}

}  // namespace nord_driver::test
