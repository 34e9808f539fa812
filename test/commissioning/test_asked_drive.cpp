#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "commissioning/asked_drive.h"
#include "config/driver_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver::commissioning {
namespace {

// Two wheels of 0.1 m, 0.5 m apart.
constexpr char kRobot[] =
    "{cycle_rate: 50, left_wheel: l, right_wheel: r, wheel_separation: 0.5, wheel_radius: 0.1,"
    " linear/x: {has_velocity_limits: true, max_velocity: 0.7, min_velocity: -0.9},"
    " angular/z: {has_velocity_limits: true, max_velocity: 2.0},"
    " drives: {left: {series: sk5xxe, joint: l, gear_ratio: 20, pole_pairs: 2},"
    "  right: {series: sk2xxe, joint: r, gear_ratio: 40, pole_pairs: 2, allow_minimum_frequency: true, rated_current: "
    "3},"
    "  arm: {series: sk54xe, joint: a, gear_ratio: 10, pole_pairs: 3, max_velocity: 4, max_frequency: 70}}}";

std::vector<AskedDrive> asked(const std::string& text, bool looks_on = false) {
  const YamlSettings settings{"", YAML::Load(text)};
  const auto drives = readDriveList(settings);
  return askedDrives(cycle::readCycleConfig(settings, drives), std::vector<DriveIdentity>(drives.size()),
                     "nord_driver/profibus_dp", looks_on);
}

const AskedDrive& find(const std::vector<AskedDrive>& drives, const std::string& name) {
  for (const AskedDrive& drive : drives) {
    if (drive.name == name) return drive;
  }
  throw std::runtime_error(name);
}

TEST(AskedDrive, IsAskedForTheFastestOfItsBase) {
  const auto drives = asked(kRobot);
  const AskedDrive& left = find(drives, "left");
  EXPECT_TRUE(left.of_base);
  EXPECT_NEAR(0.9 / 0.1 * 20 * 2 / (2 * 3.14159265), left.top_frequency, 1e-3) << "backward is faster";
  EXPECT_EQ("linear/x/max_velocity", left.top_of);
  EXPECT_NEAR(2 * left.top_frequency, find(drives, "right").top_frequency, 1e-6);
  EXPECT_EQ("profibus_dp", left.transport);
  EXPECT_DOUBLE_EQ(0.02, left.period);
  EXPECT_TRUE(find(drives, "right").allows_minimum_frequency);
  EXPECT_EQ(3.0, find(drives, "right").rated_current);
}

TEST(AskedDrive, HasLimitsOfItsOwnOutsideABase) {
  const auto drives = asked(kRobot);
  const AskedDrive& arm = find(drives, "arm");
  EXPECT_FALSE(arm.of_base);
  EXPECT_NEAR(4.0 * 10 * 3 / (2 * 3.14159265), arm.top_frequency, 1e-3);
  EXPECT_EQ("drives/arm/max_velocity", arm.top_of);
  EXPECT_EQ(70.0, arm.typed_max_frequency);
}

// Its words are another master's: what they would send is asked of no drive.
TEST(AskedDrive, OfANodeThatLooksOnIsNotAskedForWhatItWouldSend) {
  const char* const text =
      "{drives: {lift: {series: sk5xxe, pole_pairs: 2, gear_ratio: 20, setpoints: {grip: {function: torque_limit, "
      "limit: 100}}}}}";
  EXPECT_FALSE(asked(text)[0].words.list.empty());
  EXPECT_TRUE(asked(text, true)[0].words.list.empty());
}

TEST(AskedDrive, CountsTheMotorUnlessConfiguredOtherwise) {
  const auto drives = asked(
      "{drives: {lift: {series: sk5xxe, pole_pairs: 2, gear_ratio: 20, mode: position},"
      " table: {series: sk5xxe, pole_pairs: 2, gear_ratio: 20, mode: position, position: {gear_ratio: 30}}}}");
  EXPECT_DOUBLE_EQ(1.0, find(drives, "lift").counted_per_motor_turn);
  EXPECT_DOUBLE_EQ(1.5, find(drives, "table").counted_per_motor_turn);
}

TEST(AskedDrive, MayHaveNoLimits) {
  const auto drives = asked("{drives: {arm: {series: sk54xe, pole_pairs: 3}}}");
  EXPECT_EQ(0.0, drives.at(0).top_frequency);
}

}  // namespace
}  // namespace nord_driver::commissioning
