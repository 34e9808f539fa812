// Accesses to parameters that take longer than whoever asked waits: answered then, and not written later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cycle/cycle_bench.h"
#include "cycle/parameter_requests.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// The inverter is slow from then on: what it is asked stays open.
class OverdueParameters : public ::testing::Test, protected CycleBench {
 protected:
  OverdueParameters() {
    run(80);
    transport.parameters[102] = 100;
    transport.hold_answers = true;
  }
  void submit(Request request, std::uint32_t id, Duration patience) {
    request.id = id;
    request.patience = patience;
    request.asked = transport.time;
    ASSERT_TRUE(ports.submit(request));
  }
  static Request read() {
    Request request = test::writeRequest(kLift, 102, 0);
    request.kind = RequestKind::kReadParameter;
    return request;
  }
  void answerAll() {
    for (int i = 0; i < 50; ++i) {
      if (!transport.submitted.empty()) {
        wrote_ = wrote_ || writes();
        transport.answerFirst();
      }
      step();
    }
  }
  /// A write is under way.
  bool writes() const {
    return std::any_of(transport.submitted.begin(), transport.submitted.end(), [](const auto& submitted) {
      return submitted.request.action != profile::ParameterAction::kRead;
    });
  }

  bool wrote_ = false;
};

// Many clients at once: those that find no room are told so in the same cycle, and those that waited when their patience
// ends, which may be that cycle, too.
TEST_F(OverdueParameters, OfAFullQueueOfRequestsEachIsAnswered) {
  constexpr std::uint32_t kWaiting = 8, kQueued = 31;
  for (std::uint32_t i = 0; i < kWaiting; ++i) submit(read(), 501 + i, milliseconds{200});
  for (const Instant end = transport.time + milliseconds{190}; transport.time < end;) step();
  completions.clear();
  for (std::uint32_t i = 0; i < kQueued; ++i) submit(read(), 601 + i, milliseconds{200});
  run(3);
  EXPECT_EQ(kWaiting + kQueued, completions.size());
}

TEST_F(OverdueParameters, AReadIsAnsweredWhenThePatienceEnds) {
  submit(read(), 501, milliseconds{200});
  const Instant end = transport.time + milliseconds{200};
  while (transport.time < end) {
    EXPECT_EQ(0u, completions.count(501));
    step();
  }
  step();
  ASSERT_EQ(1u, completions.count(501)) << "within one cycle";
  EXPECT_FALSE(completions[501].success);
  EXPECT_STREQ("drive lift gave no answer for P102: in the time it was given", completions[501].message.c_str());
  EXPECT_FALSE(completions[501].parameter.eeprom_written);
  completions.clear();
  answerAll();
  EXPECT_EQ(0u, completions.count(501)) << "one answer for each request";
}

// It has waited behind a read for so long that nobody waits for it any more: what it was told stays true.
TEST_F(OverdueParameters, AWriteThatWasNotBegunIsNotCarriedOut) {
  submit(read(), 501, std::chrono::seconds{5});
  submit(test::writeRequest(kLift, 102, 250), 502, milliseconds{200});
  run(25);
  ASSERT_EQ(1u, completions.count(502));
  EXPECT_FALSE(completions[502].success);
  EXPECT_THAT(completions[502].message.c_str(), HasSubstr("nothing was written, and nothing will be"));
  EXPECT_FALSE(completions[502].parameter.eeprom_written);
  answerAll();
  EXPECT_TRUE(completions[501].success);
  EXPECT_FALSE(wrote_);
}

TEST_F(OverdueParameters, NorIsOneOfWhichOnlyTheValueBeforeWasAskedFor) {
  submit(test::writeRequest(kLift, 102, 250), 501, milliseconds{200});
  run(25);
  ASSERT_EQ(1u, completions.count(501));
  answerAll();
  EXPECT_FALSE(wrote_);
}

TEST_F(OverdueParameters, OfAWriteUnderWayNobodyKnows) {
  transport.parameters[560] = 1;
  for (const bool persistent : {false, true}) {
    const auto action = persistent ? profile::ParameterAction::kWritePersistent : profile::ParameterAction::kWriteRam;
    const std::uint32_t id = persistent ? 502 : 501;
    submit(test::writeRequest(kLift, 102, persistent ? 300 : 250, action), id, milliseconds{200});
    for (int i = 0; i < 10 && !writes(); ++i) {
      step();
      if (!writes() && !transport.submitted.empty()) transport.answerFirst();
    }
    ASSERT_TRUE(writes());
    run(25);
    ASSERT_EQ(1u, completions.count(id));
    EXPECT_THAT(completions[id].message.c_str(), HasSubstr("whether the inverter carried the write out is not known"));
    EXPECT_EQ(persistent, completions[id].parameter.eeprom_written) << "or may have been";
    answerAll();
  }
}

// nord_param limits the time itself.
TEST_F(OverdueParameters, WhoHasNoPatienceToTellWaits) {
  Request request = read();
  request.id = 501;
  ASSERT_TRUE(ports.submit(request));
  run(500);
  EXPECT_EQ(0u, completions.count(501));
  answerAll();
  EXPECT_TRUE(completions[501].success);
}

}  // namespace
}  // namespace nord_driver::cycle
