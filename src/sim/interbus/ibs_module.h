// A simulated InterBus technology unit (SK TU1, TU2 or TU3-IBS) with its inverter: BU 0070.
#pragma once

#include <array>
#include <cstdint>

#include "sim/drive_unit.h"
#include "sim/interbus/ibs_config.h"

namespace nord_driver::sim {

/// What the master sees of a subscriber when it starts the ring (BU 0070 4).
struct IbsIdentity {
  unsigned words = 5;  ///< with the PCP word: 3 or 5
  std::uint8_t code = 0xF3;
};

constexpr bool operator==(IbsIdentity a, IbsIdentity b) noexcept {
  return a.words == b.words && a.code == b.code;
}

/// Control or status word and three values, as they lie on the ring; with three words of length the last two are not
/// used.
using IbsWords = std::array<Word, 4>;

/// It has 24 V of its own: the ring goes on, with zeros, when its inverter is off.
class IbsModule final : public BusModule {
 public:
  /// For this drive, which is to be connected to it and must outlive it.
  explicit IbsModule(DriveUnit& drive);

  Supply supply() const noexcept override { return Supply::kOwn; }
  void setPowered(bool on) noexcept override;
  bool powered() const noexcept override { return powered_; }
  bool inDataExchange() const noexcept override { return in_ring_; }
  ExchangeCounters countersOf(unsigned /*place*/) const noexcept override { return counters_; }

  /// Looks whether its inverter was switched on: then P507 and P551 are read, and the InterBus part begins anew
  /// (BU 0070 4.2).
  void look() noexcept;
  /// What it says when the ring is started: five words as long as its inverter is off.
  IbsIdentity identity() const noexcept;
  /// What the configuration makes of it.
  IbsIdentity expected() const noexcept;
  /// It has begun anew since the ring was started, or has no power: the ring stands.
  bool breaksRing() const noexcept { return !powered_ || restarted_; }
  void ringStarts() noexcept;
  /// Whoever commands it begins anew, and may look before it commands: the next words without bit 10 break no rule.
  void masterBegins() noexcept { valid_seen_ = false; }
  void ringStops() noexcept { in_ring_ = false; }
  /// What the relay of its inverter (MFR 1) shows: bit 10 of NORD's status word (BU 0070 7.2).
  void setRelay(bool closed) noexcept { relay_ = closed; }
  /// One ring cycle: takes the words to the inverter, and returns those from it.
  IbsWords exchange(const IbsWords& words) noexcept;

 private:
  void take(const IbsWords& words) noexcept;
  IbsWords answer() const noexcept;
  bool swapsWords() const noexcept { return drive_.config().device.isOlderSeries(); }

  DriveUnit& drive_;
  IbsIdentity settings_;  // as read when the mains came
  bool powered_ = true;
  bool inverter_on_ = false;
  bool restarted_ = false;
  bool in_ring_ = false;
  bool valid_seen_ = false;
  bool relay_ = false;
  std::int16_t rpm_setpoint_ = 0;
  ExchangeCounters counters_;
};

}  // namespace nord_driver::sim
