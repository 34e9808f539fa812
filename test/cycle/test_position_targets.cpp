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

}  // namespace
}  // namespace nord_driver::cycle
