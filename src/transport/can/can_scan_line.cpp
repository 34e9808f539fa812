#include "transport/can/can_scan_line.h"

namespace nord_driver {

namespace {

constexpr Duration kListen = std::chrono::milliseconds{500};  // a master is heard within that
constexpr Duration kRoom = std::chrono::milliseconds{50};     // for the interface's queue to get some
constexpr Duration kPause = std::chrono::milliseconds{1};
constexpr Duration kPatience = std::chrono::seconds{1};  // with a queue that stays full

}  // namespace

std::string CanScanLine::open(const ListenRules& rules, const Handle& heard) {
  if (!link_.open()) return link_.lastError();
  CanListenFirst listen{rules, kListen};
  listen.restart(link_.now());
  const Instant end = link_.now() + kListen;
  while (link_.isOpen() && !end_asked_ && !listen.heard() && link_.now() < end) {
    link_.waitReadable(end);
    receive([&](const CanFrame& frame, Instant at) {
      listen.handle(frame);
      heard(frame, at);
    });
  }
  if (end_asked_) return "ended before anybody was asked";
  if (!link_.works()) return whyNotWorking();
  return listen.mayTalk(link_.now()) ? "" : listen.text().str();
}

std::string CanScanLine::trouble() const {
  if (!failure_.empty()) return failure_;
  const std::string advice = link_.advice();
  return advice.empty() && frame_lost_ ? "frames did not leave the interface" : advice;
}

std::string CanScanLine::whyNotWorking() const {
  if (!link_.isOpen()) return link_.lastError();
  const std::string advice = link_.advice();
  return advice.empty() ? "the CAN interface is down or bus-off" : advice;
}

// A burst is longer than the queue of an interface. What is not taken by then is lost; not every engine asks it again.
void CanScanLine::send(const CanFrame& frame) noexcept {
  const Instant end = link_.now() + kPatience;
  link::CanSend result = link_.send(frame);
  for (bool again = false; result == link::CanSend::kQueueFull && !end_asked_ && link_.now() < end; again = true) {
    link_.waitWritable(link_.now() + kRoom);
    if (again) link_.sleepUntil(link_.now() + kPause);  // not every interface tells when it has room
    result = link_.send(frame);
  }
  if (result != link::CanSend::kSent && !end_asked_) frame_lost_ = true;
}

void CanScanLine::receive(const Handle& handle) {
  link::ReceivedCanFrame received;
  while (link_.receive(received)) handle(received.frame, received.at);
}

void CanScanLine::take(const Handle& handle) {
  receive(handle);
  if (failure_.empty() && !link_.works()) failure_ = whyNotWorking();
}

}  // namespace nord_driver
