// The client of one explicit connection: one request at a time, fragmented with acknowledge both ways when it is longer
// than a frame, repeated once, then given up.
//
// Deterministic: frames and the time go in, frames and answers come out. Nothing is allocated.
// A transaction id is one bit, and an answer names nothing else of its request but, unless it is an error, the service. So
// the bit of a request is not given to another while an answer to the first may still come: one that was given up, or was
// asked twice and answered once, over a connection that still is, or on the unconnected port: a refused allocation, too, may
// come late and is taken for any refusal. Where both bits are owed an answer a user's next request waits. What connects a
// device and keeps its connection alive does not, and is told that what it gets may be such a late answer: what connects is
// done again where it was, and no loss is believed of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "core/timer_table.h"
#include "devicenet/explicit_message.h"
#include "devicenet/explicit_receiver.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

enum class ExplicitPort : std::uint8_t {
  kConnected,   ///< group 2 message 4, the explicit connection
  kUnconnected  ///< group 2 message 6: allocate and release; always 8/8
};

/// How a frame on the device's explicit response identifier was taken.
enum class Heard : std::uint8_t {
  kTaken,
  kStale,      ///< nobody waits for it: late, repeated
  kForeign,    ///< to another master: the MAC id in its header is not ours
  kMalformed,  ///< too short, or not a response
};

class ExplicitClient {
 public:
  ExplicitClient(std::uint8_t own_mac, std::uint8_t device_mac) noexcept : own_(own_mac), device_(device_mac) {}

  /// False when busy, or when the request does not fit the format. Otherwise exactly one answer follows, unless
  /// cancelled. `timeout`: for the answer, each time it is asked for.
  bool start(const ExplicitRequest& request, ExplicitPort port, BodyFormat format, Duration timeout,
             Instant now) noexcept;
  /// Whether a request would have to share its transaction id with one whose late answer may still come: one whose value
  /// is told to somebody has to wait, at most until `freeAt()`.
  bool mustWait(Instant now) const noexcept;
  Instant freeAt() const noexcept { return std::min(owedUntil(false), owedUntil(true)); }
  /// The device has a new explicit connection with us: what it was asked over another one it does not answer any more.
  void forgetOwed() noexcept { owedOn(ExplicitPort::kConnected) = {}; }
  /// From `start()` until the answer was taken.
  bool busy() const noexcept { return phase_ != Phase::kIdle || answer_.has_value(); }
  /// Ends the request without an answer; an answer not taken is dropped.
  void cancel() noexcept;
  /// The same, and fragments that come again are not acknowledged any more.
  void silence() noexcept;

  /// A frame on the device's explicit response identifier.
  Heard handle(const CanFrame& frame, Instant now) noexcept;
  void poll(Instant now) noexcept;
  bool pollTransmit(CanFrame& frame, Instant now) noexcept;
  /// The frame given out last was not sent: it comes again, and the time for its answer has not begun.
  void notSent(const CanFrame& frame) noexcept;
  std::optional<ExplicitAnswer> takeAnswer() noexcept;
  std::optional<Instant> nextDeadline() const noexcept { return timers_.nextTimeout(); }
  /// Times a frame was given out again because nobody answered, since construction.
  std::uint64_t repeated() const noexcept { return repeated_; }

 private:
  enum class Phase : std::uint8_t {
    kIdle,
    kToSend,  ///< the request or its next fragment is to be given out
    kAwaitAcknowledge,
    kAwaitAnswer,
    kReceiving  ///< of a fragmented answer
  };
  enum class Timer : std::uint8_t { kReply, kCount };

  /// Answers that may still come under one transaction id.
  struct Owed {
    std::uint8_t answers = 0;
    Instant until{};
  };
  using OwedByXid = std::array<Owed, 2>;
  OwedByXid& owedOn(ExplicitPort port) noexcept { return owed_[static_cast<std::size_t>(port)]; }
  Instant owedUntil(bool xid) const noexcept;
  bool owes(bool xid, Instant now) const noexcept { return now < owedUntil(xid); }
  /// The request ends; `answered`: by one of the answers it was asked for.
  void remember(bool answered, Instant now) noexcept;
  /// Nobody waits for it; `code`: its service.
  Heard late(std::uint8_t code, bool xid) noexcept;

  bool fragmented() const noexcept;
  bool lastFragmentSent() const noexcept;
  bool awaitsAnswer(bool xid) const noexcept;
  std::uint8_t header(bool fragment, bool xid) const noexcept;
  std::uint32_t requestId() const noexcept;
  CanFrame nextPiece() const noexcept;
  Fragment fragment() const noexcept;
  Heard handleAcknowledge(bool xid, Fragment fragment, ByteView data, Instant now) noexcept;
  Heard handleFragment(bool xid, Fragment fragment, ByteView data, Instant now) noexcept;
  void comeFurther(Instant now) noexcept;
  Heard handleBody(ByteView body, bool xid) noexcept;
  void acknowledge(bool xid, Fragment fragment, std::uint8_t status) noexcept;
  void finish(ExplicitEnd end) noexcept;

  std::uint8_t own_, device_;
  Phase phase_ = Phase::kIdle;
  TimerTable<Timer> timers_;
  bool gave_acknowledge_ = false;  // last
  Instant to_send_until_{};        // the piece given out last
  ExplicitPort port_ = ExplicitPort::kConnected;
  bool xid_ = false;
  bool shares_xid_ = false;  // with a request whose late answer may still come
  std::uint32_t id_ = 0;
  ExplicitBody body_;         // of the request
  std::size_t offset_ = 0;    // of the fragment that is sent
  std::uint8_t count_ = 0;    // of that fragment
  std::uint8_t repeats_ = 0;  // of the frame that is unanswered
  std::uint64_t repeated_ = 0;
  Duration timeout_{};
  std::uint8_t asked_ = 0;         // times the request went out as a whole
  std::array<OwedByXid, 2> owed_;  // by port
  Instant now_{};
  ExplicitReceiver receiver_;
  std::size_t furthest_ = 0;  // bytes of a fragmented answer that were together, at most at once
  std::optional<CanFrame> acknowledge_;
  std::optional<ExplicitAnswer> answer_;
};

}  // namespace nord_driver::devicenet
