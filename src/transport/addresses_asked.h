// The addresses a transport asks, for its sentence that nobody answers.
#pragma once

#include <cstddef>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver {

/// "3, 4, 5", or the first ones of many and how many more. `address(i)` of 0 .. count - 1.
template <typename Address>
FixedText<60> addressesAsked(std::size_t count, Address address) noexcept {
  constexpr std::size_t kMost = 8;  // "126, " each
  FixedText<60> text;
  for (std::size_t i = 0; i < count && i < kMost; ++i) {
    FixedText<60> longer;
    longer.format("%.40s%s%u", text.c_str(), i == 0 ? "" : ", ", static_cast<unsigned>(address(i)));
    text = longer;
  }
  if (count <= kMost) return text;
  FixedText<60> longer;
  longer.format("%.40s and %u more", text.c_str(), static_cast<unsigned>(count - kMost));
  return longer;
}

}  // namespace nord_driver
