// What no sequence of requests, answers, silence and time may make the parameter channel do.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <vector>

#include "profile/pkw_channel.h"

namespace nord_driver::profile {
namespace {

struct Step {
  int submit = 0;  // 0 nothing, 1 read, 2 write to RAM, 3 write persistently
  int value = 0;
  int answer = 0;  // 0 executes the order, 1 repeats the last answer, 2 no answer, 3 an error, 4 anything, 5 offline
};

rc::Gen<Step> anyStep() {
  return rc::gen::build<Step>(
      rc::gen::set(&Step::submit, rc::gen::weightedElement<int>({{4, 0}, {1, 1}, {1, 2}, {2, 3}})),
      rc::gen::set(&Step::value, rc::gen::inRange(0, 2)),
      rc::gen::set(&Step::answer, rc::gen::weightedElement<int>({{8, 0}, {8, 1}, {2, 2}, {1, 3}, {1, 4}, {1, 5}})));
}

constexpr PkwWords kNothing{};

bool isWriteOrder(const PkwWords& words) {
  const unsigned label = words[0] >> 12u;
  return label == 2 || label == 3 || label == 7 || label == 8 || label >= 11;
}

// The positive answer of BU 2700 6.5.1.1, typed here a second time.
PkwWords answerTo(const PkwWords& order) {
  static constexpr unsigned kAnswers[16] = {0, 1, 1, 2, 0, 0, 4, 4, 5, 6, 0, 5, 4, 2, 1, 0};
  if (order == kNothing) return kNothing;
  PkwWords answer = order;
  answer[0] = static_cast<Word>((order[0] & 0x07FFu) | kAnswers[order[0] >> 12u] << 12u);
  return answer;
}

PkwWords errorTo(const PkwWords& order) {
  return {static_cast<Word>(0x7000u | (order[0] & 0x07FFu)), order[1], 0, 2};
}

// A write left standing, or sent again, is executed again (BU 2700 6.5: "continuous cyclical writing must be
// prevented"): from its answer on the order is gone, and each request that ends well was answered once.
RC_GTEST_PROP(PkwChannelProperty, NeverRepeatsAWriteAfterItsAnswer, ()) {
  const auto steps = *rc::gen::container<std::vector<Step>>(60, anyStep());
  PkwChannel channel(seconds(0.08));
  Instant now{};
  PkwWords standing = kNothing;
  std::optional<PkwWords> answered;  // a write order whose answer was handed over, until "no order" has gone out
  int writes_asked = 0;
  int writes_begun = 0;
  PkwWords before = kNothing;
  for (const Step& step : steps) {
    if (step.submit != 0) {
      ParameterRequest request;
      request.number = 102;
      request.action = static_cast<ParameterAction>(step.submit - 1);
      request.raw = step.value;
      if (channel.submit(request, now) && step.submit != 1) ++writes_asked;
    }
    const PkwWords order = channel.pollWords(now);
    if (order == kNothing) answered.reset();
    RC_ASSERT(!answered.has_value() || order != *answered);
    if (isWriteOrder(order) && order != before) ++writes_begun;
    before = order;
    now += std::chrono::milliseconds(10);
    if (step.answer == 5) {
      channel.handleOffline(now);
      standing = kNothing;
      continue;
    }
    if (step.answer == 0) standing = answerTo(order);
    if (step.answer == 2) standing = kNothing;
    if (step.answer == 3 && order != kNothing) standing = errorTo(order);
    const PkwWords words = step.answer == 4 ? PkwWords{0x15E4, 0, 0, 3} : standing;
    channel.handleWords(words, now);
    const bool its_own = order != kNothing && (words == answerTo(order) || words == errorTo(order));
    if (isWriteOrder(order) && its_own) answered = order;
    while (channel.pollResult().has_value()) {
    }
  }
  RC_ASSERT(writes_begun <= writes_asked);
}

}  // namespace
}  // namespace nord_driver::profile
