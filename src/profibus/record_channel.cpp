#include "profibus/record_channel.h"

#include <algorithm>

namespace nord_driver::profibus {

namespace {

// A busy read is repeated for so long at least, however short the time for one response is.
constexpr Duration kBusyTime = std::chrono::seconds{1};

}  // namespace

bool RecordChannel::submit(const RecordRequest& request, std::optional<RecordOutcome> unusable) noexcept {
  if (state_ != State::kFree || !encodeRecord(request, pdu_)) return false;
  request_ = request;
  result_ = RecordResult{};
  result_.slave = slave_;
  result_.slot = request.slot;
  result_.index = request.index;
  result_.write = request.write;
  timers_.stop(Timer::kResponse);
  timers_.stop(Timer::kBusy);
  no_resource_ = false;
  state_ = State::kToSend;
  if (unusable) end(*unusable);
  return true;
}

std::optional<RecordResult> RecordChannel::pollResult() noexcept {
  if (state_ != State::kEnded) return std::nullopt;
  state_ = State::kFree;
  return result_;
}

bool RecordChannel::wantsTelegram(Instant now) noexcept {
  const bool waiting = state_ == State::kToSend || state_ == State::kPolling;
  if (waiting && timers_.isOver(Timer::kResponse, now)) {
    if (state_ == State::kPolling || no_resource_) giveUp(Timer::kDrain, now);
    end(RecordOutcome::kTimedOut);
  }
  const bool drains = given_up_ && timers_.isRunning(Timer::kDrain, now);
  return state_ == State::kToSend || state_ == State::kPolling || drains;
}

ByteView RecordChannel::pollTelegram(Instant now) noexcept {
  sent_request_ = state_ == State::kToSend && !given_up_;
  if (!sent_request_) return {};
  if (!timers_.isSet(Timer::kResponse)) timers_.set(Timer::kResponse, now + response_timeout_);
  if (!timers_.isSet(Timer::kBusy)) timers_.set(Timer::kBusy, now + std::max(kBusyTime, response_timeout_));
  return pdu_;
}

void RecordChannel::handleAnswer(const FdlAnswer& answer, Instant now) noexcept {
  switch (answer.kind) {
    case FdlAnswer::Kind::kAcknowledge:
      // To the request: taken. To a poll: no response yet.
      if (sent_request_ && state_ == State::kToSend) state_ = State::kPolling;
      no_resource_ = false;
      return handleNothing(now);
    case FdlAnswer::Kind::kData:
      return handleResponse(answer.data, now);
    case FdlAnswer::Kind::kRefusal:
      // No resource for the moment: once more, until the end.
      if (answer.code != ResponseCode::kNotActivated) return handleNoResource(now);
      given_up_ = false;
      // A write that was taken may have been carried out: it has no response, which says nothing of it.
      return end(request_.write && state_ == State::kPolling ? RecordOutcome::kTimedOut : RecordOutcome::kNotActivated);
  }
}

void RecordChannel::handleResponse(ByteView pdu, Instant now) noexcept {
  if (given_up_) return forget();  // that was the late one
  switch (parseRecordAnswer(pdu, request_, result_)) {
    case RecordAnswer::kOther:
      if (sent_request_ && state_ == State::kToSend) state_ = State::kPolling;
      return;
    case RecordAnswer::kPositive:
      return end(RecordOutcome::kDone);
    case RecordAnswer::kNegative:
      break;
  }
  if (request_.write || !result_.error.isBusy()) return end(RecordOutcome::kRefused);
  if (timers_.isOver(Timer::kBusy, now)) return end(RecordOutcome::kTimedOut);
  state_ = State::kToSend;
  timers_.set(Timer::kResponse, *earlier(now + response_timeout_, timers_.at(Timer::kBusy)));
}

// It may have been taken, and only what says so was lost. Nothing is polled for nobody's sake: at an access point that
// is silent each telegram costs a slot time.
void RecordChannel::handleNoAnswer(Instant now) noexcept {
  if (sent_request_ || state_ == State::kPolling) giveUp(Timer::kMaking, now);
  end(RecordOutcome::kNoAnswer);
}

void RecordChannel::handleOffline(Instant now) noexcept {
  const bool sent = state_ == State::kPolling || (state_ == State::kToSend && timers_.isSet(Timer::kResponse));
  if (sent) giveUp(Timer::kMaking, now);
  end(RecordOutcome::kOffline);
}

void RecordChannel::handleStartUp() noexcept {
  forget();
}

void RecordChannel::giveUp(Timer late, Instant now) noexcept {
  given_up_ = true;
  timers_.set(late, now + response_timeout_);
}

// The slave had nothing to say: once it has had its time, nothing comes any more of the request given up.
void RecordChannel::handleNothing(Instant now) noexcept {
  const bool may_come = timers_.isRunning(Timer::kDrain, now) || timers_.isRunning(Timer::kMaking, now);
  if (given_up_ && !may_come) forget();
}

// Whether a response waits it does not say. A request that cannot go out for that ends as one that brings no response.
void RecordChannel::handleNoResource(Instant now) noexcept {
  no_resource_ = !given_up_;
  if (given_up_ && !timers_.isSet(Timer::kResponse)) timers_.set(Timer::kResponse, now + response_timeout_);
}

void RecordChannel::forget() noexcept {
  given_up_ = false;
  timers_.stop(Timer::kResponse);
}

void RecordChannel::end(RecordOutcome outcome) noexcept {
  if (state_ == State::kFree || state_ == State::kEnded) return;
  result_.outcome = outcome;
  state_ = State::kEnded;
}

}  // namespace nord_driver::profibus
