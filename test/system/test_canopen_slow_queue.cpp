// A CAN interface whose queue takes a frame only now and then: slower than setpoints are made, fast enough to guard each
// node. Every drive hears the newest word, or nobody guards it.
#include <gtest/gtest.h>

#include <cmath>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

// Of an inverter that has tripped the wheel coasts, for some 8 s.
constexpr Duration kCoasting = std::chrono::seconds{12};

using std::chrono::milliseconds;
using std::chrono::seconds;

class CanopenSlowQueue : public ::testing::TestWithParam<milliseconds> {
 protected:
  void SetUp() override {
    robot_ = std::make_unique<CanRobot>(options());
    ASSERT_TRUE(robot_->bringUpAndEnable());
    robot_->drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_FALSE(robot_->standsStill());
    robot_->bus().setQueuePace(GetParam());
  }
  virtual CanRobot::Options options() const { return {}; }
  /// Whether the wheels come to rest within `limit`; commanded as before, or 0.
  bool comesToRest(double speed, Duration limit) {
    const Instant end = robot_->transport().now() + limit;
    while (robot_->transport().now() < end && !robot_->standsStill()) {
      robot_->command(speed);
      robot_->step();
    }
    return robot_->standsStill();
  }

  std::unique_ptr<CanRobot> robot_;
};

INSTANTIATE_TEST_SUITE_P(Pace, CanopenSlowQueue,
                         ::testing::Values(milliseconds{5}, milliseconds{12}, milliseconds{20}, milliseconds{50},
                                           milliseconds{100}, milliseconds{250}, milliseconds{1000}),
                         [](const auto& pace) { return std::to_string(pace.param.count()) + "ms"; });

TEST_P(CanopenSlowQueue, EveryWheelIsStopped) {
  EXPECT_TRUE(comesToRest(0.0, kCoasting));
}

// The driver learns of it by what it is not answered, and stops the base, too.
TEST_P(CanopenSlowQueue, ItIsLivedThrough) {
  robot_->drive(kHalfSpeed, 0.0, kCoasting);
  EXPECT_TRUE(robot_->standsStill()) << "nobody is guarded where setpoints are lost";
  robot_->bus().setQueuePace({});
  EXPECT_TRUE(comesToRest(0.0, kCoasting));
  EXPECT_TRUE(robot_->runUntil([this] { return robot_->online(0) && robot_->online(1); }));
}

/// What stops a drive acts with SYNC only.
class CanopenSlowQueueWithSync : public CanopenSlowQueue {
 protected:
  CanRobot::Options options() const override {
    CanRobot::Options options;
    options.bus = {{"sync", true}};
    options.drives = {{"error_control", std::string{"none"}}};  // nothing else stops an inverter
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(Pace, CanopenSlowQueueWithSync,
                         ::testing::Values(milliseconds{5}, milliseconds{7}, milliseconds{10}, milliseconds{12},
                                           milliseconds{20}, milliseconds{50}, milliseconds{100}),
                         [](const auto& pace) { return std::to_string(pace.param.count()) + "ms"; });

TEST_P(CanopenSlowQueueWithSync, EveryWheelIsStoppedByWords) {
  EXPECT_TRUE(comesToRest(0.0, seconds{3})) << "three places for two words and their SYNC, and a ramp of a second";
}

// What stops a node that fell silent does not take the place of what stops the others.
TEST(CanopenQueue, ThatIsSlowStopsTheOtherWheelOfOneThatFellSilent) {
  CanRobot::Options options;
  options.drives = {{"error_control", std::string{"heartbeat"}}, {"heartbeat_time", 0.02}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  robot.bus().setQueuePace(milliseconds{8});
  robot.link().setDeaf(0x703);
  const double frequency = std::abs(robot.unit(1).inverter().frequency());
  ASSERT_GT(frequency, 20.0);
  const Instant end = robot.transport().now() + seconds{1};
  while (robot.transport().now() < end) {
    robot.command(kHalfSpeed);
    robot.step();
  }
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    EXPECT_LT(std::abs(robot.unit(wheel).inverter().frequency()), 0.8 * frequency) << "wheel " << wheel;
  }
}

// One that takes all that is due in a cycle, one frame after the other, is none of these.
TEST(CanopenQueue, ThatIsFastEnoughStopsNobody) {
  CanRobot robot{CanRobot::Options{}};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.bus().setQueuePace(milliseconds{2});
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_TRUE(robot.snapshot().base.enabled) << robot.snapshot().base.text.c_str();
  EXPECT_NEAR(kHalfSpeed, robot.snapshot().base.velocity.linear_x, 0.02);
}

}  // namespace
}  // namespace nord_driver::test
