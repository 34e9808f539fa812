#include "transport/can/can_scan_line.h"

namespace nord_driver {

namespace {

constexpr Duration kListen = std::chrono::milliseconds{500};  // a master is heard within that
constexpr Duration kRoom = std::chrono::milliseconds{50};     // for the interface's queue to get some
constexpr Duration kPause = std::chrono::milliseconds{1};
constexpr int kTries = 20;

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
  if (!link_.isOpen()) return link_.lastError();
  if (!link_.works()) {
    const std::string advice = link_.advice();
    return advice.empty() ? "the CAN interface is down or bus-off" : advice;
  }
  return listen.mayTalk(link_.now()) ? "" : listen.text().str();
}

std::string CanScanLine::trouble() const {
  return link_.isOpen() ? link_.advice() : link_.lastError();
}

// A burst is longer than the queue of an interface. What is not taken by then is lost, and asked again by the engine.
void CanScanLine::send(const CanFrame& frame) noexcept {
  for (int i = 0; i < kTries && link_.isOpen(); ++i) {
    if (link_.send(frame) != link::CanSend::kQueueFull) return;
    link_.waitWritable(link_.now() + kRoom);
    if (i > 0) link_.sleepUntil(link_.now() + kPause);  // not every interface tells when it has room
  }
}

void CanScanLine::receive(const Handle& handle) {
  link::ReceivedCanFrame received;
  while (link_.receive(received)) handle(received.frame, received.at);
}

}  // namespace nord_driver
