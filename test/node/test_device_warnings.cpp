// What a drive's parameters let its motor do beside the commands, in sentences for /diagnostics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/device_warnings.h"

namespace nord_driver::node {
namespace {

using profile::Series;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

cycle::DeviceData asDelivered() {
  cycle::DeviceData device;
  for (std::size_t set = 0; set < 4; ++set) {
    device.min_frequency[set] = 0.0;
    device.actual_value_1_function[set] = device.setpoint_1_function[set] = std::uint16_t{1};
  }
  for (int i = 0; i < 12; ++i) device.bus_bit_functions.push_back(0);
  device.complete = true;
  return device;
}

TEST(DeviceWarnings, ADriveAsDeliveredHasNone) {
  EXPECT_THAT(deviceWarnings(asDelivered(), Series::kSk5xxe), IsEmpty());
}

TEST(DeviceWarnings, TellAMinimumFrequencyOfEachSet) {
  cycle::DeviceData device = asDelivered();
  device.min_frequency[2] = 2.5;
  EXPECT_THAT(deviceWarnings(device, Series::kSk5xxe),
              ElementsAre(AllOf(HasSubstr("P104 of parameter set 3 is 2.5 Hz"), HasSubstr("set it to 0"))));
}

TEST(DeviceWarnings, TellAFunctionThatIsNotTheFrequency) {
  cycle::DeviceData device = asDelivered();
  device.actual_value_1_function[1] = std::uint16_t{3};
  device.setpoint_1_function[3] = std::uint16_t{2};
  EXPECT_THAT(deviceWarnings(device, Series::kSk5xxe),
              ElementsAre(HasSubstr("P543 of parameter set 2 is 3, so that actual value 1 is not the frequency"),
                          HasSubstr("P546 of parameter set 4 is 2, so that setpoint 1 is not the frequency")));
  EXPECT_THAT(deviceWarnings(device, Series::kSk2xxe),
              ElementsAre(HasSubstr("P543 [-01] of"), HasSubstr("P546 [-01] of")));
}

// SK 2xxE has them from the factory (BU 0280 5.1.2).
TEST(DeviceWarnings, TellBusBitsThatStartTheMotor) {
  cycle::DeviceData device = asDelivered();
  device.bus_bit_functions[0] = 1;
  device.bus_bit_functions[2] = 5;
  device.bus_bit_functions[10] = 2;
  EXPECT_THAT(deviceWarnings(device, Series::kSk2xxe),
              ElementsAre(HasSubstr("P480 [-01] = 1 (enable right): a bus I/O bit can start the motor"),
                          HasSubstr("P480 [-11] = 2 (enable left)")));
}

TEST(DeviceWarnings, TellWhatCouldNotBeRead) {
  cycle::DeviceData device;
  EXPECT_THAT(deviceWarnings(device, Series::kSk5xxe), IsEmpty()) << "nothing has been asked for yet";
  device.complete = true;
  EXPECT_THAT(
      deviceWarnings(device, Series::kSk5xxe),
      ElementsAre(AllOf(HasSubstr("could not be read"), HasSubstr("P104"), HasSubstr("P543"), HasSubstr("P546"))));
}

}  // namespace
}  // namespace nord_driver::node
