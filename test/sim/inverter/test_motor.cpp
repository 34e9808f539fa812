#include <gtest/gtest.h>

#include "sim/inverter/motor.h"

namespace nord_driver::sim {
namespace {

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

// However little the slip is, the rotor keeps to its field, and does not run round it by what the torque can do in a step.
TEST(Motor, HardlyAnySlipIsHardlyAnyError) {
  MotorSettings settings;
  settings.slip = 1e-6;
  Motor motor{settings};
  for (int i = 0; i < 1000; ++i) motor.advance(0.001, true, 25.0);
  for (int i = 0; i < 1000; ++i) {
    motor.advance(0.001, true, 25.0);
    ASSERT_NEAR(25.0, motor.rotorFrequency(), 1e-5);
  }
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

}  // namespace
}  // namespace nord_driver::sim
