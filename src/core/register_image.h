// The 16-bit registers of a gateway as one image: the words of all drives that go out or come in together.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver {

/// InterBus carries 256 words of process data, so no image of it is longer.
constexpr std::size_t kMostImageWords = 256;
using RegisterImage = FixedVector<Word, kMostImageWords>;

/// Words of an image, counted from its start, or registers of a server.
struct WordRange {
  std::uint16_t first = 0;
  std::uint16_t count = 0;

  constexpr unsigned end() const noexcept { return unsigned{first} + count; }  ///< one behind the last
};

constexpr bool operator==(WordRange a, WordRange b) noexcept {
  return a.first == b.first && a.count == b.count;
}

}  // namespace nord_driver
