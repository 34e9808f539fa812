// Parameters through records of DP-V1: what a PKW carries in the cycle, carried beside it.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "profibus/record.h"
#include "profile/pkw_channel.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {

/// The parameters of one unit behind a module SK CU4/TU4-PBR: of the module itself (P150 to P199 are only reachable
/// here, BU 0220 8.3.4.4) or of one inverter. An order is written as a record of eight bytes laid out as a PKW; the
/// answer is read as another, until it is the one to the order. Until the unit has executed an order it repeats its answer
/// to the one before (BU 2700 6.5.1.1): where that could be taken for the new one's, "no order" is written and "no answer"
/// read first. No manual says how a unit tells in a record that it has no answer: whatever shows none will do.
/// Sans-IO: `pollRecord()` when the station is free for a record, `handleRecord()` with its result.
class RecordParameterChannel {
 public:
  static constexpr std::uint8_t kModule = 0;

  /// `unit`: kModule, or the number of an inverter, 1..4.
  RecordParameterChannel(std::uint8_t unit, RecordAddressing addressing, Duration answer_timeout);

  /// As PkwChannel::submit().
  bool submit(const profile::ParameterRequest& request, Instant now) noexcept { return pkw_.submit(request, now); }
  std::optional<profile::ParameterResult> pollResult() noexcept { return pkw_.pollResult(); }
  std::uint64_t stale() const noexcept { return pkw_.stale(); }

  /// The next record, when there is an order and none is under way.
  std::optional<profibus::RecordRequest> pollRecord(Instant now) noexcept;
  /// `words`: what the channel has to say of a failure of its own; empty: the words of MS1.
  void handleRecord(const profibus::RecordResult& result, Instant now, const Sentence& words = {}) noexcept;
  /// The station, or the inverter, is gone: all requests end as offline. A record under way still brings its result.
  void handleOffline(Instant now, const Sentence& why = {}) noexcept;
  /// An order was written and has no answer yet: nobody else should use the station's records.
  bool holdsStation() const noexcept { return under_way_ || step_ == Step::kAwaitNone || step_ == Step::kRead; }

 private:
  /// What the next record is for, or the one under way.
  enum class Step : std::uint8_t {
    kPause,      ///< no order
    kTakeBack,   ///< writes "no order"
    kAwaitNone,  ///< reads until the unit has no answer any more
    kWrite,      ///< writes the order
    kRead        ///< reads its answer
  };

  profibus::RecordRequest address() const noexcept;
  profibus::RecordRequest nextRecord() noexcept;
  bool mayBeMistaken() const noexcept;
  void handleDone(ByteView data, Instant now) noexcept;
  void handleNone(ByteView data) noexcept;
  void handleAnswer(ByteView data, Instant now) noexcept;
  bool handleRefusal(const profibus::RecordError& error, Instant now) noexcept;
  bool goOnToWrite(const Sentence& why) noexcept;
  profile::PkwWords inOurNumbers(profile::PkwWords words) const noexcept;
  void fail(profile::ParameterOutcome outcome, const Sentence& words) noexcept;
  bool mayBeCarriedOut() const noexcept;
  void forgetAnswers() noexcept;

  std::uint8_t unit_;
  RecordAddressing addressing_;
  profile::PkwChannel pkw_;
  Step step_ = Step::kPause;
  profile::PkwWords order_{};        // the one that runs; zeros: none
  profile::PkwWords last_answer_{};  // what the unit said last: it may say it again; zeros: nothing
  profile::PkwWords unanswered_{};   // the unit may have it, and its answer has not been seen; zeros: none
  Instant busy_end_{};               // taking back, it may be busy until then
  bool under_way_ = false;
  bool forgotten_ = false;  // the record under way belongs to nobody any more
};

}  // namespace nord_driver
