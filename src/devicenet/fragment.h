// The byte that says which part of a fragmented message a frame carries.
#pragma once

#include <cstdint>

namespace nord_driver::devicenet {

enum class FragmentType : std::uint8_t { kFirst = 0, kMiddle = 1, kLast = 2, kAcknowledge = 3 };

/// The count of a first fragment that is the last one too (I/O only).
constexpr std::uint8_t kOnlyFragment = 0x3F;

struct Fragment {
  FragmentType type = FragmentType::kFirst;
  std::uint8_t count = 0;  ///< modulo 64; 0 in the first

  constexpr std::uint8_t byte() const noexcept {
    return static_cast<std::uint8_t>(static_cast<unsigned>(type) << 6u | (count & 0x3Fu));
  }
  static constexpr Fragment from(std::uint8_t byte) noexcept {
    return {static_cast<FragmentType>(byte >> 6u), static_cast<std::uint8_t>(byte & 0x3Fu)};
  }
  constexpr std::uint8_t nextCount() const noexcept { return static_cast<std::uint8_t>((count + 1u) & 0x3Fu); }
};

}  // namespace nord_driver::devicenet
