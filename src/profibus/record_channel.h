// The acyclic channel of one slave (DP-V1 class 1, MS1): one record at a time, from the request to its result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/timer_table.h"
#include "nord_driver/core/time.h"
#include "profibus/fdl_request.h"
#include "profibus/record.h"

namespace nord_driver::profibus {

/// A request goes to access point 51; while the slave has no response yet, it acknowledges without data and is polled
/// with empty requests. A read that is answered "busy" (DE 80 B5) is asked again. Everything here is beside data
/// exchange: whatever fails ends the record, never the exchange, since a drive that leaves it coasts. (The standard
/// would drop the connection on a time-out; this master leaves that to the watchdog.)
class RecordChannel {
 public:
  explicit RecordChannel(std::size_t slave, Duration response_timeout) noexcept
      : slave_(slave), response_timeout_(response_timeout) {}

  /// False when a request is under way, a result has not been fetched, or the request is out of range. Otherwise
  /// exactly one result follows. `unusable` ends it at once.
  bool submit(const RecordRequest& request, std::optional<RecordOutcome> unusable) noexcept;
  std::optional<RecordResult> pollResult() noexcept;
  bool hasResult() const noexcept { return state_ == State::kEnded; }

  /// Ends the request when its time is over; true when the channel has a telegram to send.
  bool wantsTelegram(Instant now) noexcept;
  /// What that telegram carries: the request, or nothing (a poll). Valid until the next call.
  ByteView pollTelegram(Instant now) noexcept;

  void handleAnswer(const FdlAnswer& answer, Instant now) noexcept;
  /// The telegram was not answered, retries included.
  void handleNoAnswer(Instant now) noexcept;
  /// The slave is not in data exchange any more, or not heard: what it was asked it may answer when it is gone on with.
  void handleOffline(Instant now) noexcept;
  /// It has taken Set_Prm, and forgotten what it was asked.
  void handleStartUp() noexcept;

 private:
  enum class State : std::uint8_t {
    kFree,
    kToSend,
    kPolling,
    kEnded  ///< the result waits to be fetched
  };

  enum class Timer : std::uint8_t {
    kResponse,  ///< set by the first sending
    kBusy,      ///< likewise: no repetition of a busy read beyond
    kDrain,     ///< the response to a request that timed out may still come: it is polled for
    kMaking,    ///< that to a request whose telegram nobody answered may still be made: it is not
    kCount
  };

  void handleResponse(ByteView pdu, Instant now) noexcept;
  void giveUp(Timer late, Instant now) noexcept;
  void handleNothing(Instant now) noexcept;
  void handleNoResource(Instant now) noexcept;
  void forget() noexcept;
  void end(RecordOutcome outcome) noexcept;

  std::size_t slave_;
  Duration response_timeout_;
  State state_ = State::kFree;
  RecordRequest request_;
  RecordPdu pdu_;
  RecordResult result_;
  TimerTable<Timer> timers_;
  bool sent_request_ = false;  // the telegram under way carried the request
  bool no_resource_ = false;   // the request was answered so: a response nobody has asked for may be in its way
  // A request was given up that the slave may have. Its response waits there until a telegram fetches it: so the next
  // request begins with polls, until there is nothing to fetch.
  bool given_up_ = false;
};

}  // namespace nord_driver::profibus
