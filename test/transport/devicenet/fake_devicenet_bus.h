// A CAN bus with the fake modules of test/devicenet on it, and a clock of its own.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devicenet/fake_device.h"
#include "link/can/can_link.h"
#include "support/can_text.h"

namespace nord_driver::test {

class FakeDevicenetBus final : public link::CanLink {
 public:
  bool open() noexcept override { return open_ = present; }
  void close() noexcept override { open_ = false; }
  bool isOpen() const noexcept override { return open_; }
  link::CanSend send(const CanFrame& frame) noexcept override {
    if (!present) {
      open_ = false;
      return link::CanSend::kFailed;
    }
    if (controller != link::CanState::kActive) return link::CanSend::kFailed;
    if (records) seen.push_back("> " + nord_driver::text(frame));
    for (const auto& device : devices) device->receive(frame, now_);
    return link::CanSend::kSent;
  }
  bool receive(link::ReceivedCanFrame& received) noexcept override {
    collect();
    if (frames_.empty()) return false;
    received = {frames_.front(), now_};
    frames_.pop_front();
    if (records) seen.push_back("< " + nord_driver::text(received.frame));
    return true;
  }
  bool waitReadable(Instant until) noexcept override {
    collect();
    while (frames_.empty() && now_ < until) advance(until);
    return !frames_.empty();
  }
  void sleepUntil(Instant when) noexcept override {
    while (now_ < when) advance(when);
  }
  Instant now() const noexcept override { return now_; }
  link::CanState state() const noexcept override { return controller; }
  link::CanCounters counters() const noexcept override { return {}; }
  const std::string& lastError() const noexcept override { return error_; }
  const char* advice() const noexcept override { return ""; }

  /// Somebody else sends.
  void say(const std::string& candump) { frames_.push_back(nord_driver::frame(candump)); }
  std::size_t sentTo(const std::string& id) const {
    std::size_t found = 0;
    for (const std::string& line : seen) found += line.rfind("> " + id + "#", 0) == 0 ? 1 : 0;
    return found;
  }

  std::vector<std::unique_ptr<devicenet::FakeDevice>> devices;
  std::vector<std::string> seen;  ///< "> 42D#..." sent, "< 3C5#..." received
  bool records = true;
  bool present = true;
  link::CanState controller = link::CanState::kActive;

 private:
  void advance(Instant until) {
    const Instant next = now_ + std::chrono::microseconds{200};
    now_ = next < until ? next : until;
    for (const auto& device : devices) device->tick(now_);
    collect();
  }
  void collect() {
    CanFrame frame;
    for (const auto& device : devices) {
      while (device->next(frame)) frames_.push_back(frame);
    }
  }

  std::deque<CanFrame> frames_;
  Instant now_{std::chrono::hours{1}};
  bool open_ = false;
  std::string error_;
};

}  // namespace nord_driver::test
