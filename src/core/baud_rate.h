// Bit times of a serial line.
#pragma once

#include <cstdint>

#include "nord_driver/core/time.h"

namespace nord_driver {

/// A character on PROFIBUS: start bit, eight data bits, even parity, stop bit (EN 50170, 8E1).
constexpr std::uint32_t kBitsPerCharacter = 11;

/// Bits per second of a serial line, and the one place where bit times become time.
class BaudRate {
 public:
  constexpr explicit BaudRate(std::uint32_t bits_per_second) noexcept : bits_per_second_(bits_per_second) {}

  constexpr std::uint32_t bitsPerSecond() const noexcept { return bits_per_second_; }
  /// Rounded up, so that a pause is never too short.
  constexpr Duration bits(std::uint64_t count) const noexcept {
    return Duration{static_cast<Duration::rep>((count * 1'000'000'000ull + bits_per_second_ - 1) / bits_per_second_)};
  }
  constexpr Duration characters(std::uint64_t count) const noexcept { return bits(count * kBitsPerCharacter); }

  friend constexpr bool operator==(BaudRate a, BaudRate b) noexcept { return a.bits_per_second_ == b.bits_per_second_; }

 private:
  std::uint32_t bits_per_second_;
};

}  // namespace nord_driver
