// What every drive's configuration says: the defaults, and refusals that name key, value and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/drive_common.h"
#include "support/map_settings.h"

namespace nord_driver {
namespace {

using test::MapSettings;
using ::testing::HasSubstr;

struct Configured {
  DriveSettings source() const { return {"left", settings}; }
  DriveCommon read() const { return readDriveCommon(source()); }
  template <typename Action>
  static std::string refusal(Action action) {
    try {
      action();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::shared_ptr<MapSettings> settings = std::make_shared<MapSettings>(
      "~drives/left/", std::map<std::string, MapSettings::Value>{{"series", std::string{"sk2xxe"}}, {"pole_pairs", 3}});
};

TEST(DriveCommon, HasItsDefaults) {
  const DriveCommon drive = Configured{}.read();
  EXPECT_EQ("left", drive.name);
  EXPECT_EQ("", drive.joint);
  EXPECT_EQ(profile::Series::kSk2xxe, drive.series);
  EXPECT_DOUBLE_EQ(1.0, drive.scaling.gear_ratio);
  EXPECT_EQ(3, drive.scaling.pole_pairs);
  EXPECT_FALSE(drive.scaling.inverted);
  EXPECT_FALSE(drive.typed_max_frequency.has_value());
  EXPECT_FALSE(drive.rated_current.has_value());
  EXPECT_FALSE(drive.allow_minimum_frequency);
  EXPECT_FALSE(drive.address.has_value());
  EXPECT_EQ(1, drive.inverter);
}

TEST(DriveCommon, ReadsEveryKey) {
  Configured robot;
  robot.settings->set("joint", "left_wheel_joint").set("gear_ratio", 20.5).set("inverted", true);
  robot.settings->set("max_frequency", 70).set("rated_current", 2.5).set("allow_minimum_frequency", true);
  robot.settings->set("address", 12).set("inverter", 4);
  const DriveCommon drive = robot.read();
  EXPECT_EQ("left_wheel_joint", drive.joint);
  EXPECT_DOUBLE_EQ(20.5, drive.scaling.gear_ratio);
  EXPECT_TRUE(drive.scaling.inverted);
  EXPECT_EQ(Hertz{70.0}, drive.typed_max_frequency);
  EXPECT_EQ(2.5, drive.rated_current);
  EXPECT_TRUE(drive.allow_minimum_frequency);
  EXPECT_EQ(12, drive.address);
  EXPECT_EQ(4, drive.inverter);
}

struct Wrong {
  std::string key;
  MapSettings::Value value;
  std::string sentence;
};

class WrongDriveCommon : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongDriveCommon, IsRefused) {
  Configured robot;
  robot.settings->set(GetParam().key, GetParam().value);
  EXPECT_THAT(Configured::refusal([&] { robot.read(); }),
              HasSubstr("~drives/left/" + GetParam().key + GetParam().sentence));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongDriveCommon,
    ::testing::Values(Wrong{"series", std::string{"sk999"}, ": \"sk999\" is not valid, expected one of sk1x0e, sk2xxe"},
                      Wrong{"pole_pairs", 65, ": 65 is not valid, expected a whole number from 1 to 64"},
                      Wrong{"gear_ratio", 0.0, ": 0 is not valid, expected a number from 0.001 to 100000"},
                      Wrong{"max_frequency", 401, ": 401 is not valid, expected a number from 0.1 to 400 Hz"},
                      Wrong{"rated_current", -1.0, ": -1 is not valid, expected a number from 0.01 to 10000 A"},
                      Wrong{"inverter", 5, ": 5 is not valid, expected a whole number from 1 to 4"},
                      Wrong{"address", std::string{"three"}, " is not valid, expected a whole number"}));

TEST(DriveCommon, SeriesAndPolePairsMustBeThere) {
  for (const char* key : {"series", "pole_pairs"}) {
    Configured robot;
    robot.settings->erase(key);
    EXPECT_THAT(Configured::refusal([&] { robot.read(); }), HasSubstr(std::string{key} + " is missing: expected"));
  }
}

// The range is the bus's.
TEST(DriveCommon, AnAddressIsAskedForByTheBus) {
  Configured robot;
  EXPECT_THAT(Configured::refusal([&] { requiredAddress(robot.source(), 3, 125); }),
              HasSubstr("~drives/left/address is missing: expected a whole number from 3 to 125"));
  robot.settings->set("address", 126);
  EXPECT_THAT(Configured::refusal([&] { requiredAddress(robot.source(), 3, 125); }),
              HasSubstr("~drives/left/address: 126 is not valid, expected a whole number from 3 to 125"));
  EXPECT_EQ(126, requiredAddress(robot.source(), 1, 127));
}

}  // namespace
}  // namespace nord_driver
