// Current and torque in SI units.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/measured_values.h"

namespace nord_driver::cycle {
namespace {

struct Measured {
  Measured() {
    setup.rated_current = 8.0;
    setup.drive.joint.gear_ratio = 20.0;
    sample.online = true;
    sample.parameter_set = 2;
    sample.input.actual_values = {0x1000, 0x2000, -0x1000};
    device.word_functions[1].actual_values = {1, 3, 4};
  }
  double current(std::uint8_t words = 3) {
    sample.words = words;
    return currentOf(sample, device, setup);
  }
  double effort() const { return effortOf(sample, device, setup); }

  DriveSetup setup;
  DriveSample sample;
  DeviceData device;
};

TEST(MeasuredValues, TheCurrentComesFromAnyWord) {
  Measured drive;
  EXPECT_DOUBLE_EQ(4.0, drive.current());
  EXPECT_TRUE(std::isnan(drive.current(1))) << "only one word is carried";
  drive.device.word_functions[1].actual_values = {1, 4, 3};
  EXPECT_DOUBLE_EQ(-2.0, drive.current());
  drive.device.word_functions[1].actual_values = {1, 4, 9};
  EXPECT_TRUE(std::isnan(drive.current())) << "torque current is no current";
  drive.device.word_functions[1].actual_values = {1, 3, 4};
  drive.setup.rated_current.reset();
  EXPECT_TRUE(std::isnan(drive.current()));
}

// Sets 2 to 4 are read only where further words are in use.
TEST(MeasuredValues, TheFunctionsOfSet1StandForThoseNotRead) {
  Measured drive;
  drive.device.word_functions[1] = {};
  drive.device.word_functions[0].actual_values = {1, 3, kUnknownFunction};
  EXPECT_DOUBLE_EQ(4.0, drive.current());
}

// 25 % of 10 Nm at the motor, 20:1.
TEST(MeasuredValues, TheEffortNeedsTheTorqueOfP112) {
  Measured drive;
  EXPECT_TRUE(std::isnan(drive.effort()));
  drive.setup.words.torque_at_limit = 10.0;
  EXPECT_DOUBLE_EQ(-50.0, drive.effort());
  drive.setup.drive.joint.inverted = true;
  EXPECT_DOUBLE_EQ(50.0, drive.effort());
  drive.device.word_functions[1].actual_values = {1, 3, 9};
  EXPECT_TRUE(std::isnan(drive.effort()));
}

TEST(MeasuredValues, NothingIsKnownOfADriveThatIsOffline) {
  Measured drive;
  drive.setup.words.torque_at_limit = 10.0;
  drive.sample.online = false;
  EXPECT_TRUE(std::isnan(drive.current()));
  EXPECT_TRUE(std::isnan(drive.effort()));
}

// The set in force has its own functions, up to the fourth; where it is not known those of set 1 stand for them.
TEST(MeasuredValues, EachSetHasItsOwnFunctions) {
  Measured drive;
  drive.device.word_functions[0].actual_values = {3, 1, 1};
  drive.device.word_functions[3].actual_values = {1, 4, 3};
  drive.sample.parameter_set = 4;
  EXPECT_DOUBLE_EQ(-2.0, drive.current());
  EXPECT_DOUBLE_EQ(-2.0, drive.current(9)) << "no more than three words";
  for (const std::uint8_t none : {std::uint8_t{0}, std::uint8_t{5}}) {
    drive.sample.parameter_set = none;
    EXPECT_DOUBLE_EQ(2.0, drive.current()) << unsigned{none};
  }
}

}  // namespace
}  // namespace nord_driver::cycle
