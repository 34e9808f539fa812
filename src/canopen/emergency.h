// Emergency objects (CiA 301 7.2.7): what a node says about its faults, and the last of them.
#pragma once

#include <array>
#include <cstdint>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

constexpr std::uint32_t kEmergencyBase = 0x080;  ///< + node id

struct Emergency {
  std::uint16_t code = 0;                      ///< 0000h: error reset or no error
  std::uint8_t error_register = 0;             ///< 1001h
  std::array<std::uint8_t, 5> manufacturer{};  ///< NORD's gateway: the first is the inverter, 0..3
  Instant at{};
};

/// The last emergencies of one node, oldest overwritten.
class EmergencyHistory {
 public:
  static constexpr std::size_t kLength = 8;

  /// False, and nothing kept, when the frame is not 8 bytes long.
  bool handle(const CanFrame& frame, Instant now) noexcept;
  /// Forgets everything, the count included.
  void clear() noexcept { *this = EmergencyHistory{}; }

  std::uint64_t count() const noexcept { return count_; }
  /// How many are kept: at most kLength.
  std::size_t size() const noexcept { return count_ < kLength ? static_cast<std::size_t>(count_) : kLength; }
  /// 0 is the newest; below `size()`.
  const Emergency& back(std::size_t i) const noexcept;
  /// The newest one was a fault, not "error reset".
  bool standing() const noexcept { return count_ != 0 && back(0).code != 0; }

 private:
  std::array<Emergency, kLength> items_{};
  std::uint64_t count_ = 0;
};

}  // namespace nord_driver::canopen
