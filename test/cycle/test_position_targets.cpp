// What users ask of a drive that positions is handed on once, in order, and nothing of it is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cycle/cycle_ports.h"
#include "cycle/position_targets.h"

namespace nord_driver::cycle {
namespace {

using Kind = AskedPosition::Kind;

class PositionTargetsTest : public ::testing::Test {
 protected:
  std::vector<AskedPosition> taken() {
    std::vector<AskedPosition> all;
    while (const auto asked = targets_.poll(ports_.newestPosition(0))) all.push_back(*asked);
    return all;
  }

  CyclePorts ports_{1};
  PositionTargets targets_;
};

TEST_F(PositionTargetsTest, OfTargetsTheNewestIsHandedOnOnce) {
  EXPECT_TRUE(taken().empty());
  ports_.commandPosition(0, 1.0);
  ports_.commandPosition(0, 2.0);
  const auto asked = taken();
  ASSERT_EQ(1u, asked.size());
  EXPECT_EQ(Kind::kTarget, asked[0].kind);
  EXPECT_EQ(2.0, asked[0].value);
  EXPECT_TRUE(taken().empty());
}

TEST_F(PositionTargetsTest, OfIncrementsEachCountsOnce) {
  ports_.commandIncrement(0, 0.5);
  ports_.commandIncrement(0, 0.25);
  auto asked = taken();
  ASSERT_EQ(1u, asked.size());
  EXPECT_EQ(Kind::kIncrement, asked[0].kind);
  EXPECT_DOUBLE_EQ(0.75, asked[0].value);
  ports_.commandIncrement(0, -0.5);
  asked = taken();
  ASSERT_EQ(1u, asked.size());
  EXPECT_DOUBLE_EQ(-0.5, asked[0].value);
  EXPECT_TRUE(taken().empty());
}

TEST_F(PositionTargetsTest, ATargetTakesTheIncrementsBeforeItAway) {
  ports_.commandIncrement(0, 0.5);
  EXPECT_EQ(1u, taken().size());
  ports_.commandIncrement(0, 7.0);
  ports_.commandPosition(0, 3.0);
  ports_.commandIncrement(0, 0.125);
  auto asked = taken();
  ASSERT_EQ(2u, asked.size());
  EXPECT_EQ(Kind::kTarget, asked[0].kind);
  EXPECT_DOUBLE_EQ(3.0, asked[0].value);
  EXPECT_EQ(Kind::kIncrement, asked[1].kind);
  EXPECT_DOUBLE_EQ(0.125, asked[1].value);
  ports_.commandIncrement(0, 7.0);
  ports_.commandPosition(0, 4.0);
  asked = taken();
  ASSERT_EQ(1u, asked.size());
  EXPECT_DOUBLE_EQ(4.0, asked[0].value);
}

TEST_F(PositionTargetsTest, WhatIsNoNumberIsNoIncrement) {
  EXPECT_FALSE(ports_.commandIncrement(0, std::nan("")));
  EXPECT_FALSE(ports_.commandIncrement(0, INFINITY));
  EXPECT_FALSE(ports_.commandIncrement(0, 1.1e6)) << "a sum of such would lose what is small";
  EXPECT_TRUE(taken().empty());
}

TEST_F(PositionTargetsTest, TellsARefusalOnceASecond) {
  const AskedPosition onward{Kind::kIncrement, 0.5};
  const Instant start{};
  const auto told = targets_.handleAnswer("lift", onward, drive::TargetRefusal::kAboveLimit, 2.6, start);
  ASSERT_TRUE(told);
  EXPECT_EQ("drive lift: the increment 0.5, to 2.6, is not taken: it is above the joint's upper limit", told->str());
  EXPECT_FALSE(targets_.handleAnswer("lift", onward, drive::TargetRefusal::kAboveLimit, 2.6, start + seconds(0.9)));
  EXPECT_TRUE(targets_.handleAnswer("lift", onward, drive::TargetRefusal::kAboveLimit, 2.6, start + seconds(1.0)));
  const auto idle = targets_.handleAnswer("lift", onward, drive::TargetRefusal::kNotEnabled, std::nan(""), start);
  ASSERT_TRUE(idle);
  EXPECT_EQ("drive lift: the increment 0.5 is not taken: the drive is not enabled, and a target is not kept for later",
            idle->str());
}

// An element of its array is a target as well: the newest of both counts.
TEST_F(PositionTargetsTest, AnElementIsHandedOnInPlaceOfATarget) {
  ports_.commandIncrement(0, 7.0);
  ports_.commandElement(0, 5);
  auto asked = taken();
  ASSERT_EQ(1u, asked.size()) << "the increment before it has no meaning any more";
  EXPECT_EQ(Kind::kElement, asked[0].kind);
  EXPECT_EQ(5, asked[0].element);
  EXPECT_TRUE(taken().empty());
  ports_.commandElement(0, 5);
  EXPECT_EQ(1u, taken().size()) << "chosen again, it is read again";
  ports_.commandPosition(0, 2.0);
  asked = taken();
  ASSERT_EQ(1u, asked.size());
  EXPECT_EQ(Kind::kTarget, asked[0].kind);
  EXPECT_EQ(2.0, asked[0].value);
  ports_.commandElement(0, 6);
  ports_.commandIncrement(0, 0.5);
  asked = taken();
  ASSERT_EQ(2u, asked.size());
  EXPECT_EQ(6, asked[0].element);
  EXPECT_DOUBLE_EQ(0.5, asked[1].value);
}

TEST_F(PositionTargetsTest, SaysWhatIsNotTakenAndWhy) {
  const Instant now{std::chrono::hours{1}};
  const auto told = targets_.handleAnswer("lift", {Kind::kTarget, 3.5}, drive::TargetRefusal::kAboveLimit, 3.5, now);
  ASSERT_TRUE(told);
  EXPECT_EQ("drive lift: the target 3.5 is not taken: it is above the joint's upper limit", told->str());
  EXPECT_EQ(told->str(), targets_.refused().str());
  const auto element =
      targets_.handleAnswer("lift", {Kind::kElement, -0.25, 5, -25'000}, drive::TargetRefusal::kBelowLimit, -0.25, now);
  ASSERT_TRUE(element);
  EXPECT_EQ(
      "drive lift: P613[-05], -25.000 revolutions or -0.25 of the joint, is not taken: it is below the joint's lower "
      "limit",
      element->str());
  Sentence unread;
  unread.format("P613[-06] was not read");
  const auto unheard = targets_.refuse(unread, now);
  ASSERT_TRUE(unheard);
  EXPECT_EQ("P613[-06] was not read", unheard->str());
  EXPECT_EQ("P613[-06] was not read", targets_.refused().str());
}

TEST_F(PositionTargetsTest, SaysNothingOfATargetThatIsTaken) {
  const Instant now{std::chrono::hours{1}};
  const AskedPosition target{Kind::kTarget, 3.5};
  targets_.handleAnswer("lift", target, drive::TargetRefusal::kAboveLimit, 3.5, now);
  EXPECT_FALSE(targets_.handleAnswer("lift", target, drive::TargetRefusal::kNone, 3.5, now));
  EXPECT_TRUE(targets_.refused().empty());
}

// Only what goes on is told seldom: one that was taken meanwhile has ended it.
TEST_F(PositionTargetsTest, TellsARefusalAtOnceAfterATargetThatWasTaken) {
  const AskedPosition target{Kind::kTarget, 3.5};
  using drive::TargetRefusal;
  for (const TargetRefusal refusal :
       {TargetRefusal::kNotFinite, TargetRefusal::kNotEnabled, TargetRefusal::kHoming, TargetRefusal::kElementsOnly,
        TargetRefusal::kBelowLimit, TargetRefusal::kAboveLimit, TargetRefusal::kBeyondRange}) {
    PositionTargets targets;
    const Instant now{std::chrono::hours{1}};
    const auto isTold = [&](TargetRefusal why, double later) {
      return targets.handleAnswer("lift", target, why, 3.5, now + seconds(later)).has_value();
    };
    EXPECT_TRUE(isTold(refusal, 0.0));
    EXPECT_FALSE(isTold(refusal, 0.5)) << drive::toString(refusal);
    EXPECT_FALSE(isTold(TargetRefusal::kNone, 0.6));
    EXPECT_TRUE(isTold(refusal, 0.7)) << drive::toString(refusal);
  }
}

}  // namespace
}  // namespace nord_driver::cycle
