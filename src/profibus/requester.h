// Sends one request at a time and brings its answer: pauses, slot time, retries. Sans-IO: bytes and the time go in,
// bytes and the next deadline come out.
#pragma once

#include <cstdint>
#include <optional>

#include "core/timer_table.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/counters.h"
#include "profibus/echo_watch.h"
#include "profibus/fdl_request.h"
#include "profibus/telegram_receiver.h"
#include "profibus/token_watch.h"

namespace nord_driver::profibus {

/// Calling order: `begin()`, then pollTransmit, handleBytes and handleTimeout until `busy()` is false.
class Requester {
 public:
  enum class Outcome : std::uint8_t {
    kNone,      ///< nothing has come to an end
    kNoAnswer,  ///< the last slot ended without an answer
    kLineBusy   ///< the line never fell silent enough to send
  };

  explicit Requester(const BusParameters& bus) noexcept : bus_(bus), tokens_(bus) {}

  /// The line was opened: what was under way is forgotten, and the first request waits for a quiet line.
  void restart(Instant now) noexcept;

  /// `request` (and `slave`, when given: the counters of the station asked) must live until the request has ended.
  void begin(const FdlRequest& request, SlaveCounters* slave, Instant now) noexcept;
  bool busy() const noexcept { return state_ != State::kIdle; }

  /// The bytes to send now with one write, or none (yet). A request nobody answers has ended with this.
  ByteView pollTransmit(Instant now) noexcept;
  std::optional<Instant> nextDeadline() const noexcept;
  Outcome handleTimeout(Instant now) noexcept;

  /// Calls `on_answer(const FdlAnswer&)` for the answer to the outstanding request, at most once per request, and
  /// `on_foreign(std::uint8_t master, bool certain, bool echo)` for every token and every request that somebody else sent;
  /// not certain: three bytes that look like a token, and may be noise; echo: it may be our own, handed back.
  template <typename OnAnswer, typename OnForeign>
  void handleBytes(ByteView bytes, Instant now, OnAnswer&& on_answer, OnForeign&& on_foreign) noexcept {
    if (bytes.empty()) return;
    noteActivity(now);
    discarded_ = receiver_.counters().bytes_discarded;
    receiver_.receive(bytes, [&](const Telegram& telegram) {
      if (isForeign(telegram)) {
        const bool certain = isCertain(telegram, now);
        if (certain) ++counters_.foreign_telegrams;
        on_foreign(telegram.sa, certain, isEcho(telegram));
      }
      FdlAnswer answer;
      if (accept(telegram, answer)) on_answer(answer);
    });
    takeReceiverCounters();
  }

  /// What was wrong with the last telegram that came instead of an answer to the request.
  Mismatch lastMismatch() const noexcept { return mismatch_; }

  Counters& counters() noexcept { return counters_; }
  const Counters& counters() const noexcept { return counters_; }

 private:
  enum class State : std::uint8_t { kIdle, kToSend, kAwaitAnswer };
  enum class Timer : std::uint8_t {
    kLineIdle,     ///< the line has been idle for long enough at this moment
    kGiveUp,       ///< kToSend: if it is not idle by then, it never will be
    kSlot,         ///< kAwaitAnswer
    kLongestSlot,  ///< kAwaitAnswer: the slot is not prolonged beyond
    kCount
  };

  void noteActivity(Instant now) noexcept;
  bool isForeign(const Telegram& telegram) const noexcept;
  bool isCertain(const Telegram& telegram, Instant now) noexcept;
  bool isEcho(const Telegram& telegram) noexcept;
  bool accept(const Telegram& telegram, FdlAnswer& answer) noexcept;
  void queue(Instant now) noexcept;
  void takeReceiverCounters() noexcept;

  BusParameters bus_;
  TelegramReceiver receiver_;
  TokenWatch tokens_;
  EchoWatch echo_;
  bool may_be_late_ = false;     // the next answer: to an earlier sending
  std::uint64_t discarded_ = 0;  // before the bytes that came last
  Counters counters_;
  State state_ = State::kIdle;
  const FdlRequest* request_ = nullptr;
  SlaveCounters* slave_ = nullptr;
  std::uint32_t sendings_ = 0;
  Mismatch mismatch_ = Mismatch::kNone;
  TimerTable<Timer> timers_;
};

}  // namespace nord_driver::profibus
