// A drive that positions goes onward from its target: never beyond its limits, and only while it is enabled.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drive/position_axis.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = seconds(0.01);

/// SK 53xE; a thousandth of a revolution is 0.003 rad of the joint.
class PositionIncrement : public ::testing::Test {
 protected:
  PositionIncrement() {
    PositionConfig config;
    config.scale.revolutions_per_unit = 1.0 / 3.0;
    config.lower = -1.0;
    config.upper = 2.0;
    axis_.emplace(config);
    axis_->setWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
    for (int i = 0; i < 6; ++i) stand(0);
    axis_->follow(false);
    axis_->follow(true);
  }
  void stand(std::int16_t steps) {
    profile::ProcessInput input;
    input.actual_values = {0, steps, static_cast<std::int16_t>(steps < 0 ? -1 : 0)};
    axis_->handleInput(input, 1, 25.0, now_);
    now_ += kCycle;
  }
  std::int32_t sent() {
    profile::ProcessOutput output;
    axis_->put(output, 1);
    return profile::getPosition(axis_->words(1).setpoint, output.setpoints);
  }

  std::optional<PositionAxis> axis_;
  Instant now_{};
};

// What a step is too coarse for is not lost: 0.001 rad is a third of one.
TEST_F(PositionIncrement, ManySmallOnesAreTheirSum) {
  for (int i = 0; i < 900; ++i) ASSERT_EQ(TargetRefusal::kNone, axis_->setTarget(axis_->target() + 0.001));
  EXPECT_EQ(300, sent());
  stand(12);  // on its way
  EXPECT_EQ(TargetRefusal::kNone, axis_->setTarget(axis_->target() + 0.003));
  EXPECT_EQ(301, sent()) << "from its target, and not from where it is";
}

TEST_F(PositionIncrement, NeverLeadsBeyondTheLimits) {
  ASSERT_EQ(TargetRefusal::kNone, axis_->setTarget(1.9));
  const std::int32_t before = sent();
  EXPECT_EQ(TargetRefusal::kAboveLimit, axis_->setTarget(axis_->target() + 0.2));
  EXPECT_EQ(TargetRefusal::kBelowLimit, axis_->setTarget(axis_->target() - 3.0));
  EXPECT_EQ(TargetRefusal::kAboveLimit, axis_->setTarget(axis_->target() + std::numeric_limits<double>::max()));
  EXPECT_EQ(before, sent());
  EXPECT_EQ(TargetRefusal::kNone, axis_->setTarget(axis_->target() + 0.05)) << "from the target that counts";
  EXPECT_NEAR(650, sent(), 1);
}

TEST_F(PositionIncrement, GoesOnFromWhereItIsHeld) {
  ASSERT_EQ(TargetRefusal::kNone, axis_->setTarget(1.9));
  for (std::int16_t steps = 0; steps < 100; steps += 10) stand(steps);
  axis_->follow(false);  // a stop
  for (int i = 0; i < 6; ++i) stand(100);
  axis_->follow(false);
  axis_->follow(true);
  ASSERT_EQ(TargetRefusal::kNone, axis_->setTarget(axis_->target() + 0.3));
  EXPECT_EQ(200, sent());
}

}  // namespace
}  // namespace nord_driver::drive
