// What the readers say of their keys, for documents: words, range and default of those that no other reader names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "cycle/cycle_config.h"
#include "cycle/noted_settings.h"

namespace nord_driver::cycle {
namespace {

using test::NotedSettings;
using ::testing::StartsWith;

/// A drive that has a key of each kind.
std::shared_ptr<NotedSettings> drive(const std::string& mode) {
  SettingValue values = SettingValue::group();
  values.add("series", SettingValue::ofText("sk5xxe"));
  values.add("pole_pairs", SettingValue::ofInteger(2, "2"));
  values.add("mode", SettingValue::ofText(mode));
  values.addAt("setpoints/grip/function", SettingValue::ofText("torque_limit"));
  values.addAt("signals/lamp/source", SettingValue::ofText("module_output_1"));
  return std::make_shared<NotedSettings>("~drives/lift/", values);
}

TEST(SettingNotes, OfADriveNameItsWords) {
  const auto lift = drive("velocity");
  readCycleConfig(NotedSettings{"~", SettingValue::group()}, {{"lift", lift}});
  EXPECT_EQ("a text", lift->note("follows"));
  EXPECT_THAT(lift->note("signals/lamp/source"), StartsWith("one of bus_in_bit_0 to 7, control_bit_8, "));
  EXPECT_EQ(
      "one of torque_limit, torque_switch_off_limit, current_limit, current_switch_off_limit, maximum_frequency, "
      "minimum_frequency, frequency_addition, frequency_subtraction, torque_precontrol",
      lift->note("setpoints/grip/function"))
      << "of every series";
}

TEST(SettingNotes, OfAPositionNameItsRange) {
  const auto lift = drive("position");
  readCycleConfig(NotedSettings{"~", SettingValue::group()}, {{"lift", lift}});
  EXPECT_EQ("a whole number; 16 to 32; 32", lift->note("position/bits"));
}

// Where nothing is typed the torque stays on at a command that has grown old, and never behind "disabled".
TEST(SettingNotes, OfTheStopsNameTheirUsualWay) {
  const NotedSettings node{"~", SettingValue::group()};
  readCycleConfig(node, {{"lift", drive("velocity")}});
  EXPECT_EQ("one of setpoint_zero, off1, quick_stop, coast; setpoint_zero", node.note("stop/command_timeout"));
  EXPECT_EQ("one of off1, quick_stop, coast; off1", node.note("stop/disable"));
  EXPECT_EQ("one of setpoint_zero, off1, quick_stop, coast; setpoint_zero", node.note("stop/drive_stopped"));
}

}  // namespace
}  // namespace nord_driver::cycle
