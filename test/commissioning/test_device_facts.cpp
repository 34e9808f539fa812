#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commissioning/checked_drive.h"
#include "commissioning/device_facts.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// As DeviceReader has read it of a drive that is as it should be.
cycle::DeviceData asRead(const AskedDrive& asked) {
  const bool decentral = asked.identity.timeout_owner == TimeoutOwner::kModule;
  cycle::DeviceData device;
  device.max_frequency.fill(50.0);
  device.min_frequency.fill(0.0);
  device.acceleration_time.fill(2.0);
  device.deceleration_time.fill(2.0);
  for (cycle::WordFunctions& words : device.word_functions) words.setpoints[0] = words.actual_values[0] = 1;
  device.word_functions[0] = {{1, 0, 0}, {1, 0, 0}};
  for (int i = 0; i < 8; ++i) device.bus_bit_functions.push_back(0);
  device.telegram_timeout = 0.0;
  if (decentral) {
    device.module_timeout = 0.0;
    device.option_monitoring = 1;
  }
  device.control_word_source = *busSelection({asked, knownOf(asked), {}, 1}).control_word;
  device.setpoint_source = 0;
  device.saves_in_eeprom = true;
  device.complete = true;
  return device;
}

std::vector<std::string> foundIn(const cycle::DeviceData& device, const AskedDrive& asked) {
  const catalogue::DriveCatalogue& known = knownOf(asked);
  return shortly(check({DriveUnderCheck{asked, known, deviceFacts(device, asked, known), 1}}));
}

TEST(DeviceFacts, ArePassedTheSameRules) {
  for (const Series series : profile::kAllSeries) {
    const AskedDrive asked = askedDrive(series);
    cycle::DeviceData device = asRead(asked);
    EXPECT_THAT(foundIn(device, asked), IsEmpty()) << profile::toString(series);
    device.control_word_source = 1;
    device.min_frequency[2] = 2.5;
    device.bus_bit_functions[1] = 2;
    device.saves_in_eeprom = false;
    device.telegram_timeout = -0.1;
    const std::vector<std::string> found = foundIn(device, asked);
    ASSERT_EQ(5u, found.size()) << profile::toString(series);
    EXPECT_EQ("bus_errors_heeded error P513 -> 0", found[1]);
    EXPECT_EQ("minimum_zero warning P104 set 3 -> 0", found[2]);
    EXPECT_EQ("bus_bits warning P480[-02] -> 0", found[3]);
    EXPECT_EQ("writes_saved warning P560 -> 1", found[4]);
  }
}

TEST(DeviceFacts, KeepFunctionsInTheirPlaces) {
  for (const Series series : {Series::kSk5xxe, Series::kSk54xe}) {
    const AskedDrive asked = askedDrive(series);
    cycle::DeviceData device = asRead(asked);
    device.word_functions[0].setpoints[2] = 2;
    const bool array = series == Series::kSk54xe;
    EXPECT_THAT(foundIn(device, asked), ElementsAre(array ? "further_setpoints error P546[-03] set 1 -> 0"
                                                          : "further_setpoints error P548 set 1 -> 0"));
  }
}

// Of the set in force; without them, as of a drive that refuses to tell them, there is nothing to be found.
TEST(DeviceFacts, HaveTheGearOfTheCount) {
  AskedDrive asked = askedDrive(Series::kSk5xxe);
  asked.words.words = 3;
  cycle::addPositionNeeds(cycle::PositionSetup{}, asked.series, asked.words);
  cycle::DeviceData device = asRead(asked);
  device.word_functions[0] = {{1, 23, 24}, {1, 10, 15}};
  device.position_control.fill(1);
  EXPECT_THAT(foundIn(device, asked), IsEmpty());
  device.speed_ratio = {3, 1, 1, 1};
  EXPECT_THAT(foundIn(device, asked), IsEmpty()) << "one of the two alone";
  device.reduction = {2, 1, 1, 1};
  EXPECT_THAT(foundIn(device, asked), ElementsAre("position_gear warning P607 set 1"));
}

// Of one that is to follow velocities as well; what was not told is nobody's finding.
TEST(DeviceFacts, HaveThePositionControl) {
  const AskedDrive asked = askedDrive(Series::kSk5xxe);
  cycle::DeviceData device = asRead(asked);
  device.position_control = {1, std::nullopt, 0, 2};
  EXPECT_THAT(foundIn(device, asked),
              ElementsAre("position_control error P600 set 1 -> 0", "position_control warning P600 set 4 -> 0"));
}

TEST(DeviceFacts, TellWhatIsMissing) {
  const AskedDrive asked = askedDrive(Series::kSk5xxe);
  cycle::DeviceData device = asRead(asked);
  device.max_frequency.fill(std::nullopt);
  for (cycle::WordFunctions& words : device.word_functions) words.setpoints[0] = cycle::kUnknownFunction;
  EXPECT_THAT(foundIn(device, asked), ElementsAre("readable warning P105 set 1", "readable warning P546 set 1"));
}

TEST(DeviceFacts, AreNoneBeforeEverythingWasAskedFor) {
  const AskedDrive asked = askedDrive(Series::kSk5xxe);
  EXPECT_THAT(foundIn({}, asked), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::commissioning
