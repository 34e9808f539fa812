// Who is there? Asks every address for its FDL status, those that were silent again, and every slave found for its
// diagnosis. For a segment on which no DpMaster runs at the same time. Sans-IO like DpMaster.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/diagnosis.h"
#include "profibus/dp_services.h"
#include "profibus/listen_first.h"
#include "profibus/requester.h"

namespace nord_driver::profibus {

struct ScannedStation {
  enum class Kind : std::uint8_t {
    kSilent,
    kSelf,    ///< our own address: not asked
    kSlave,   ///< `ident` and `owner`, when it told its diagnosis
    kMaster,  ///< answers with the station type of a master
    kGarbled  ///< something answered, but not with a telegram that fits: two stations with one address, perhaps
  };
  Kind kind = Kind::kSilent;
  std::optional<std::uint16_t> ident;
  std::uint8_t owner = kNoOwner;
};

/// A sentence for a technician, subject left out. Address 126 is named as not addressed yet (BU 0220 4.2.2).
Sentence describe(std::uint8_t address, const ScannedStation& station) noexcept;

/// Calling order as DpMaster's, with `start()` in the place of `startCycle()` and `done()` in that of `cycleDone()`. A
/// silent address costs one slot. A module that looks for the baud rate is silent until it has heard some telegrams (BU 2700,
/// P181; BU 0220, Auto_Baud_supp): who was silent is asked again, at least once, until kSearch has
/// passed and a whole round found nobody new. Nothing is parameterised, and a slave of another master may be asked.
class BusScan {
 public:
  static constexpr std::uint8_t kAddresses = 127;  ///< 0..126
  static constexpr Duration kSearch = std::chrono::seconds{2};

  /// Throws std::invalid_argument with a sentence when a value is out of range.
  explicit BusScan(const BusParameters& bus);

  /// Listens first when `BusParameters::listen_first` says so; another master ends the scan before its first telegram;
  /// and one that comes later, where `BusParameters::gives_way` does.
  void start(Instant now) noexcept;
  bool done() const noexcept { return step_ == Step::kDone; }
  /// The master that was heard: nothing was asked, or nothing more.
  std::optional<std::uint8_t> refusedBy() const noexcept { return refused_by_; }
  /// The line never fell silent: the scan ended at once.
  bool lineBusy() const noexcept { return line_busy_; }

  void handleBytes(ByteView bytes, Instant now) noexcept;
  void handleTimeout(Instant now) noexcept;
  ByteView pollTransmit(Instant now) noexcept;
  std::optional<Instant> nextDeadline() const noexcept;

  /// 0..126.
  const ScannedStation& station(std::uint8_t address) const noexcept { return stations_[address]; }
  const Counters& counters() const noexcept { return requester_.counters(); }

 private:
  enum class Step : std::uint8_t { kListen, kStatus, kDiagnosis, kDone };

  void begin(Instant now) noexcept;
  void askFrom(std::uint8_t address, Instant now) noexcept;
  void endRound(Instant now) noexcept;
  void askNext(Instant now) noexcept;
  void onAnswer(const FdlAnswer& answer, Instant now) noexcept;
  void onForeign(std::uint8_t master, bool certain, bool echo, Instant now) noexcept;

  BusParameters bus_;
  Requester requester_;
  DpServices services_;
  ListenFirst listen_;
  FdlRequest request_;
  SlaveCounters slave_counters_;
  Step step_ = Step::kDone;
  std::uint8_t address_ = 0;
  Instant began_{};
  bool first_round_ = false;
  bool found_ = false;  // somebody, in this round
  std::array<ScannedStation, kAddresses> stations_{};
  std::optional<std::uint8_t> refused_by_;
  bool line_busy_ = false;
};

}  // namespace nord_driver::profibus
