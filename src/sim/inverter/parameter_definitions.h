// Which parameters a simulated inverter has: they differ by series and firmware.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nord_driver::sim {

/// The series with an SK TUx-PBR(-24V) bus module, ident number 7531h (BU 0020 2), and the decentralised ones, which
/// sit behind SK CU4 or SK TU4 only (BU 2700 4.1).
enum class Series : std::uint8_t { kSk300e, kSk5xxe, kSk54xe, kSk700e, kSk750e, kSk1x0e, kSk2xxe };

struct Device {
  Series series = Series::kSk5xxe;
  double firmware = 2.0;  ///< P700 is an array from V1.9 on (BU 0020 8)

  /// SK 300E, 700E and 750E: the parameters of BU 0020 6.1, and SW3 before SW2 in the telegram (7.3.6).
  bool isOlderSeries() const noexcept {
    return series == Series::kSk300e || series == Series::kSk700e || series == Series::kSk750e;
  }
  /// SK 1x0E and 2xxE: the parameters of BU 0220 5.1.
  bool isDecentral() const noexcept { return series == Series::kSk1x0e || series == Series::kSk2xxe; }
};

struct ParameterDefinition {
  std::uint16_t number;  ///< the manual's: 102 for P102
  const char* name;
  int divisor;            ///< raw = value * divisor: 100 for a resolution of 0.01
  std::int32_t minimum;   ///< raw
  std::int32_t maximum;   ///< raw
  std::int32_t factory;   ///< raw
  bool per_set;           ///< one value for each of the four parameter sets
  std::uint8_t elements;  ///< array elements; 0 = no array
  bool read_only;
  bool double_word = false;  ///< 32 bits: the orders 3, 8, 11 and 13 and the answers 2 and 5 (BU 2700 6.5.1.1)
  /// Factory settings of the first elements where they differ; the others have `factory`.
  std::array<std::int32_t, 4> first_elements{};
  std::uint8_t differing = 0;  ///< how many of them count

  std::int32_t factoryOf(std::size_t element) const noexcept {
    return element < differing ? first_elements[element] : factory;
  }
};

/// All parameters of the device, sorted by number.
std::vector<ParameterDefinition> parameterDefinitions(const Device& device);

}  // namespace nord_driver::sim
