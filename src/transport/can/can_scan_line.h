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
      while (!end_asked_ && !done() && poll_transmit(frame)) {
        send(frame);  // it may wait for room
        receive(handle);
      }
      const Instant seen = link_.now();
      receive(handle);
      const Instant wait = std::min({until, next(seen), link_.now() + kSlice});
      link_.waitReadable(wait);
      receive(handle);
    }
  }

  Instant now() const noexcept { return link_.now(); }
  bool endAsked() const noexcept { return end_asked_; }
  /// False: the interface is gone, and the scan with it.
  bool isOpen() const noexcept { return link_.isOpen(); }
  /// What the interface has to say of itself: it is gone, or nobody acknowledges. Empty: nothing.
  std::string trouble() const;

 private:
  static constexpr Duration kSlice = std::chrono::milliseconds{20};

  void send(const CanFrame& frame) noexcept;
  void receive(const Handle& handle);

  link::CanLink& link_;
  const std::atomic<bool>& end_asked_;
};

}  // namespace nord_driver
