// What DriveStatus tells of a drive that is there, and of one that is gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "node/drive_status.h"

namespace nord_driver::node {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

class DriveStatusTest : public ::testing::Test {
 protected:
  DriveStatusTest() {
    sample.online = true;
    sample.state = profile::DriveState::kOperationEnabled;
    sample.parameter_set = 1;
    sample.input.status_word = 0x3FB7;  // every bit but those of faults, "switch-on disabled" and the set
    sample.input.actual_values = {0x2000, 300, 7};
    sample.output.control_word = 0x047F;
    sample.output.setpoints = {0x2000};
    sample.velocity_command = 3.9;
    sample.velocity = 3.9;
    sample.frequency = 25.0;
    fillDriveStatus(sample, faults, status);
  }
  /// As the cycle leaves it: what was received last stays there.
  void vanish() {
    sample.online = false;
    sample.state = profile::DriveState::kUnknown;
    sample.parameter_set = 0;
    sample.output.control_word = 0x047E;
    sample.velocity_command = sample.velocity = sample.frequency = 0.0;
    fillDriveStatus(sample, faults, status);
  }
  std::vector<bool> bits() const {
    return {status.ready_to_switch_on != 0,
            status.switched_on != 0,
            status.operation_enabled != 0,
            status.fault != 0,
            status.voltage_enabled != 0,
            status.quick_stop_inactive != 0,
            status.switch_on_disabled != 0,
            status.warning != 0,
            status.setpoint_reached != 0,
            status.bus_control != 0,
            status.bit_10 != 0,
            status.direction_right != 0,
            status.direction_left != 0,
            status.bit_13 != 0};
  }
  catalogue::FaultWords faults{catalogue::shippedFaults(), profile::Series::kSk5xxe};
  cycle::DriveSnapshot sample;
  DriveStatus status;
};

// The words of the series: E10.3 is something else in an SK 700E.
TEST_F(DriveStatusTest, AFaultIsNamedInTheWordsOfTheSeries) {
  EXPECT_EQ("", status.fault_text);
  sample.fault_number = 103;
  fillDriveStatus(sample, faults, status);
  EXPECT_EQ("timeout by P151 or P513", status.fault_text);
  fillDriveStatus(sample, {catalogue::shippedFaults(), profile::Series::kSk700e}, status);
  EXPECT_EQ("system error of the option (10.3)", status.fault_text);
  sample.fault_number = 0;
  fillDriveStatus(sample, faults, status);
  EXPECT_EQ("", status.fault_text);
}

TEST_F(DriveStatusTest, OnlineItTellsBitsAndValues) {
  EXPECT_TRUE(status.online);
  EXPECT_EQ(DriveStatus::OPERATION_ENABLED, status.state);
  EXPECT_EQ("operation enabled", status.state_text);
  EXPECT_TRUE(status.operation_enabled && status.bus_control && status.setpoint_reached && status.direction_left);
  EXPECT_FALSE(status.fault || status.switch_on_disabled);
  EXPECT_EQ(0x2000, status.actual_values.at(0));
  EXPECT_EQ(1, status.parameter_set);
}

TEST_F(DriveStatusTest, OfflineNothingIsToldAsIfItWereSoNow) {
  const auto values = status.actual_values.size();
  vanish();
  EXPECT_FALSE(status.online);
  EXPECT_EQ(DriveStatus::UNKNOWN, status.state);
  EXPECT_EQ("unknown", status.state_text);
  EXPECT_THAT(bits(), Each(false));
  EXPECT_THAT(status.actual_values, SizeIs(values)) << "whoever reads the first needs no test";
  EXPECT_THAT(status.actual_values, Each(0));
  EXPECT_EQ(0x3FB7, status.status_word) << "as received last";
  EXPECT_EQ(0x047E, status.control_word) << "as sent now";
  EXPECT_EQ(0, status.parameter_set);
  EXPECT_EQ(0.0, status.velocity);
}

// The cleared bit of a drive that vanished with its fault must not hide that fault.
TEST_F(DriveStatusTest, AFaultIsHiddenByItsEndAndByTheEndOfTheDrive) {
  EXPECT_FALSE(hidesAFault(sample, 0));
  sample.faults = 1;
  sample.fault = true;
  EXPECT_FALSE(hidesAFault(sample, 0)) << "the message itself shows it";
  sample.online = false;
  EXPECT_TRUE(hidesAFault(sample, 0));
  EXPECT_FALSE(hidesAFault(sample, 1)) << "it was told";
  sample.online = true;
  sample.fault = false;
  EXPECT_TRUE(hidesAFault(sample, 0));
}

}  // namespace
}  // namespace nord_driver::node
