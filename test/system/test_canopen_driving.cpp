// The whole way of a command over CANopen: from a twist to the frames of BU 0060 p. 96, and back to odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/can_trace.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

// 50 % of P105 (25 Hz) is 3.92699 rad/s at the joint and 0.392699 m/s.

/// What goes over the bus under one of the given identifiers, each frame once until it changes.
class Changes {
 public:
  Changes(CanRobot& robot, std::vector<std::uint32_t> ids) : ids_(std::move(ids)) {
    robot.bus().setTap([this](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
      if (std::find(ids_.begin(), ids_.end(), frame.id) == ids_.end() || frame.remote) return;
      const std::string text = candumpText(frame);
      if (last_[frame.id] != text) seen.push_back(text);
      last_[frame.id] = text;
    });
  }
  std::vector<std::string> seen;

 private:
  std::vector<std::uint32_t> ids_;
  std::map<std::uint32_t, std::string> last_;
};

CanRobot::Options withoutSlip() {
  CanRobot::Options options;
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.motor.slip = 0.001;
  };
  return options;
}

// BU 0060 p. 96, with the manual's node 50: 232#7E040000 -> 1B2#310B0000; 232#7F040020 -> 1B2#370B0020.
TEST(CanopenDriving, ATwistBecomesTheManualsFrames) {
  CanRobot::Options options = withoutSlip();
  options.each = {{{"address", 50}}, {{"address", 51}}};
  options.simulate = [simulate = options.simulate](sim::SimConfig& config) {
    simulate(config);
    config.drives[0].address = 50;
    config.drives[1].address = 51;
  };
  CanRobot robot{options};
  Changes left{robot, {0x232, 0x1B2}};
  ASSERT_TRUE(robot.bringUp());
  ASSERT_GE(left.seen.size(), 2u);
  EXPECT_EQ("1B2#310B0000", left.seen.back());
  EXPECT_THAT(left.seen, Contains("232#7E040000"));
  EXPECT_THAT(left.seen, ::testing::Not(Contains(HasSubstr("232#7F"))));

  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
  EXPECT_THAT(left.seen, Contains("232#7F040020"));
  EXPECT_EQ("1B2#370B0020", left.seen.back());
  // The right motor is mounted the other way round.
  EXPECT_EQ(-0x2000, robot.snapshot().drives[1].output.setpoints[0]);

  // And back: IW1 = 2000h is 25 Hz, 3.927 rad/s and 0.3927 m/s.
  const cycle::CycleSnapshot& seen = robot.snapshot();
  EXPECT_DOUBLE_EQ(25.0, seen.drives[0].frequency);
  EXPECT_DOUBLE_EQ(-25.0, seen.drives[1].frequency);
  EXPECT_NEAR(kHalfSpeed, seen.base.velocity.linear_x, 1e-9);
  EXPECT_NEAR(0.0, seen.base.velocity.angular_z, 1e-9);

  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  const double way = robot.unit(0).wheelAngle() * 0.1;
  EXPECT_GT(way, 1.0);
  EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01);
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

// P104 > 0 turns the motor at setpoint 0: accepted, zero and silence are OFF1, and the next command leads up again.
TEST(CanopenDriving, WithAMinimumFrequencyAtRestItIsOff1) {
  CanRobot::Options options;
  options.drives = {{"allow_minimum_frequency", true}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.parameters = {{104, 0, 0, 50}};
  };
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.05, 0.0, std::chrono::seconds{1});  // 3.2 Hz
  EXPECT_TRUE(robot.standsStill());
  EXPECT_TRUE(robot.snapshot().drives[0].saturated);
  for (const double speed : {kHalfSpeed, -kHalfSpeed}) {
    robot.drive(speed, 0.0, std::chrono::seconds{4});
    EXPECT_NEAR(speed, robot.snapshot().base.velocity.linear_x, 2e-3);
    robot.run(std::chrono::seconds{4});
    EXPECT_TRUE(robot.standsStill());
    EXPECT_EQ(0x047E, robot.controlWord(1));
    EXPECT_TRUE(robot.snapshot().base.enabled);
  }
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

TEST(CanopenDriving, AMinimumFrequencyNobodyAcceptedIsNotEnabled) {
  CanRobot::Options options;
  options.simulate = [](sim::SimConfig& config) { config.drives[1].parameters = {{104, 0, 0, 50}}; };
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(robot.ask(cycle::RequestKind::kEnable).message.c_str(),
              HasSubstr("drive right: P104 of parameter set 1 is 5.0 Hz"));
}

}  // namespace
}  // namespace nord_driver::test
