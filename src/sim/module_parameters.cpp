#include "sim/module_parameters.h"

#include <array>
#include <cstddef>

namespace nord_driver::sim {

std::vector<ParameterDefinition> moduleParameterDefinitions() {
  constexpr bool kReadOnly = true;
  return {
      // number, name, divisor, min, max, factory, per set, elements, read only
      {150, "Set relay", 1, 0, 4, 0, false, 0, false},
      // The range is printed as 0...32767, with a meaning for -1 below it (BU 2700 7.1.1).
      {151, "Timeout for external bus", 1, -1, 32767, 0, false, 0, false},
      {152, "Factory setting", 1, 0, 1, 0, false, 0, false},
      {153, "Min. system bus cycle", 1, 0, 250, 10, false, 2, false, false, {10, 5}, 2},  // ms: SDO, PDO
      {154, "TB-IO access", 1, 0, 5, 0, false, 2, false},
      {160, "Profibus address", 1, 3, 126, 126, false, 0, false},
      {170, "Actual error", 1, 0, 9999, 0, false, 2, kReadOnly},
      {171, "Software version", 10, 0, 99999, 12, false, 3, kReadOnly},
      {172, "Configuration level", 1, 0, 2, 1, false, 0, kReadOnly},
      {173, "Module status", 1, 0, 0xFFFF, 0, false, 0, kReadOnly},
      {174, "Digital input status", 1, 0, 255, 0, false, 0, kReadOnly},
      {175, "Relay status", 1, 0, 3, 0, false, 0, kReadOnly},
      {176, "Process data Bus In", 1, -32768, 32767, 0, false, 17, kReadOnly},
      {177, "Process data Bus Out", 1, -32768, 32767, 0, false, 17, kReadOnly},
      {180, "Actual Profibus address", 1, 3, 125, 0, false, 0, kReadOnly},
      {181, "Profibus baud rate", 1, 0, 15, 15, false, 0, kReadOnly},
      {182, "PPO Type", 1, 0, 255, 0, false, 5, kReadOnly},
  };
}

int moduleBaudRateCode(unsigned bits_per_second) noexcept {
  constexpr std::array<unsigned, 10> kRates{12'000'000, 6'000'000, 3'000'000, 1'500'000, 500'000,
                                            187'500,    93'750,    45'450,    19'200,    9'600};
  for (std::size_t code = 0; code < kRates.size(); ++code) {
    if (kRates[code] == bits_per_second) return static_cast<int>(code);
  }
  return 15;
}

}  // namespace nord_driver::sim
