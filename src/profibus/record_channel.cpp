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
  response_due_.reset();
  busy_until_.reset();
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
  if (drain_until_ && now >= *drain_until_) drain_until_.reset();
  const bool waiting = state_ == State::kToSend || state_ == State::kPolling;
  if (waiting && response_due_ && now >= *response_due_) {
    // Its response may still come, and must not be taken for that to the next request.
    if (state_ == State::kPolling) drain_until_ = now + response_timeout_;
    end(RecordOutcome::kTimedOut);
  }
  return state_ == State::kToSend || state_ == State::kPolling || isDraining(now);
}

ByteView RecordChannel::pollTelegram(Instant now) noexcept {
  sent_request_ = state_ == State::kToSend && !isDraining(now);
  if (!sent_request_) return {};
  if (!response_due_) response_due_ = now + response_timeout_;
  if (!busy_until_) busy_until_ = now + std::max(kBusyTime, response_timeout_);
  return pdu_;
}

void RecordChannel::handleAnswer(const FdlAnswer& answer, Instant now) noexcept {
  switch (answer.kind) {
    case FdlAnswer::Kind::kAcknowledge:
      // To the request: taken. To a poll: no response yet.
      if (sent_request_ && state_ == State::kToSend) state_ = State::kPolling;
      return;
    case FdlAnswer::Kind::kData:
      return handleResponse(answer.data, now);
    case FdlAnswer::Kind::kRefusal:
      if (answer.code != ResponseCode::kNotActivated) return;  // no resource for the moment: once more, until the end
      drain_until_.reset();
      return end(RecordOutcome::kNotActivated);
  }
}

void RecordChannel::handleResponse(ByteView pdu, Instant now) noexcept {
  if (isDraining(now) && !sent_request_) {
    drain_until_.reset();  // the late one
    return;
  }
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
  if (now >= *busy_until_) return end(RecordOutcome::kTimedOut);
  state_ = State::kToSend;
  response_due_ = std::min(now + response_timeout_, *busy_until_);
}

void RecordChannel::handleNoAnswer() noexcept {
  end(RecordOutcome::kNoAnswer);
}

void RecordChannel::handleOffline() noexcept {
  drain_until_.reset();  // the slave forgets its acyclic channel when it leaves data exchange
  end(RecordOutcome::kOffline);
}

void RecordChannel::end(RecordOutcome outcome) noexcept {
  if (state_ == State::kFree || state_ == State::kEnded) return;
  result_.outcome = outcome;
  state_ = State::kEnded;
}

}  // namespace nord_driver::profibus
