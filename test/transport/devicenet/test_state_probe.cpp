// Whether an inverter is there, where process data do not tell.
#include <gtest/gtest.h>

#include "transport/devicenet/state_probe.h"

namespace nord_driver {
namespace {

using devicenet::ExplicitAnswer;
using devicenet::ExplicitEnd;
using std::chrono::milliseconds;

constexpr Instant kStart{std::chrono::seconds{1000}};

struct Probe {
  explicit Probe(bool always) : probe{3, 0x8001, always} {}
  bool asks(Instant now = kStart) {
    const auto request = probe.pendingRequest(now);
    if (!request) return false;
    id = request->id;
    EXPECT_EQ(41, request->class_id);
    EXPECT_EQ(3, request->instance);
    EXPECT_EQ(6, request->attribute.value_or(0));
    probe.handleStarted();
    return true;
  }
  void answer(ExplicitEnd end, std::uint8_t value) {
    ExplicitAnswer answer;
    answer.id = id;
    answer.end = end;
    if (end == ExplicitEnd::kDone) answer.data.push_back(value);
    if (end == ExplicitEnd::kRefused) answer.general = value;
    probe.handleAnswer(answer, kStart);
  }

  StateProbe probe;
  std::uint32_t id = 0;
};

TEST(StateProbe, InDoubtTheInverterIsOff) {
  Probe probe{true};
  EXPECT_FALSE(probe.probe.present());
  ASSERT_TRUE(probe.asks());
  EXPECT_FALSE(probe.asks()) << "one question at a time";
  probe.answer(ExplicitEnd::kDone, 4);
  EXPECT_TRUE(probe.probe.present());
  EXPECT_EQ(4, probe.probe.state().value_or(0));
  EXPECT_FALSE(probe.asks(kStart + milliseconds{249}));
  ASSERT_TRUE(probe.asks(kStart + milliseconds{250}));
  probe.answer(ExplicitEnd::kRefused, 0x02);
  EXPECT_FALSE(probe.probe.present());
  EXPECT_FALSE(probe.probe.state());
}

// A module that does not have the object says so, and its inverter may be there.
TEST(StateProbe, AMissingObjectIsNoMissingInverter) {
  Probe probe{true};
  ASSERT_TRUE(probe.asks());
  probe.answer(ExplicitEnd::kRefused, 0x16);
  EXPECT_TRUE(probe.probe.present());
  EXPECT_FALSE(probe.probe.state());
}

TEST(StateProbe, AsksOnlyOfAnInverterSaidToBeOff) {
  Probe probe{false};
  EXPECT_TRUE(probe.probe.present());
  EXPECT_FALSE(probe.asks());
  probe.probe.handleAbsence();
  EXPECT_FALSE(probe.probe.present());
  ASSERT_TRUE(probe.asks());
  probe.answer(ExplicitEnd::kTimedOut, 0);
  EXPECT_FALSE(probe.probe.present());
  ASSERT_TRUE(probe.asks(kStart + milliseconds{250}));
  probe.answer(ExplicitEnd::kDone, 3);
  EXPECT_TRUE(probe.probe.present());
  EXPECT_FALSE(probe.asks(kStart + milliseconds{1000}));
}

TEST(StateProbe, BeginsAnewWithItsModule) {
  Probe probe{true};
  ASSERT_TRUE(probe.asks());
  probe.probe.handleOffline();
  probe.answer(ExplicitEnd::kDone, 3);
  EXPECT_FALSE(probe.probe.present()) << "an answer from before";
  EXPECT_TRUE(probe.asks());
}

}  // namespace
}  // namespace nord_driver
