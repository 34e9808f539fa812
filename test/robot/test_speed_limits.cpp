#include <gtest/gtest.h>

#include <limits>

#include "robot/speed_limits.h"

namespace nord_driver::robot {
namespace {

SpeedLimits all() {
  SpeedLimits limits;
  limits.has_velocity_limits = limits.has_acceleration_limits = limits.has_jerk_limits = true;
  limits.max_velocity = 1.0;
  limits.max_acceleration = 2.0;
  limits.max_jerk = 3.0;
  return limits;
}

// diff_drive_controller: min_ is -max_ where it is not given.
TEST(SpeedLimits, MinimumIsTheNegativeMaximumByDefault) {
  SpeedLimits limits = all();
  EXPECT_EQ(-1.0, limits.minVelocity());
  EXPECT_EQ(-2.0, limits.minAcceleration());
  EXPECT_EQ(-3.0, limits.minJerk());
  limits.min_velocity = -0.25;
  limits.min_acceleration = -0.5;
  limits.min_jerk = -0.75;
  EXPECT_EQ(-0.25, limits.minVelocity());
  EXPECT_EQ(-0.5, limits.minAcceleration());
  EXPECT_EQ(-0.75, limits.minJerk());
}

// Possible limits are accepted; a group that is off is not looked at.
TEST(SpeedLimits, AcceptsPossibleLimits) {
  EXPECT_EQ("", problemOf(all(), "linear/x"));
  EXPECT_EQ("", problemOf(SpeedLimits{}, "linear/x"));
  SpeedLimits no_reversing = all();
  no_reversing.min_velocity = 0.0;
  EXPECT_EQ("", problemOf(no_reversing, "linear/x"));
  SpeedLimits off;
  off.max_velocity = -1.0;
  off.max_acceleration = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ("", problemOf(off, "linear/x"));
}

// Every impossible one is named with its key, its value and what was expected.
TEST(SpeedLimits, NamesTheWrongKey) {
  const auto with = [](auto change) {
    SpeedLimits limits = all();
    change(limits);
    return problemOf(limits, "angular/z");
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ("angular/z/max_velocity is -1, expected a finite number not less than 0",
            with([](SpeedLimits& l) { l.max_velocity = -1.0; }));
  EXPECT_EQ("angular/z/max_velocity is 0, expected a number greater than 0 while has_velocity_limits is true",
            with([](SpeedLimits& l) { l.max_velocity = 0.0; }));
  EXPECT_EQ("angular/z/min_velocity is 0.5, expected a finite number not greater than 0",
            with([](SpeedLimits& l) { l.min_velocity = 0.5; }));
  EXPECT_EQ("angular/z/max_acceleration is 0, expected a finite number greater than 0",
            with([](SpeedLimits& l) { l.max_acceleration = 0.0; }));
  EXPECT_EQ("angular/z/min_acceleration is 0, expected a finite number less than 0",
            with([](SpeedLimits& l) { l.min_acceleration = 0.0; }));
  EXPECT_EQ("angular/z/max_jerk is nan, expected a finite number greater than 0",
            with([](SpeedLimits& l) { l.max_jerk = kNan; }));
  EXPECT_EQ("angular/z/min_jerk is 1, expected a finite number less than 0",
            with([](SpeedLimits& l) { l.min_jerk = 1.0; }));
}

}  // namespace
}  // namespace nord_driver::robot
