#include "sim/can/can_thread.h"

#include <stdexcept>

#include "link/can/make_can_link.h"
#include "sim/model_clock.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr Duration kOpenAgain = std::chrono::milliseconds(100);
/// After a standstill as long a master may take its nodes for lost, though they are as operational as before.
constexpr Duration kLostAfter = std::chrono::milliseconds(100);
constexpr int kMostInOneGo = 64;  // frames taken before the models run on

}  // namespace

CanThread::CanThread(const std::string& interface, std::unique_ptr<link::CanLink> link)
    : interface_(interface), link_(std::move(link)) {}

std::unique_ptr<link::CanLink> CanThread::linkTo(const std::string& interface) {
  link::CanSettings settings;
  settings.interface = interface;
  return link::makeCanLink(settings, link::CanRole::kOwner);
}

void CanThread::start(CanParticipants& stations) {
  stations_ = &stations;
  if (!link_->open()) throw std::runtime_error("bus/interface: " + link_->lastError());
  stations_->advance(link_->now(), *this);
  thread_ = std::thread([this] { serve(); });
}

void CanThread::stop() noexcept {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void CanThread::serve() noexcept {
  becomeRealTime();
  ModelClock clock{link_->now()};
  while (!stop_) {
    const Instant before = link_->now();
    if (linkReady(before)) {
      static_cast<void>(link_->waitReadable(before + kStep));
    } else {
      link_->sleepUntil(before + kStep);
    }
    const std::lock_guard<InheritingMutex> lock(mutex_);
    stations_->advance(modelTime(clock, link_->now()), *this);
    if (clock.stoodStill() > kLostAfter) stations_->stoodStill();
    takeInput();
    sendWaiting();
  }
}

bool CanThread::linkReady(Instant now) noexcept {
  if (link_->isOpen()) return true;
  if (now < next_open_) return false;
  next_open_ = now + kOpenAgain;
  return link_->open();
}

void CanThread::takeInput() noexcept {
  link::ReceivedCanFrame received;
  for (int i = 0; i < kMostInOneGo && link_->isOpen() && link_->receive(received); ++i) {
    stations_->receive(received.frame, Judge::kYes, *this);
  }
}

// At once, and heard by the other nodes too: a socket does not give its own frames back.
void CanThread::transmit(const CanFrame& frame) noexcept {
  static_cast<void>(waiting_.push_back(frame));
}

void CanThread::sendWaiting() noexcept {
  std::size_t sent = 0;
  while (sent < waiting_.size()) {
    const CanFrame frame = waiting_[sent];
    const link::CanSend result = link_->isOpen() ? link_->send(frame) : link::CanSend::kFailed;
    if (result == link::CanSend::kFailed) {
      waiting_.clear();  // nobody hears them
      return;
    }
    if (result == link::CanSend::kQueueFull) break;  // again in a moment
    stations_->delivered(frame, true, *this);
    ++sent;
  }
  waiting_.eraseFront(sent);
}

}  // namespace nord_driver::sim
