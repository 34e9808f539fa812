#include "profile/parameter_queue.h"

#include "profile/parameter_shape.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint16_t kLastNumber = 999;

ParameterResult refusal(ParameterReason reason, const Sentence& text) noexcept {
  ParameterResult result;
  result.outcome = ParameterOutcome::kRefused;
  result.reason = reason;
  result.text = text;
  return result;
}

std::optional<ParameterResult> refusalOf(const ParameterRequest& request) noexcept {
  Sentence text;
  if (request.number > kLastNumber) {
    text.format("parameters are numbered up to %u", unsigned{kLastNumber});
    return refusal(ParameterReason::kNoSuchParameter, text);
  }
  if (hasSets(request.shape) && (request.parameter_set < 1 || request.parameter_set > 4)) {
    text.format("there is no parameter set %u", unsigned{request.parameter_set});
    return refusal(ParameterReason::kNoSuchElement, text);
  }
  // Six bits of the index are left for the element of a set-dependent array (BU 2700 6.5.1.2, BU 0060 p. 61).
  const unsigned last = request.shape == ParameterShape::kArrayPerSet ? 64 : 255;
  if (isArray(request.shape) && (request.index < 1 || request.index > last)) {
    text.format("there is no array element %u", unsigned{request.index});
    return refusal(ParameterReason::kNoSuchElement, text);
  }
  return std::nullopt;
}

}  // namespace

bool ParameterQueue::submit(const ParameterRequest& request) noexcept {
  const auto refused = refusalOf(request);
  return refused ? requests_.answer(request, *refused) : requests_.submit(request);
}

void ParameterQueue::done(std::int32_t raw) noexcept {
  ParameterResult result;
  result.outcome = ParameterOutcome::kDone;
  result.raw = raw;
  requests_.finish(result);
}

void ParameterQueue::refuse(ParameterReason reason, const Sentence& text) noexcept {
  requests_.finish(refusal(reason, text));
}

void ParameterQueue::fail(ParameterOutcome outcome, const Sentence& text) noexcept {
  ParameterResult result;
  result.outcome = outcome;
  result.text = text;
  requests_.finish(result);
}

void ParameterQueue::failAll(ParameterOutcome outcome, const Sentence& text) noexcept {
  while (!empty()) fail(outcome, text);
}

}  // namespace nord_driver::profile
