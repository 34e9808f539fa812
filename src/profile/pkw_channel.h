// One inverter's parameter channel: takes requests, turns them into orders one at a time, finds the answers.
//
// Sans-IO. The inverter repeats its previous answer until it has executed an order (BU 2700 6.5.1.1), and an order left
// standing is executed again and again, which wears the EEPROM out (6.5). So between two orders the channel sends "no
// order" and waits for "no answer"; only an order that the standing answer cannot be mistaken for may start after one
// exchange.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "profile/parameter_queue.h"
#include "profile/pkw.h"

namespace nord_driver::profile {

/// Each exchange: pollWords() before it, handleWords() with the response, or handleOffline() when there is no inverter.
/// pollResult() at any time.
class PkwChannel {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = ParameterQueue::kCapacity;

  /// `answer_timeout`: how long an order, with the pause before it, may last from the moment it is the first in the
  /// queue.
  explicit PkwChannel(Duration answer_timeout) : answer_timeout_(answer_timeout) {}

  /// As ParameterQueue::submit().
  bool submit(const ParameterRequest& request, Instant now) noexcept;
  /// The words of this exchange's request.
  PkwWords pollWords(Instant now) noexcept;
  /// The words of its response.
  void handleWords(const PkwWords& words, Instant now) noexcept;
  /// Ends the running request: what carries the words has refused, or failed. Nothing happens when none runs.
  void handleRefusal(ParameterReason reason, const Sentence& text) noexcept;
  void handleFailure(ParameterOutcome outcome, const Sentence& text = {}) noexcept;
  /// Why what carries the words has brought no answer to the running request yet: told when its time is over.
  void explainWait(const Sentence& text) noexcept { wait_text_ = text; }
  /// Ends all pending requests as offline; `why`: nothing to say.
  void handleOffline(Instant now, const Sentence& why = {}) noexcept;
  std::optional<ParameterResult> pollResult() noexcept { return requests_.pollResult(); }
  /// Answers seen while an order ran that belong to no order of ours: another master's, or nonsense. The "no answer" of
  /// the pause and the answer to the order before only mean that the inverter has not executed this one yet.
  std::uint64_t stale() const noexcept { return stale_; }

 private:
  enum class Phase : std::uint8_t { kPause, kOrder };

  void startNext(Instant now) noexcept;
  void pause() noexcept;
  bool mayStart() const noexcept;
  void countStale(const PkwWords& words, const PkwAnswer& answer) noexcept;
  bool fallBack(std::uint16_t error_number) noexcept;
  void handleEnd() noexcept;

  Duration answer_timeout_;
  ParameterQueue requests_;
  PkwOrder order_;
  PkwOrder sent_;      // the last order that went out: order_, while it runs
  PkwOrder previous_;  // the one before it
  Phase phase_ = Phase::kPause;
  Instant deadline_{};
  Sentence wait_text_;
  bool prepared_ = false;        // order_ and deadline_ belong to the running request
  bool fell_back_ = false;       // the running request already uses its one fall-back
  bool pause_sent_ = false;      // at least one exchange asked "no order" since the last order
  bool last_unanswered_ = true;  // the order before had no answer, nor the pause: it may still come
  PkwWords last_words_{};
  PkwWords stale_words_{};
  std::uint64_t stale_ = 0;
};

}  // namespace nord_driver::profile
