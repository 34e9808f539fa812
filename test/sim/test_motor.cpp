#include <gtest/gtest.h>

#include "nord_driver/sim/diff_drive_body.h"
#include "nord_driver/sim/motor.h"

namespace nord_driver::sim {
namespace {

constexpr double kPi = 3.141592653589793;

// At a steady load the rotor stays behind the field by the slip that load needs.
TEST(Motor, SlipFollowsTheLoad) {
  MotorSettings settings;
  settings.load = 0.5;
  settings.viscous = 0.0;
  Motor motor{settings};
  for (int i = 0; i < 5000; ++i) motor.advance(0.001, true, 25.0);
  EXPECT_NEAR(25.0 - 0.5 * settings.slip, motor.rotorFrequency(), 1e-3);
  EXPECT_NEAR(0.5, motor.torqueShare(), 1e-3);
}

// Without voltage only friction acts: the shaft coasts for load torque / inertia and then stands still for good.
TEST(Motor, CoastsAndStops) {
  MotorSettings settings;
  settings.viscous = 0.0;  // 0.1 Nm at 0.01 kg m2: 10 rad/s less every second
  Motor motor{settings};
  for (int i = 0; i < 5000; ++i) motor.advance(0.001, true, 25.0);
  const double speed = motor.speed();
  for (int i = 0; i < 1000; ++i) motor.advance(0.001, false, 0.0);
  EXPECT_NEAR(speed - 10.0, motor.speed(), 0.01);
  for (int i = 0; i < 20000; ++i) motor.advance(0.001, false, 0.0);
  EXPECT_EQ(0.0, motor.speed());
}

// The result does not depend on the step.
TEST(Motor, StepSizeDoesNotMatter) {
  Motor fine{MotorSettings{}};
  Motor coarse{MotorSettings{}};
  for (int i = 0; i < 30000; ++i) fine.advance(0.0001, true, 10.0);
  for (int i = 0; i < 3000; ++i) coarse.advance(0.001, true, 10.0);
  EXPECT_NEAR(fine.angle(), coarse.angle(), 0.2);
  EXPECT_NEAR(fine.speed(), coarse.speed(), 1e-6);
}

// Equal wheels go straight, unequal ones turn about the middle of the axle.
TEST(DiffDriveBody, IntegratesThePose) {
  DiffDriveBody body{0.1, 0.5};
  body.moveTo(5.0, 5.0);
  for (int i = 1; i <= 100; ++i) body.moveTo(5.0 + 0.1 * i, 5.0 + 0.1 * i);
  EXPECT_NEAR(1.0, body.pose().x, 1e-12);
  EXPECT_NEAR(0.0, body.pose().y, 1e-12);
  const double quarter = kPi / 2 * 0.25 / 0.1;  // wheel angle for 90 degrees on the spot
  for (int i = 1; i <= 100; ++i) body.moveTo(15.0 - quarter * i / 100, 15.0 + quarter * i / 100);
  EXPECT_NEAR(kPi / 2, body.pose().theta, 1e-9);
  EXPECT_NEAR(1.0, body.pose().x, 1e-9);
  body.setSpeeds(2.0, 4.0);
  EXPECT_DOUBLE_EQ(0.3, body.linear());
  EXPECT_DOUBLE_EQ(0.4, body.angular());
}

}  // namespace
}  // namespace nord_driver::sim
