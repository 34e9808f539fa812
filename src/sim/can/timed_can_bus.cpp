#include "sim/can/timed_can_bus.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr Duration kLongestWait = std::chrono::hours(24);  // a wait without end would never return
constexpr unsigned kFrameBits = 47;  // with the three bits of the pause after it, without stuff bits
constexpr unsigned kExtendedBits = 20;
constexpr unsigned kErrorFrameBits = 20;
constexpr unsigned kPassiveAfter = 16;  // unacknowledged frames until the error counter is above 127 (8 each)

bool isNode(TimedCanBus::Sender sender) noexcept {
  return sender == TimedCanBus::Sender::kNode;
}

}  // namespace

TimedCanBus::TimedCanBus(std::uint32_t bit_rate, const CanBusSettings& settings)
    : settings_(settings), bit_time_(std::chrono::nanoseconds{1'000'000'000} / bit_rate), now_(settings.start) {}

void TimedCanBus::start(CanParticipants& stations) noexcept {
  stations_ = &stations;
  stations_->advance(now_, *this);
}

bool TimedCanBus::open() noexcept {
  if (!present_) {
    last_error_ = "simulated CAN bus: no such interface";
    return false;
  }
  last_error_.clear();
  received_.clear();
  late_.clear();
  open_ = true;
  return true;
}

void TimedCanBus::close() noexcept {
  open_ = false;
  received_.clear();
  late_.clear();
}

void TimedCanBus::setInterfacePresent(bool present) noexcept {
  present_ = present;
  forgetOfMaster();
  if (present || !open_) return;
  close();
  last_error_ = "simulated CAN bus: the interface is gone";
}

void TimedCanBus::setInterfaceUp(bool up) noexcept {
  up_ = up;
  state_ = up ? link::CanState::kActive : link::CanState::kDown;
  unacknowledged_ = 0;
  last_error_ = up ? "" : "simulated CAN bus: the interface is down";
  forgetOfMaster();
}

void TimedCanBus::setBusOff() noexcept {
  state_ = link::CanState::kBusOff;
  ++counters_.bus_off;
  forgetOfMaster();
}

void TimedCanBus::restart() noexcept {
  if (state_ == link::CanState::kBusOff) ++counters_.restarts;
  state_ = up_ ? link::CanState::kActive : link::CanState::kDown;
  unacknowledged_ = 0;
}

const char* TimedCanBus::advice() const noexcept {
  switch (state_) {
    case link::CanState::kBusOff:
      return "the controller is bus-off: bit rate, termination and wiring?";
    case link::CanState::kDown:
      return "the interface is down";
    case link::CanState::kPassive:
      return "no other node acknowledges: are the drives powered and is the bus terminated?";
    default:
      return "";
  }
}

bool TimedCanBus::controllerOnBus() const noexcept {
  return present_ && up_ && state_ != link::CanState::kBusOff;
}

void TimedCanBus::setQueuePace(Duration pace) noexcept {
  queue_pace_ = pace;
  next_place_ = now_ + pace;
}

link::CanSend TimedCanBus::send(const CanFrame& frame) noexcept {
  if (!open_ || !controllerOnBus()) return link::CanSend::kFailed;
  if (queue_full_ || now_ < next_place_ || queuedOfMaster() >= settings_.send_queue || waiting_.full()) {
    ++counters_.queue_full;
    return link::CanSend::kQueueFull;
  }
  waiting_.push_back({frame, Sender::kMaster, now_});
  if (queue_pace_ > Duration::zero()) next_place_ = now_ + queue_pace_;
  return link::CanSend::kSent;
}

bool TimedCanBus::receive(link::ReceivedCanFrame& received) noexcept {
  if (received_.empty()) return false;
  received = received_[0];
  received_.eraseFront(1);
  return true;
}

bool TimedCanBus::waitReadable(Instant until) noexcept {
  until = std::min(until, now_ + kLongestWait);
  while (received_.empty() && now_ < until) {
    Instant next = std::min(until, now_ + kStep);
    if (busy_) next = std::min(next, current_end_);
    advanceTo(next);
  }
  return !received_.empty();
}

void TimedCanBus::advanceTo(Instant when) noexcept {
  for (;;) {
    handOverLate();
    if (busy_ && current_end_ <= when) {
      now_ = current_end_;
      stations_->advance(now_, *this);
      endFrame();
      continue;
    }
    if (!busy_ && startFrame()) continue;
    if (now_ >= when) return;
    Instant next = std::min(when, now_ + kStep);
    if (busy_) next = std::min(next, current_end_);
    now_ = next;
    stations_->advance(now_, *this);
  }
}

std::size_t TimedCanBus::queuedOfMaster() const noexcept {
  return static_cast<std::size_t>(std::count_if(
      waiting_.begin(), waiting_.end(), [](const Pending& pending) { return pending.sender == Sender::kMaster; }));
}

void TimedCanBus::forgetOfMaster() noexcept {
  FixedVector<Pending, 256> kept;
  for (const Pending& pending : waiting_) {
    if (pending.sender != Sender::kMaster) kept.push_back(pending);
  }
  waiting_ = kept;
  if (busy_ && current_.sender == Sender::kMaster) busy_ = false;
}

// The interface sends one frame after the other; of what is ready at the same time the lowest identifier wins.
bool TimedCanBus::startFrame() noexcept {
  std::size_t winner = waiting_.size();
  bool master_seen = false;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const bool master = waiting_[i].sender == Sender::kMaster;
    if (master && master_seen) continue;
    master_seen = master_seen || master;
    if (winner == waiting_.size() || waiting_[i].frame.id < waiting_[winner].frame.id) winner = i;
  }
  if (winner == waiting_.size()) return false;
  current_ = waiting_[winner];
  for (std::size_t i = winner; i + 1 < waiting_.size(); ++i) waiting_[i] = waiting_[i + 1];
  waiting_.resize(waiting_.size() - 1);
  current_end_ = now_ + frameTime(current_.frame);
  busy_ = true;
  return true;
}

Duration TimedCanBus::frameTime(const CanFrame& frame) const noexcept {
  const unsigned data = frame.remote ? 0 : frame.size;
  return bit_time_ * (kFrameBits + 8 * data + (frame.extended ? kExtendedBits : 0));
}

bool TimedCanBus::acknowledged() const noexcept {
  if (current_.sender != Sender::kMaster) return controllerOnBus() || stations_->nodeCount() > 1 || foreign_;
  return stations_->anyAlive() || foreign_;
}

void TimedCanBus::endFrame() noexcept {
  busy_ = false;
  const bool from_master = current_.sender == Sender::kMaster;
  if (!acknowledged()) {
    // Sent again and again until somebody acknowledges; a node that is alone drops it here, so that time can pass.
    if (!from_master) return;
    ++counters_.no_acknowledge;
    if (++unacknowledged_ >= kPassiveAfter) state_ = link::CanState::kPassive;
    busy_ = true;
    current_end_ = now_ + frameTime(current_.frame) + bit_time_ * kErrorFrameBits;
    return;
  }
  if (unacknowledged_ > 0) {
    unacknowledged_ = 0;
    state_ = link::CanState::kActive;
  }
  const bool disturbed = from_master ? disturbance_.requests : disturbance_.answers;
  if (disturbed && happens(disturbance_.error)) {
    ++counters_.bus_errors;
    busy_ = true;
    current_end_ = now_ + frameTime(current_.frame) + bit_time_ * kErrorFrameBits;
    return;
  }
  unsigned times = disturbed && happens(disturbance_.duplicate) ? 2 : 1;
  if (disturbed && happens(disturbance_.lose)) times = 0;
  if (tap_) tap_(current_.frame, current_.sender, now_);
  const CanFrame frame = current_.frame;
  if (from_master) {
    deliverFromMaster(frame, times);
  } else {
    deliverToMaster(frame, times);
  }
}

void TimedCanBus::deliverFromMaster(const CanFrame& frame, unsigned times) noexcept {
  if (lose_requests_ > 0 && stations_->isAnswered(frame)) {
    --lose_requests_;
    times = 0;
  }
  stations_->givenAt(current_.given);
  if (times == 0) stations_->judgeOnly(frame);
  for (unsigned i = 0; i < times; ++i) stations_->receive(frame, i == 0 ? Judge::kYes : Judge::kNo, *this);
}

void TimedCanBus::deliverToMaster(const CanFrame& frame, unsigned times) noexcept {
  if (lose_answers_ > 0 && isNode(current_.sender)) {
    --lose_answers_;
    times = 0;
  }
  for (unsigned i = 0; i < times; ++i) {
    const bool reached = controllerOnBus() && open_ && (holdBack(frame) || toQueue(frame));
    if (isNode(current_.sender)) {
      stations_->delivered(frame, reached, *this);
    } else {
      stations_->receive(frame, Judge::kNo, *this);
    }
  }
}

bool TimedCanBus::holdBack(const CanFrame& frame) noexcept {
  return disturbance_.answers && happens(disturbance_.late) && late_.push_back({frame, now_ + disturbance_.late_by});
}

void TimedCanBus::handOverLate() noexcept {
  while (!late_.empty() && late_[0].at <= now_) {
    toQueue(late_[0].frame);
    late_.eraseFront(1);
  }
}

bool TimedCanBus::toQueue(const CanFrame& frame) noexcept {
  if (overflow_ == 0 && received_.size() < settings_.receive_queue && received_.push_back({frame, now_})) return true;
  if (overflow_ > 0) --overflow_;
  ++counters_.dropped;
  return false;
}

void TimedCanBus::transmit(const CanFrame& frame) noexcept {
  waiting_.push_back({frame, Sender::kNode});  // a bus that cannot take it for so long is dead anyway
}

void TimedCanBus::inject(const CanFrame& frame) noexcept {
  foreign_ = true;
  waiting_.push_back({frame, Sender::kForeign});
}

void TimedCanBus::setDisturbance(const CanDisturbance& disturbance) noexcept {
  disturbance_ = disturbance;
  random_.seed(disturbance.seed);
}

bool TimedCanBus::happens(double probability) noexcept {
  return probability > 0.0 && static_cast<double>(random_()) < probability * 4294967296.0;
}

}  // namespace nord_driver::sim
