// Whether a gateway has an inverter, as its emergencies and the status words it sends for that inverter tell.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// EMCY 5000h says that the module has lost an inverter (E10.8, BU 0060 p. 93), whatever it goes on sending for it; the
/// next emergency of that inverter takes it back. That one may be lost, and a module that was without power has
/// forgotten what it said. So two other things take it back: a boot-up of the module, and good status words for longer
/// than an emergency can be late. Words of an inverter that runs, and never change although it is stopped, are old ones
/// and no evidence.
class ModuleLink {
 public:
  /// An emergency waits for its inhibit time and its turn on the bus, in no case for so long.
  static constexpr Duration kEmergencyIsLate = std::chrono::seconds{1};

  /// An emergency of this inverter.
  void handleEmergency(std::uint16_t code, Instant at) noexcept;
  /// Each cycle while it is missing: the last boot-up of the module.
  void handleBootUp(std::optional<Instant> at) noexcept;
  /// Each cycle while it is missing: the status word of the inverter, 0 when there is none or it is too old; `values`:
  /// all it came with, `at`: when. Older ones than the emergency are no evidence.
  void handleWords(Word status, ByteView values, Instant at, Instant now) noexcept;
  /// The bus is begun anew.
  void forget() noexcept { *this = ModuleLink{}; }

  /// The module has said that it has lost the inverter, and nothing took that back.
  bool missing() const noexcept { return told_at_.has_value(); }

 private:
  std::optional<Instant> told_at_;
  std::optional<Instant> good_since_;
  FixedBytes<8> values_;  // the inverter's when it was lost
  bool known_ = false;    // values_ are there
  bool changed_ = false;  // others came since
};

}  // namespace nord_driver
