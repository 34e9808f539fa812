// The address of a station on a PROFIBUS segment.
#pragma once

#include <cstdint>
#include <optional>

namespace nord_driver::profibus {

/// 0..126. 126 is the address of a station that has not been given one yet: it takes no part in data exchange
/// (EN 50170-8; BU 0220 4.2.2). The broadcast address 127 is none of these.
class StationAddress {
 public:
  static constexpr std::uint8_t kUnnamed = 126;

  /// The address of a station nobody has named yet: every check of a configuration refuses it.
  constexpr StationAddress() = default;

  static constexpr std::optional<StationAddress> from(int value) noexcept {
    if (value < 0 || value > kUnnamed) return std::nullopt;
    return StationAddress{static_cast<std::uint8_t>(value)};
  }

  constexpr std::uint8_t value() const noexcept { return value_; }
  constexpr bool isUnnamed() const noexcept { return value_ == kUnnamed; }

  friend constexpr bool operator==(StationAddress a, StationAddress b) noexcept { return a.value_ == b.value_; }
  friend constexpr bool operator!=(StationAddress a, StationAddress b) noexcept { return a.value_ != b.value_; }

 private:
  constexpr explicit StationAddress(std::uint8_t value) noexcept : value_(value) {}

  std::uint8_t value_ = kUnnamed;
};

/// Every station listens, none answers.
constexpr std::uint8_t kBroadcastAddress = 127;

}  // namespace nord_driver::profibus
