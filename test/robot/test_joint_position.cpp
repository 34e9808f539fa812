#include <gtest/gtest.h>

#include <limits>

#include "robot/joint_position.h"

namespace nord_driver::robot {
namespace {

// The way of a cycle is the mean of the speeds at its ends times its measured duration.
TEST(JointPosition, IntegratesByTheTrapezoidRule) {
  JointPosition joint;
  joint.update(2.0, seconds(0.01));
  EXPECT_EQ(0.0, joint.position());
  joint.update(4.0, seconds(0.01));
  EXPECT_NEAR(0.03, joint.position(), 1e-12);
  joint.update(4.0, seconds(0.02));
  EXPECT_NEAR(0.11, joint.position(), 1e-12);
  EXPECT_EQ(4.0, joint.velocity());
}

// The angle counts on over many turns, forward and back.
TEST(JointPosition, DoesNotWrap) {
  JointPosition joint;
  joint.update(10.0, seconds(1.0));
  joint.update(10.0, seconds(100.0));
  EXPECT_NEAR(1000.0, joint.position(), 1e-9);
  joint.rebase();
  joint.update(-10.0, seconds(1.0));
  joint.update(-10.0, seconds(200.0));
  EXPECT_NEAR(-1000.0, joint.position(), 1e-9);
}

// A drive that comes back after a long gap does not make the angle jump.
TEST(JointPosition, RebaseKeepsTheAngle) {
  JointPosition joint;
  joint.update(1.0, seconds(0.01));
  joint.update(1.0, seconds(1.0));
  joint.rebase();
  EXPECT_EQ(0.0, joint.velocity());
  joint.update(5.0, seconds(60.0));
  EXPECT_NEAR(1.0, joint.position(), 1e-12);
}

// NaN never enters the angle.
TEST(JointPosition, IgnoresWhatIsNotFinite) {
  JointPosition joint;
  joint.update(1.0, seconds(1.0));
  joint.update(std::numeric_limits<double>::quiet_NaN(), seconds(1.0));
  joint.update(std::numeric_limits<double>::infinity(), seconds(1.0));
  joint.update(1.0, seconds(1.0));
  EXPECT_NEAR(1.0, joint.position(), 1e-12);
}

}  // namespace
}  // namespace nord_driver::robot
