// A second computer on a simulated CAN bus that belongs to a first one.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "link/can/can_link.h"
#include "sim/can/timed_can_bus.h"

namespace nord_driver::test {

/// It hears whatever goes over the bus (and takes the bus's tap for that) but what it sent itself, as do all frames
/// that are injected. Time passes for both computers when either waits.
class BesideCanLink final : public link::CanLink {
 public:
  explicit BesideCanLink(sim::TimedCanBus& bus) : bus_(bus) {}
  ~BesideCanLink() override { bus_.setTap(nullptr); }

  /// Its receiver is broken.
  void setDeaf(bool deaf) noexcept { deaf_ = deaf; }
  /// The interface is down: nothing is received or sent, and it says so.
  void setUp(bool up) noexcept { up_ = up; }
  /// Unplugged: the link closes, and opens again once it is back.
  void setPresent(bool present) noexcept {
    present_ = present;
    open_ = open_ && present;
  }
  std::size_t sent() const noexcept { return sent_; }
  /// Told of each frame it sends, before that goes over the bus.
  void setSees(std::function<void(const CanFrame&)> sees) { sees_ = std::move(sees); }

  bool open() noexcept override {
    if (!present_) return false;
    open_ = true;
    received_.clear();
    bus_.setTap([this](const CanFrame& frame, sim::TimedCanBus::Sender sender, Instant at) {
      if (open_ && up_ && !deaf_ && sender != sim::TimedCanBus::Sender::kForeign) received_.push_back({frame, at});
    });
    return true;
  }
  void close() noexcept override { open_ = false; }
  bool isOpen() const noexcept override { return open_; }
  link::CanSend send(const CanFrame& frame) noexcept override {
    if (!up_) return link::CanSend::kFailed;
    ++sent_;
    if (sees_) sees_(frame);
    bus_.inject(frame);
    return link::CanSend::kSent;
  }
  bool receive(link::ReceivedCanFrame& received) noexcept override {
    if (received_.empty()) return false;
    received = received_.front();
    received_.pop_front();
    return true;
  }
  bool waitReadable(Instant until) noexcept override {
    while (received_.empty() && bus_.now() < until) {
      bus_.run(std::min<Duration>(until - bus_.now(), std::chrono::microseconds{200}));
    }
    return !received_.empty();
  }
  void sleepUntil(Instant when) noexcept override { bus_.sleepUntil(when); }
  Instant now() const noexcept override { return bus_.now(); }
  link::CanState state() const noexcept override { return up_ ? link::CanState::kActive : link::CanState::kDown; }
  link::CanCounters counters() const noexcept override { return {}; }
  const std::string& lastError() const noexcept override { return no_error_; }
  const char* advice() const noexcept override { return ""; }

 private:
  sim::TimedCanBus& bus_;
  bool open_ = false;
  bool deaf_ = false;
  bool up_ = true;
  bool present_ = true;
  std::size_t sent_ = 0;
  std::function<void(const CanFrame&)> sees_;
  std::deque<link::ReceivedCanFrame> received_;
  std::string no_error_;
};

}  // namespace nord_driver::test
