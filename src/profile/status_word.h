// The status word (ZSW): its bits by name, and the state of the inverter they spell.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "profile/control_word.h"

namespace nord_driver::profile {

/// States A..H of the inverter's status machine (BU 2700 6.4.3); the values are those of the DriveStatus message.
enum class DriveState : std::uint8_t {
  kNotReadyToSwitchOn = 0,
  kSwitchOnDisabled = 1,
  kReadyToSwitchOn = 2,
  kSwitchedOn = 3,
  kOperationEnabled = 4,
  kQuickStopActive = 5,
  kFaultReactionActive = 6,
  kFault = 7,
  kUnknown = 255,
};

/// Bits of a status word (BU 2700 6.4.2), for what writes one.
namespace status_bit {
constexpr Word kWarning = 1u << 7;
constexpr Word kReached = 1u << 8;
constexpr Word kBusControl = 1u << 9;
constexpr Word kRight = 1u << 11;
constexpr Word kLeft = 1u << 12;
}  // namespace status_bit

/// "ready to switch on", for sentences.
const char* toString(DriveState state) noexcept;

/// A status word as received; each accessor is one bit of BU 2700 6.4.2.
class StatusWord {
 public:
  constexpr StatusWord() = default;
  constexpr explicit StatusWord(Word word) noexcept : word_(word) {}

  constexpr Word word() const noexcept { return word_; }
  constexpr bool readyToSwitchOn() const noexcept { return bit(0); }
  constexpr bool switchedOn() const noexcept { return bit(1); }
  constexpr bool operationEnabled() const noexcept { return bit(2); }
  constexpr bool fault() const noexcept { return bit(3); }
  constexpr bool voltageEnabled() const noexcept { return bit(4); }
  constexpr bool quickStopInactive() const noexcept { return bit(5); }
  constexpr bool switchOnDisabled() const noexcept { return bit(6); }
  constexpr bool warning() const noexcept { return bit(7); }
  constexpr bool setpointReached() const noexcept { return bit(8); }
  /// False: local control, the terminals may turn the motor whatever the bus says.
  constexpr bool busControl() const noexcept { return bit(9); }
  /// P481 [-09]; multi-function relay 1 on SK 300E/7x0E (BU 0020 7.3.4).
  constexpr bool bit10() const noexcept { return bit(10); }
  constexpr bool directionRight() const noexcept { return bit(11); }
  constexpr bool directionLeft() const noexcept { return bit(12); }
  /// P481 [-10]; multi-function relay 4 on SK 7x5E (BU 0020 7.3.4).
  constexpr bool bit13() const noexcept { return bit(13); }
  /// The set in force, 1..4.
  constexpr std::uint8_t parameterSet() const noexcept { return profile::parameterSet(word_); }

  /// False for an all-zero word: a bus module with its own 24 V supply exchanges data while the inverter behind it is
  /// off, and has nothing to report then (BU 0020 2.1.3).
  constexpr bool isUseful() const noexcept { return word_ != 0; }

  /// Decoded with the masks of the table in BU 2700 6.4.3. Bits 7..15 never matter. kUnknown: no row fits.
  DriveState state() const noexcept;

 private:
  constexpr bool bit(unsigned n) const noexcept { return (word_ >> n & 1u) != 0; }

  Word word_ = 0;
};

}  // namespace nord_driver::profile
