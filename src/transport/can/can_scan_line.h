// A CAN interface for the time of a scan: opened, listened to, talked on, closed.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "core/can_frame.h"
#include "link/can/can_link.h"
#include "transport/can/can_listen_first.h"

namespace nord_driver {

class CanScanLine {
 public:
  using Handle = std::function<void(const CanFrame&, Instant)>;

  /// References live longer than this.
  CanScanLine(link::CanLink& link, const std::atomic<bool>& end_asked) : link_(link), end_asked_(end_asked) {}
  ~CanScanLine() { link_.close(); }
  CanScanLine(const CanScanLine&) = delete;
  CanScanLine& operator=(const CanScanLine&) = delete;

  /// Opens it and listens for half a second; `heard` is told every frame. Why nothing may be sent, a sentence; empty:
  /// it may.
  std::string open(const ListenRules& rules, const Handle& heard);

  /// Sends what `poll_transmit` gives and tells `handle` what comes, until `until`, `done()`, the end is asked for or
  /// the interface is gone. `next` is told a moment up to which all that has come was handled, for time-outs, and may name
  /// an earlier one to look at `done()` again.
  template <typename PollTransmit, typename Next, typename Done>
  void talk(Instant until, PollTransmit poll_transmit, Next next, const Handle& handle, Done done) {
    while (!end_asked_ && link_.isOpen() && !done() && link_.now() < until) {
      CanFrame frame;
      while (!end_asked_ && !done() && link_.now() < until && poll_transmit(frame)) {
        send(frame);  // it may wait for room
        take(handle);
      }
      const Instant seen = link_.now();
      take(handle);
      const Instant wait = std::min({until, next(seen), link_.now() + kSlice});
      link_.waitReadable(wait);
      take(handle);
    }
  }

  Instant now() const noexcept { return link_.now(); }
  bool endAsked() const noexcept { return end_asked_; }
  /// The interface was down, bus-off or gone at some time of a talk, or did not take a frame: somebody may not have been
  /// asked, or not heard.
  bool failed() const noexcept { return frame_lost_ || !failure_.empty(); }
  /// What the interface has to say of itself: how it failed, or nobody acknowledges. Empty: nothing.
  std::string trouble() const;

 private:
  static constexpr Duration kSlice = std::chrono::milliseconds{20};

  void send(const CanFrame& frame) noexcept;
  void receive(const Handle& handle);
  /// Of a talk: receives, and notes an interface that does not work. It may work again by the end.
  void take(const Handle& handle);
  std::string whyNotWorking() const;

  link::CanLink& link_;
  const std::atomic<bool>& end_asked_;
  std::string failure_;  // why it did not work, when it did so first
  bool frame_lost_ = false;
};

}  // namespace nord_driver
