#include "devicenet/io_connection.h"

#include <algorithm>

namespace nord_driver::devicenet {
namespace {

/// Of the acknowledge handler (class 2Bh, attribute 1); 16 to 20 ms are usual.
constexpr Duration kAcknowledgeTime = std::chrono::milliseconds{20};

}  // namespace

IoConnection::IoConnection(const NodeConfig& config, Duration cycle, NodeReport& report) noexcept
    : config_(config),
      cycle_(cycle),
      report_(report),
      sender_(config.io.output_bytes),
      receiver_(config.io.input_bytes) {}

bool IoConnection::byChange() const noexcept {
  return config_.io.kind == IoKind::kChangeOfState || config_.io.kind == IoKind::kCyclic;
}

void IoConnection::establish(Duration rate, Instant now) noexcept {
  close();
  established_ = true;
  rate_ = rate;
  timeout_ = config_.io.timeout.value_or(kRatesUntilTimeout * rate);
  input_ = IoInput{};
  // Such a device sends without being asked.
  if (byChange()) timers_.set(Timer::kInput, now + timeout_);
}

void IoConnection::close() noexcept {
  established_ = false;
  overdue_ = false;
  ending_ = false;
  moves_ = moves_sending_ = false;
  stops_sent_ = kEnoughStops;
  timers_.stopAll();
  output_.clear();  // the bit of a strobe, too
  output_ready_ = false;
  sent_at_.reset();
  polled_ = false;
  sender_.drop();
  due_ = false;
  receiver_.reset();
  acknowledge_due_ = false;
}

void IoConnection::setOutput(ByteView bytes) noexcept {
  if (!established_) return;
  // A bit strobe alone: one bit is all there is.
  const std::size_t size =
      config_.io.kind == IoKind::kStrobe && config_.io.output_bytes == 0 ? 1 : config_.io.output_bytes;
  output_.clear();
  for (const std::uint8_t byte : bytes.sub(0, size)) output_.push_back(byte);
  output_.resize(size);
  output_ready_ = true;
}

bool IoConnection::outputDue(Instant now) const noexcept {
  if (!output_ready_ && config_.io.output_bytes > 0) return false;
  switch (config_.io.kind) {
    case IoKind::kNone:
      return false;
    case IoKind::kStrobe:
      return isPolledBesideStrobe(config_.io);
    case IoKind::kPoll:
      return true;
    case IoKind::kChangeOfState:
    case IoKind::kCyclic:
      break;
  }
  if (config_.io.output_bytes == 0) return false;
  if (!sent_at_ || due_) return true;
  if (config_.io.kind == IoKind::kChangeOfState && output_ != sent_) return true;
  // The next cycle would be too late. Nothing is sent between cycles: a value nobody renews must not stay alive.
  return now + cycle_ > *sent_at_ + rate_;
}

bool IoConnection::pollUnanswered() const noexcept {
  if (!polled_) return false;
  if (config_.io.kind == IoKind::kPoll) return timers_.isSet(Timer::kInput);
  return isPolledBesideStrobe(config_.io) && timers_.isSet(Timer::kHeard);
}

void IoConnection::startCycle(Instant now) noexcept {
  if (!established_) return;
  // We were kept from running: the device has given up, and what comes now would come to nobody.
  overdue_ = sent_at_ && now - *sent_at_ >= kRatesUntilTimeout * rate_;
  if (overdue_) return timers_.set(ending_ ? Timer::kEnding : Timer::kInput, now);
  if (pollUnanswered()) ++report_.status().counters.missed;
  polled_ = false;
  if (!outputDue(now)) return;
  repeated_ = false;
  send();
}

void IoConnection::send() noexcept {
  dropOutput();
  if (config_.io.kind == IoKind::kChangeOfState) sent_ = output_;
  moves_sending_ = moves_;
  sender_.start(ByteView{output_});
}

void IoConnection::remember() noexcept {
  before_ = {timers_, sent_at_, polled_, stops_sent_, report_.status().counters.missed};
}

// Nobody has got it: no answer to it is awaited, and none missed.
void IoConnection::takeBack() noexcept {
  timers_ = before_.timers;
  sent_at_ = before_.sent_at;
  polled_ = before_.polled;
  stops_sent_ = before_.stops_sent;
  report_.status().counters.missed = before_.missed;
}

void IoConnection::noteStrobed(Instant now) noexcept {
  remember();
  if (timers_.isSet(Timer::kInput)) {
    ++report_.status().counters.missed;
  } else {
    timers_.set(Timer::kInput, now + timeout_);
  }
}

bool IoConnection::pollOutput(CanFrame& frame, Instant now) noexcept {
  FramePayload payload;
  if (!established_ || !sender_.next(payload)) return false;
  frame = dataFrame(identifier(Group2::kMasterIo, config_.mac), payload);
  if (sender_.pending()) return true;
  remember();
  due_ = false;
  ++report_.status().counters.outputs;
  sent_at_ = now;
  polled_ = true;
  stops_sent_ = moves_sending_ ? 0 : std::min(stops_sent_ + 1, kEnoughStops);
  if (ending_ && !mustStop()) timers_.set(Timer::kEnding, now);
  if (isPolledBesideStrobe(config_.io)) {
    if (!timers_.isSet(Timer::kHeard)) timers_.set(Timer::kHeard, now + timeout_);
  } else if (!byChange()) {
    if (!timers_.isSet(Timer::kInput)) timers_.set(Timer::kInput, now + timeout_);
  } else if (config_.io.acknowledge) {
    if (timers_.isSet(Timer::kAcknowledge)) ++report_.status().counters.missed;
    timers_.set(Timer::kAcknowledge, now + kAcknowledgeTime);
    if (!timers_.isSet(Timer::kHeard)) timers_.set(Timer::kHeard, now + timeout_);
  }
  return true;
}

void IoConnection::outputNotSent() noexcept {
  if (!sender_.pending()) {
    --report_.status().counters.outputs;
    takeBack();
  }
  sender_.drop();
  due_ = true;
  countSuperseded();
}

void IoConnection::dropOutput() noexcept {
  if (!sender_.pending()) return;
  sender_.drop();
  due_ = true;
  countSuperseded();
}

void IoConnection::countSuperseded() noexcept {
  ++report_.status().counters.superseded;
  ++report_.busCounters().superseded;
}

bool IoConnection::pollAcknowledge(CanFrame& frame) noexcept {
  if (!acknowledge_due_) return false;
  acknowledge_due_ = false;
  frame = dataFrame(identifier(Group2::kMasterAcknowledge, config_.mac), ByteView{});
  return true;
}

bool IoConnection::takes(Group1 message) const noexcept {
  switch (config_.io.kind) {
    case IoKind::kNone:
      break;
    case IoKind::kPoll:
      return message == Group1::kPollResponse;
    case IoKind::kStrobe:
      return message == Group1::kStrobeResponse ||
             (message == Group1::kPollResponse && isPolledBesideStrobe(config_.io));
    case IoKind::kChangeOfState:
    case IoKind::kCyclic:
      return message == Group1::kChangeOfStateOrCyclic || (message == Group1::kPollResponse && config_.io.acknowledge);
  }
  return false;
}

void IoConnection::handle(std::uint8_t message, const CanFrame& frame, Instant now) noexcept {
  // What comes before is of a connection that is none of ours any more.
  if (!established_ || ending_) return;
  if (frame.remote) return report_.malformed(frame, "DeviceNet has no remote frames", now);
  const auto group1 = static_cast<Group1>(message);
  if (!takes(group1)) return report_.malformed(frame, "of a connection that is not allocated", now);
  if (byChange() && group1 == Group1::kPollResponse) return handleAcknowledge(frame, now);
  if (config_.io.kind == IoKind::kStrobe && group1 == Group1::kPollResponse) return handlePollAnswer(frame, now);
  handleData(frame, now);
}

void IoConnection::handleData(const CanFrame& frame, Instant now) noexcept {
  const IoReceiver::Result result = receiver_.handle(frame.bytes());
  if (result == IoReceiver::Result::kNeedMore) return;
  if (result == IoReceiver::Result::kBroken) {
    if (config_.io.input_bytes <= kUnfragmented) return report_.malformed(frame, "longer than its connection", now);
    ++report_.status().counters.broken_inputs;
    return;
  }
  const std::size_t size = receiver_.message().size();
  if (size != 0 && size != config_.io.input_bytes) {
    return report_.malformed(frame, "shorter than its connection", now);
  }
  takeInput(now);
}

void IoConnection::takeInput(Instant now) noexcept {
  report_.status().heard_at = now;
  if (byChange()) {
    timers_.set(Timer::kInput, now + timeout_);
    acknowledge_due_ = config_.io.acknowledge;
  } else {
    timers_.stop(Timer::kInput);
  }
  if (receiver_.message().empty()) {
    ++report_.status().counters.empty_inputs;
    return;
  }
  input_.bytes = receiver_.message();
  input_.at = now;
  ++input_.count;
  ++report_.status().counters.inputs;
}

void IoConnection::handleAcknowledge(const CanFrame& frame, Instant now) noexcept {
  if (frame.size != 0) return report_.malformed(frame, "an acknowledge has no data", now);
  report_.status().heard_at = now;
  timers_.stop(Timer::kAcknowledge);
  timers_.stop(Timer::kHeard);
}

// It says that the outputs have come. The same inputs come by the bit strobe, of all devices from one moment.
void IoConnection::handlePollAnswer(const CanFrame& frame, Instant now) noexcept {
  if (frame.size != 0 && frame.size != config_.io.input_bytes) {
    return report_.malformed(frame, "not as long as its connection", now);
  }
  report_.status().heard_at = now;
  timers_.stop(Timer::kHeard);
}

void IoConnection::beginEnding(Instant now) noexcept {
  ending_ = true;
  receiver_.reset();
  acknowledge_due_ = false;
  timers_.stopAll();
  timers_.set(Timer::kEnding, now + kLongestEnding);
}

bool IoConnection::poll(Instant now) noexcept {
  if (!established_) return true;
  if (ending_) {
    // It is lost already: nothing more is expected of it.
    timers_.stop(Timer::kInput);
    timers_.stop(Timer::kHeard);
    if (timers_.takeDue(Timer::kEnding, now)) return false;
  }
  if (timers_.takeDue(Timer::kInput, now)) {
    if (overdue_) {
      loss_.format("was sent nothing for more than %.0f ms, four times its expected packet rate",
                   toSeconds(kRatesUntilTimeout * rate_) * 1e3);
      return false;
    }
    loss_.format(byChange() ? "sent no data for %.0f ms" : "gave no answer to our commands for %.0f ms",
                 toSeconds(timeout_) * 1e3);
    return false;
  }
  if (timers_.takeDue(Timer::kHeard, now)) {
    loss_.format(byChange() ? "acknowledged no data for %.0f ms" : "gave no answer to our poll for %.0f ms",
                 toSeconds(timeout_) * 1e3);
    return false;
  }
  if (!timers_.takeDue(Timer::kAcknowledge, now)) return true;
  ++report_.status().counters.unacknowledged;
  if (repeated_) return true;
  repeated_ = true;
  send();
  return true;
}

}  // namespace nord_driver::devicenet
