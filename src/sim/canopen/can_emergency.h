// Emergency messages (EMCY): NORD's codes for the faults of an inverter, the error register and the history.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

/// The emergency code of a fault by its number in P700 (100 = E10.0): BU 0060 p. 93. 1000h when the table has no row.
std::uint16_t emergencyCode(std::uint16_t fault) noexcept;

/// 1001h and 1003h.
class CanEmergencyState {
 public:
  static constexpr std::size_t kHistory = 4;  ///< entries; the simulator's choice

  void setRegister(std::uint8_t value) noexcept { register_ = value; }
  std::uint8_t errorRegister() const noexcept { return register_; }

  void remember(std::uint16_t code) noexcept;
  void forget() noexcept { count_ = 0; }
  std::uint8_t count() const noexcept { return count_; }
  /// `n` from 0, the newest first.
  std::uint32_t entry(std::size_t n) const noexcept { return history_[n]; }

 private:
  std::uint8_t register_ = 0;
  std::uint8_t count_ = 0;
  std::array<std::uint32_t, kHistory> history_{};
};

}  // namespace nord_driver::sim
