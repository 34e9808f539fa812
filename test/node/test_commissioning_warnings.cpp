// What the node tells of the parameters that the bus cycle has read of its drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "catalogue/shipped.h"
#include "config/driver_settings.h"
#include "config/yaml_settings.h"
#include "node/commissioning_warnings.h"

namespace nord_driver::node {
namespace {

using profile::Series;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

cycle::DeviceData asItShouldBe() {
  cycle::DeviceData device;
  device.max_frequency.fill(50.0);
  device.min_frequency.fill(0.0);
  device.acceleration_time.fill(2.0);
  device.deceleration_time.fill(2.0);
  for (cycle::WordFunctions& words : device.word_functions) words.setpoints[0] = words.actual_values[0] = 1;
  for (int i = 0; i < 12; ++i) device.bus_bit_functions.push_back(0);
  device.telegram_timeout = 0.0;
  device.control_word_source = 4;
  device.setpoint_source = 0;
  device.saves_in_eeprom = true;
  device.complete = true;
  return device;
}

/// Two SK 5xxE of a base on PROFIBUS.
class CommissioningWarningsTest : public ::testing::Test {
 protected:
  CommissioningWarningsTest() : snapshot_(2) {
    const YamlSettings settings{
        "",
        YAML::Load("{left_wheel: l, right_wheel: r, wheel_separation: 0.5, wheel_radius: 0.1, transport: profibus_dp,"
                   " drives: {left: {series: sk5xxe, joint: l, gear_ratio: 20, pole_pairs: 2},"
                   "  right: {series: sk5xxe, joint: r, gear_ratio: 20, pole_pairs: 2}}}")};
    NodeConfig config;
    config.transport = "nord_driver/profibus_dp";
    config.cycle = cycle::readCycleConfig(settings, readDriveList(settings));
    DriveIdentity identity;
    identity.protected_by = "the bus";
    const auto known = catalogue::driveCatalogue(catalogue::shippedCatalogues(), Series::kSk5xxe, "profibus_dp", false);
    warnings_.emplace(config, std::vector<DriveIdentity>{identity, identity},
                      std::vector<catalogue::DriveCatalogue>{known, known});
    for (cycle::DriveSnapshot& drive : snapshot_.drives) {
      drive.device = asItShouldBe();
      drive.parameter_set = 1;
    }
  }
  cycle::DeviceData& left() { return snapshot_.drives[0].device; }
  std::vector<LogLine> update() { return warnings_->update(snapshot_); }
  const std::vector<std::string>& ofLeft() { return warnings_->of(0).warnings; }

  cycle::CycleSnapshot snapshot_;
  std::optional<CommissioningWarnings> warnings_;
};

TEST_F(CommissioningWarningsTest, OfDrivesThatAreRightThereAreNone) {
  EXPECT_THAT(update(), IsEmpty());
  EXPECT_THAT(ofLeft(), IsEmpty());
}

// In the log once, in /diagnostics as long as it stands.
TEST_F(CommissioningWarningsTest, AreLoggedOnce) {
  left().control_word_source = 0;
  const std::vector<LogLine> news = update();
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(LogLine::Level::kWarn, news[0].level);
  EXPECT_THAT(news[0].text,
              AllOf(StartsWith("drive left: P509 Source control word = 0 Control terminals or keyboard: "),
                    HasSubstr("set it to 4 PROFIBUS")));
  EXPECT_THAT(update(), IsEmpty());
  EXPECT_THAT(ofLeft(), SizeIs(1));
  EXPECT_THAT(warnings_->of(1).warnings, IsEmpty());
  left().control_word_source = 4;
  update();
  EXPECT_THAT(ofLeft(), IsEmpty());
  left().control_word_source = 0;
  EXPECT_THAT(update(), IsEmpty()) << "told before";
  EXPECT_THAT(ofLeft(), SizeIs(1));
}

TEST_F(CommissioningWarningsTest, WaitUntilEverythingHasBeenAskedFor) {
  left() = {};
  EXPECT_THAT(update(), IsEmpty());
  left().complete = true;
  const std::vector<LogLine> news = update();
  ASSERT_THAT(news, SizeIs(1)) << "what cannot be read is one sentence";
  EXPECT_THAT(news[0].text,
              AllOf(HasSubstr("P105 set 1"), HasSubstr("P104 set 1"), HasSubstr("P543 set 1"), HasSubstr("P546 set 1"),
                    HasSubstr("could not be read; look at the inverter itself"), Not(HasSubstr("P513"))));
}

TEST_F(CommissioningWarningsTest, LeaveProtectionToWhoKnowsMore) {
  left().telegram_timeout = -0.1;
  EXPECT_THAT(update(), IsEmpty());
}

TEST_F(CommissioningWarningsTest, LookAtSetsFunctionsAndBits) {
  left().min_frequency[2] = 2.5;
  left().word_functions[1].actual_values[0] = 3;
  left().bus_bit_functions[10] = 2;
  update();
  EXPECT_THAT(ofLeft(), ElementsAre(HasSubstr("P543 set 2 Bus actual value 1 = 3 Current"),
                                    HasSubstr("P104 set 3 Minimum frequency = 2.5 Hz"),
                                    HasSubstr("P480[-11] Function of bus I/O in bits")));
}

TEST_F(CommissioningWarningsTest, CompareTheDrivesOfTheBase) {
  snapshot_.drives[1].device.deceleration_time[0] = 3.0;
  update();
  EXPECT_THAT(ofLeft(), IsEmpty());
  EXPECT_THAT(warnings_->of(1).warnings, ElementsAre(HasSubstr("P103 set 1 Deceleration time = 3.00 s")));
}

TEST_F(CommissioningWarningsTest, KeepNotesApart) {
  for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.parameter_set = 2;
  const std::vector<LogLine> news = update();
  ASSERT_THAT(news, SizeIs(2));
  EXPECT_EQ(LogLine::Level::kInfo, news[0].level);
  EXPECT_THAT(ofLeft(), IsEmpty());
  EXPECT_THAT(warnings_->of(0).notes, ElementsAre(HasSubstr("parameter set = 2")));
}

// Another sentence tells that the driver itself has set it and not yet put back.
TEST_F(CommissioningWarningsTest, KnowWhenP560IsTheDriversOwnDoing) {
  left().saves_in_eeprom = false;
  snapshot_.drives[0].owes_eeprom_switch = true;
  EXPECT_THAT(update(), IsEmpty());
  snapshot_.drives[0].owes_eeprom_switch = false;
  EXPECT_THAT(update(), SizeIs(1));
}

}  // namespace
}  // namespace nord_driver::node
