#include "profibus/requester.h"

#include <algorithm>

namespace nord_driver::profibus {

void Requester::restart(Instant now) noexcept {
  state_ = State::kIdle;
  request_ = nullptr;
  slave_ = nullptr;
  receiver_.discard();
  tokens_.forget();
  echo_.forget();
  may_be_late_ = false;
  takeReceiverCounters();
  timers_.set(Timer::kLineIdle, now + bus_.idleTime());
}

void Requester::begin(const FdlRequest& request, SlaveCounters* slave, Instant now) noexcept {
  request_ = &request;
  slave_ = slave;
  sendings_ = 0;
  mismatch_ = Mismatch::kNone;
  queue(now);
}

// Whoever talks now may finish the longest telegram; a line that is not silent after that has a fault.
void Requester::queue(Instant now) noexcept {
  state_ = State::kToSend;
  const Instant idle = std::max(now, timers_.at(Timer::kLineIdle).value_or(now));
  timers_.set(Timer::kGiveUp, idle + bus_.baud.characters(kMaxTelegramLength) + 2 * bus_.slotTime());
}

ByteView Requester::pollTransmit(Instant now) noexcept {
  if (state_ != State::kToSend || timers_.isRunning(Timer::kLineIdle, now)) return {};
  // Bytes from before the pause belong to no answer.
  receiver_.discard();
  takeReceiverCounters();

  echo_.handleSent(request_->frame);
  ++sendings_;
  ++counters_.telegrams_sent;
  if (sendings_ > 1) ++counters_.retries;
  if (slave_ != nullptr) {
    ++slave_->requests;
    if (sendings_ > 1) ++slave_->retries;
  }

  const Instant sent = now + bus_.baud.characters(request_->frame.size());
  if (request_->answered) {
    state_ = State::kAwaitAnswer;
    const Instant slot_end = sent + bus_.slotTime();
    timers_.set(Timer::kLineIdle, sent + bus_.idleTime());
    timers_.set(Timer::kSlot, slot_end);
    timers_.set(Timer::kLongestSlot, slot_end + bus_.baud.characters(kMaxTelegramLength) + bus_.slotTime());
  } else {
    state_ = State::kIdle;
    timers_.set(Timer::kLineIdle, sent + bus_.broadcastIdleTime());
  }
  return request_->frame;
}

std::optional<Instant> Requester::nextDeadline() const noexcept {
  switch (state_) {
    case State::kIdle:
      return std::nullopt;
    case State::kToSend:
      return earlier(timers_.at(Timer::kLineIdle), timers_.at(Timer::kGiveUp));
    case State::kAwaitAnswer:
      return timers_.at(Timer::kSlot);
  }
  return std::nullopt;
}

Requester::Outcome Requester::handleTimeout(Instant now) noexcept {
  if (state_ == State::kToSend && timers_.isOver(Timer::kGiveUp, now) && timers_.isRunning(Timer::kLineIdle, now)) {
    state_ = State::kIdle;
    ++counters_.busy;
    may_be_late_ = may_be_late_ || sendings_ > 0;
    return sendings_ == 0 ? Outcome::kLineBusy : Outcome::kNoAnswer;
  }
  if (state_ != State::kAwaitAnswer || timers_.isRunning(Timer::kSlot, now)) return Outcome::kNone;

  ++counters_.timeouts;
  if (slave_ != nullptr) ++slave_->timeouts;
  receiver_.discard();
  takeReceiverCounters();
  if (sendings_ <= request_->retries) {
    queue(now);
    return Outcome::kNone;
  }
  state_ = State::kIdle;
  may_be_late_ = true;
  return Outcome::kNoAnswer;
}

// The slot time is the time to the first character of an answer. A longer answer, or one that an adapter hands over in
// pieces, takes its time: every piece prolongs the slot, up to the longest telegram there is.
void Requester::noteActivity(Instant now) noexcept {
  timers_.prolong(Timer::kLineIdle, now + bus_.idleTime());
  if (state_ != State::kAwaitAnswer) return;
  timers_.prolong(Timer::kSlot, std::min(now + bus_.slotTime(), *timers_.at(Timer::kLongestSlot)));
}

bool Requester::isForeign(const Telegram& telegram) const noexcept {
  if (telegram.kind == TelegramKind::kSc) return false;
  return telegram.kind == TelegramKind::kSd4 || isRequest(telegram.fc);
}

// A request has a checksum; a token behind bytes that are no telegram is a piece of something else.
bool Requester::isCertain(const Telegram& telegram, Instant now) noexcept {
  if (telegram.kind != TelegramKind::kSd4) return true;
  return tokens_.believes(telegram, receiver_.counters().bytes_discarded == discarded_, now);
}

// What comes back behind its answer shows that this was none: every answer since then is late by as much.
bool Requester::isEcho(const Telegram& telegram) noexcept {
  if (!echo_.takes(telegram)) return false;
  may_be_late_ = may_be_late_ || state_ != State::kAwaitAnswer || !echo_.empty();
  return true;
}

bool Requester::accept(const Telegram& telegram, FdlAnswer& answer) noexcept {
  if (state_ != State::kAwaitAnswer) {
    ++counters_.unexpected;
    return false;
  }
  const Mismatch mismatch = matchAnswer(*request_, bus_.master.value(), telegram, answer);
  if (mismatch != Mismatch::kNone) {
    mismatch_ = mismatch;
    ++counters_.unexpected;
    if (slave_ != nullptr) ++slave_->unexpected;
    return false;
  }
  // Late, it is the answer to the first sending: the repetition comes back behind it.
  if (sendings_ <= 1 && may_be_late_) {
    echo_.forgetAllButLast();
  } else if (sendings_ <= 1) {
    echo_.forget();
  }
  may_be_late_ = sendings_ > 1;
  state_ = State::kIdle;
  if (slave_ != nullptr) ++slave_->answers;
  return true;
}

void Requester::takeReceiverCounters() noexcept {
  counters_.receiver = receiver_.counters();
  counters_.telegrams_received = counters_.receiver.telegrams;
  counters_.checksum_errors = counters_.receiver.checksum_errors;
  counters_.discarded_bytes = counters_.receiver.bytes_discarded;
}

}  // namespace nord_driver::profibus
