// What every protocol engine on a CAN bus is for who feeds it: frames and the time go in, frames and the next deadline
// come out.
#pragma once

#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// Calling order: `restart()` whenever the bus was opened; then per bus cycle
///
///     engine.setOutput...(...);                        // the newest values
///     engine.startCycle(now);
///     send();
///     until the cycle is over:
///       wait for frames until min(end of the cycle, engine.nextDeadline());
///       engine.handleFrame(frame, now);                // each one, with the time it was received
///       engine.poll(now);                              // after the frames: a late look is no time-out
///       send();
///     while (auto event = engine.pollEvent()) ...
///
///     send():  while (engine.pollTransmit(frame)) {
///                if (link.send(frame) != kSent) { engine.notSent(); break; }
///              }
///
/// What the link did not take is not lost, and not stale: everything but process data is given out again by the next
/// `pollTransmit()`; process data of this cycle are dropped, the next cycle sends the values of its own.
class CanEngine {
 public:
  virtual ~CanEngine() = default;

  /// The bus was (re)opened: everything from the beginning. Process data to be sent are forgotten.
  virtual void restart(Instant now) noexcept = 0;
  /// For the clean exit: who was commanded is let go so that it does not miss us, and left alone until `restart()`.
  /// Process data end at once; until `released()` everything else goes on as usual.
  virtual void releaseAll(Instant now) noexcept = 0;
  virtual bool released() const noexcept = 0;

  virtual void startCycle(Instant now) noexcept = 0;
  virtual void handleFrame(const CanFrame& frame, Instant now) noexcept = 0;
  /// What is due by time: to be called when `now` has reached `nextDeadline()`; harmless before.
  virtual void poll(Instant now) noexcept = 0;
  /// The next frame to send, or false. Each is given out once, unless `notSent()` says otherwise.
  virtual bool pollTransmit(CanFrame& frame) noexcept = 0;
  /// The link did not take the last frame of `pollTransmit()`. To be called before anything else.
  virtual void notSent() noexcept = 0;
  /// When `poll()` has something to do; nothing when only frames can change anything.
  virtual std::optional<Instant> nextDeadline() const noexcept = 0;
};

}  // namespace nord_driver
