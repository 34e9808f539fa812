// Process data types PPO 1..4: which words a bus module carries for one inverter, and in which order.
//
// The lengths depend on the bus module (by its PROFIBUS ident number), the order of SW2/SW3 on the inverter's series.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"
#include "profile/pkw.h"

namespace nord_driver::profile {

constexpr std::uint16_t kIdentTechnologyUnit = 0x7531;  ///< SK TU1/2/3-PBR, customer units (BU 0020 10.2)
constexpr std::uint16_t kIdentCu4Tu4 = 0x0BA8;          ///< SK CU4-PBR, SK TU4-PBR (BU 0220 8.3.4.5)

/// The longest: four words PKW and six words PZD.
using PpoWords = FixedVector<Word, 10>;

struct PpoLayout {
  bool has_pkw = false;
  std::uint8_t process_words = 0;    ///< on the wire, reserve words included
  std::uint8_t process_values = 0;   ///< setpoints and actual values that mean something: 1 or 3
  bool third_before_second = false;  ///< SW3 stands before SW2, IW3 before IW2
  FixedBytes<2> identifiers;         ///< the inverter's bytes in Chk_Cfg

  std::size_t words() const noexcept { return (has_pkw ? 4u : 0u) + process_words; }
  std::size_t bytes() const noexcept { return 2 * words(); }
};

/// The layout of PPO `type` (1..4) on the module with this ident number; none for another type or module.
std::optional<PpoLayout> ppoLayout(std::uint8_t type, std::uint16_t ident, Series series) noexcept;

/// To the inverter. Without a parameter channel `pkw` is not sent; reserve words are 0.
PpoWords pack(const PpoLayout& layout, const PkwWords& pkw, const ProcessOutput& output) noexcept;

/// From the inverter. False, and nothing written, when the number of words does not fit. Values a layout does not carry
/// become 0.
bool unpack(const PpoLayout& layout, const PpoWords& words, PkwWords& pkw, ProcessInput& input) noexcept;

}  // namespace nord_driver::profile
