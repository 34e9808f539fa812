#include "profile/pkw_channel.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint16_t kLastNumber = 999;
constexpr std::uint16_t kFaultNumber = 700;

OrderLabel labelFor(const ParameterRequest& request) noexcept {
  const bool indexed = request.shape != ParameterShape::kPlain;
  switch (request.action) {
    case ParameterAction::kRead:
      return indexed ? OrderLabel::kReadArray : OrderLabel::kRead;
    case ParameterAction::kWriteRam:
      if (request.double_word) return indexed ? OrderLabel::kWriteArrayDoubleRam : OrderLabel::kWriteDoubleRam;
      return indexed ? OrderLabel::kWriteArrayWordRam : OrderLabel::kWriteWordRam;
    case ParameterAction::kWritePersistent:
      if (request.double_word) return indexed ? OrderLabel::kWriteArrayDouble : OrderLabel::kWriteDouble;
      return indexed ? OrderLabel::kWriteArrayWord : OrderLabel::kWriteWord;
  }
  return OrderLabel::kNone;
}

PkwOrder orderFor(const ParameterRequest& request) noexcept {
  PkwOrder order;
  order.label = labelFor(request);
  order.number = request.number;
  order.index = pkwIndex(request.shape, request.parameter_set, request.index);
  order.value = request.action == ParameterAction::kRead ? 0 : request.raw;
  return order;
}

bool hasSets(ParameterShape shape) noexcept {
  return shape == ParameterShape::kPerSet || shape == ParameterShape::kArrayPerSet;
}

bool isArray(ParameterShape shape) noexcept {
  return shape == ParameterShape::kArray || shape == ParameterShape::kArrayPerSet;
}

bool indexIsPossible(const ParameterRequest& request) noexcept {
  if (hasSets(request.shape) && (request.parameter_set < 1 || request.parameter_set > 4)) return false;
  if (!isArray(request.shape)) return true;
  if (request.index == 0) return false;
  // Six bits of the index are left for the element of a set-dependent array (BU 2700 6.5.1.2).
  return request.shape == ParameterShape::kArray || request.index <= 64;
}

}  // namespace

bool PkwChannel::submit(const ParameterRequest& request, Instant now) noexcept {
  if (request.number > kLastNumber || !indexIsPossible(request)) {
    ParameterResult result;
    result.outcome = ParameterOutcome::kRefused;
    result.error_number = request.number > kLastNumber ? pkw_error::kInvalidNumber : pkw_error::kWrongSubIndex;
    return requests_.answer(request, result);
  }
  if (!requests_.submit(request)) return false;
  if (requests_.size() == 1) startNext(now);
  return true;
}

void PkwChannel::startNext(Instant now) noexcept {
  prepared_ = !requests_.empty();
  if (!prepared_) return;
  order_ = orderFor(requests_.front());
  fell_back_ = false;
  deadline_ = now + answer_timeout_;
}

void PkwChannel::pause() noexcept {
  phase_ = Phase::kPause;
  pause_sent_ = false;
  pause_answered_ = false;
}

bool PkwChannel::mayStart() const noexcept {
  if (pause_answered_) return true;
  // The order before has its answer, and nobody can mistake that answer for the next one's.
  return pause_sent_ && !last_unanswered_ && !answers(order_, toAnswer(last_words_));
}

PkwWords PkwChannel::pollWords(Instant now) noexcept {
  while (!requests_.empty()) {
    if (!prepared_) startNext(now);
    if (now < deadline_) break;
    last_unanswered_ = last_unanswered_ || phase_ == Phase::kOrder;
    finish(ParameterOutcome::kTimeout, 0, 0);
  }
  if (!requests_.empty() && phase_ == Phase::kPause && mayStart()) {
    phase_ = Phase::kOrder;
    previous_ = sent_;
    sent_ = order_;
    stale_words_ = {};
  }
  if (phase_ == Phase::kOrder) return toWords(order_);
  pause_sent_ = true;
  return {};
}

void PkwChannel::handleWords(const PkwWords& words, Instant now) noexcept {
  last_words_ = words;
  const PkwAnswer answer = toAnswer(words);
  const bool empty = answer.label == static_cast<std::uint8_t>(AnswerLabel::kNone);
  if (phase_ == Phase::kPause) {
    if (pause_sent_ && empty) {
      pause_answered_ = true;
      last_unanswered_ = false;
    }
    return;
  }
  if (!answers(order_, answer)) {
    if (!empty) countStale(words, answer);
    return;
  }
  last_unanswered_ = false;
  if (answer.label != static_cast<std::uint8_t>(AnswerLabel::kError)) {
    finish(ParameterOutcome::kDone, answer.value, 0);
  } else if (!fallBack(answer.error_number)) {
    finish(ParameterOutcome::kRefused, 0, answer.error_number);
  }
  if (!requests_.empty() && !prepared_) startNext(now);
}

void PkwChannel::countStale(const PkwWords& words, const PkwAnswer& answer) noexcept {
  if (answers(previous_, answer) || words == stale_words_) return;  // the same repeated answer counts once
  ++stale_;
  stale_words_ = words;
}

bool PkwChannel::fallBack(std::uint16_t error_number) noexcept {
  // A parameter without an index answers a read of an array with error 4; P700 is an array from firmware V1.9 on only
  // (BU 0020 8). Label 1 ignores the index, so only the first element may be read with it: the third one of P700 would
  // come back as the number of a fault.
  if (fell_back_ || order_.label != OrderLabel::kReadArray) return false;
  const bool no_array = error_number == pkw_error::kNoArray ||
                        (error_number == pkw_error::kWrongSubIndex && order_.number == kFaultNumber);
  const ParameterRequest& request = requests_.front();
  if (!no_array || (isArray(request.shape) && request.index != 1)) return false;
  fell_back_ = true;
  order_.label = OrderLabel::kRead;
  order_.index = 0;
  pause();
  return true;
}

void PkwChannel::handleFailure(ParameterOutcome outcome, std::uint16_t error_number) noexcept {
  if (requests_.empty()) return;
  last_unanswered_ = last_unanswered_ || phase_ == Phase::kOrder;
  finish(outcome, 0, error_number);
}

void PkwChannel::handleOffline(Instant) noexcept {
  last_unanswered_ = true;
  pause();
  while (!requests_.empty()) finish(ParameterOutcome::kOffline, 0, 0);
}

void PkwChannel::finish(ParameterOutcome outcome, std::int32_t raw, std::uint16_t error_number) noexcept {
  ParameterResult result;
  result.outcome = outcome;
  result.raw = raw;
  result.error_number = error_number;
  requests_.finish(result);
  prepared_ = false;
  if (phase_ == Phase::kOrder) pause();
}

}  // namespace nord_driver::profile
