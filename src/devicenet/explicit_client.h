// The client of one explicit connection: one request at a time, fragmented with acknowledge both ways when it is longer
// than a frame, repeated once, then given up.
//
// Deterministic: frames and the time go in, frames and answers come out. Nothing is allocated.
// What the protocol cannot know: a transaction id is one bit. An answer that comes so late that the next but one request
// is under way is taken for the answer to that, if it is of the same service.
#pragma once

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
  Heard handleBody(ByteView body) noexcept;
  void acknowledge(bool xid, Fragment fragment, std::uint8_t status) noexcept;
  void finish(ExplicitEnd end) noexcept;

  std::uint8_t own_, device_;
  Phase phase_ = Phase::kIdle;
  TimerTable<Timer> timers_;
  bool gave_acknowledge_ = false;  // last
  Instant to_send_until_{};        // the piece given out last
  ExplicitPort port_ = ExplicitPort::kConnected;
  bool xid_ = false;
  std::uint32_t id_ = 0;
  ExplicitBody body_;         // of the request
  std::size_t offset_ = 0;    // of the fragment that is sent
  std::uint8_t count_ = 0;    // of that fragment
  std::uint8_t repeats_ = 0;  // of the frame that is unanswered
  std::uint64_t repeated_ = 0;
  Duration timeout_{};
  ExplicitReceiver receiver_;
  std::size_t furthest_ = 0;  // bytes of a fragmented answer that were together, at most at once
  std::optional<CanFrame> acknowledge_;
  std::optional<ExplicitAnswer> answer_;
};

}  // namespace nord_driver::devicenet
