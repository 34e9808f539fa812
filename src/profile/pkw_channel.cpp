#include "profile/pkw_channel.h"

#include "profile/parameter_shape.h"

namespace nord_driver::profile {

namespace {

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

}  // namespace

bool PkwChannel::submit(const ParameterRequest& request, Instant now) noexcept {
  if (!requests_.submit(request)) return false;
  if (requests_.size() == 1 && !prepared_) startNext(now);
  return true;
}

void PkwChannel::startNext(Instant now) noexcept {
  prepared_ = !requests_.empty();
  if (!prepared_) return;
  order_ = orderFor(requests_.front());
  fell_back_ = false;
  wait_text_.clear();
  deadline_ = now + answer_timeout_;
}

void PkwChannel::pause() noexcept {
  phase_ = Phase::kPause;
  pause_sent_ = false;
}

bool PkwChannel::mayStart() const noexcept {
  // The order before has its answer or will have none, and nobody can mistake what came last for the next one's.
  return pause_sent_ && !last_unanswered_ && !answers(order_, toAnswer(last_words_));
}

PkwWords PkwChannel::pollWords(Instant now) noexcept {
  while (!requests_.empty()) {
    if (!prepared_) startNext(now);
    if (now < deadline_) break;
    last_unanswered_ = last_unanswered_ || phase_ == Phase::kOrder;
    requests_.fail(ParameterOutcome::kTimeout, wait_text_);
    handleEnd();
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
    if (pause_sent_ && empty) last_unanswered_ = false;
    return;
  }
  if (!answers(order_, answer)) {
    if (!empty) countStale(words, answer);
    return;
  }
  last_unanswered_ = false;
  if (answer.label != static_cast<std::uint8_t>(AnswerLabel::kError)) {
    requests_.done(answer.value);
    handleEnd();
  } else if (!fallBack(answer.error_number)) {
    requests_.refuse(pkwReason(answer.error_number), pkwErrorText(answer.error_number));
    handleEnd();
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
  const ParameterReason reason = pkwReason(error_number);
  const bool no_array = reason == ParameterReason::kNotIndexed ||
                        (reason == ParameterReason::kNoSuchElement && order_.number == kFaultNumber);
  const ParameterRequest& request = requests_.front();
  if (!no_array || (isArray(request.shape) && request.index != 1)) return false;
  fell_back_ = true;
  order_.label = OrderLabel::kRead;
  order_.index = 0;
  pause();
  return true;
}

void PkwChannel::handleRefusal(ParameterReason reason, const Sentence& text) noexcept {
  if (requests_.empty()) return;
  last_unanswered_ = last_unanswered_ || phase_ == Phase::kOrder;
  requests_.refuse(reason, text);
  handleEnd();
}

void PkwChannel::handleFailure(ParameterOutcome outcome, const Sentence& text) noexcept {
  if (requests_.empty()) return;
  last_unanswered_ = last_unanswered_ || phase_ == Phase::kOrder;
  requests_.fail(outcome, text);
  handleEnd();
}

void PkwChannel::handleOffline(Instant, const Sentence& why) noexcept {
  last_unanswered_ = true;
  requests_.failAll(ParameterOutcome::kOffline, why);
  prepared_ = false;
  pause();
}

// The running request has got its result.
void PkwChannel::handleEnd() noexcept {
  prepared_ = false;
  if (phase_ == Phase::kOrder) pause();
}

}  // namespace nord_driver::profile
