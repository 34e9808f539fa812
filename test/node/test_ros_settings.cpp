// Parameters of the server as settings: kinds, nested keys, and keys nobody knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "node/parameters.h"
#include "node/ros_settings.h"

namespace nord_driver::node {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using XmlRpc::XmlRpcValue;

template <typename Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

RosSettings oneKey(const XmlRpcValue& key) {
  XmlRpcValue value;
  value["key"] = key;
  return RosSettings{"~bus", value};
}

// rosparam makes an integer of "1": where a number is expected it is one.
TEST(RosSettingsTest, WholeNumbersAreNumbersToo) {
  EXPECT_DOUBLE_EQ(2.0, oneKey(2).number("key").value());
  EXPECT_DOUBLE_EQ(0.5, oneKey(0.5).number("key").value());
  EXPECT_EQ(2, oneKey(2).integer("key").value());
  EXPECT_EQ(2, oneKey(2.0).integer("key").value()) << "written as 2.0";
}

TEST(RosSettingsTest, WhatIsNoWholeNumberIsRefused) {
  EXPECT_THAT(refusal([] { oneKey(2.5).integer("key"); }),
              AllOf(StartsWith("~bus/key: 2.5"), EndsWith(" is not valid, expected a whole number")));
  for (const double value : {2.5, 1e300, -1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN(), 9223372036854775808.0}) {
    EXPECT_NE("accepted", refusal([&] { oneKey(value).integer("key"); })) << value;
  }
}

TEST(RosSettingsTest, AnotherKindIsRefusedWithKeyValueAndExpectation) {
  const XmlRpcValue text{"yes"};
  EXPECT_EQ("~bus/key: \"yes\" is not valid, expected a number", refusal([&] { oneKey(text).number("key"); }));
  EXPECT_EQ("~bus/key: \"yes\" is not valid, expected a whole number", refusal([&] { oneKey(text).integer("key"); }));
  EXPECT_EQ("~bus/key: \"yes\" is not valid, expected true or false", refusal([&] { oneKey(text).boolean("key"); }));
  EXPECT_EQ("~bus/key: 1 is not valid, expected true or false", refusal([] { oneKey(1).boolean("key"); }));
  EXPECT_EQ("~bus/key: true is not valid, expected a text", refusal([] { oneKey(true).text("key"); }));
  EXPECT_EQ("~bus/key: a list is not valid, expected a number", refusal([] {
              oneKey(listOf<int>({1, 2})).number("key");
            }));
  EXPECT_EQ("~bus/key: \"yes\" is not valid, expected a list of numbers",
            refusal([&] { oneKey(text).numbers("key"); }));
  EXPECT_EQ("~bus/key: 3 is not valid, expected a list of texts",
            refusal([] { oneKey(listOf<int>({3})).texts("key"); }));
  EXPECT_EQ("~bus/key: \"yes\" is not valid, expected a group of keys and values",
            refusal([&] { oneKey(text).group("key"); }));
}

TEST(RosSettingsTest, ReadsEveryKind) {
  EXPECT_TRUE(oneKey(true).boolean("key").value());
  EXPECT_EQ("sk5xxe", oneKey(std::string{"sk5xxe"}).text("key").value());
  EXPECT_THAT(oneKey(listOf<std::string>({"a", "b"})).texts("key").value(), ElementsAre("a", "b"));
  EXPECT_THAT(oneKey(std::string{"a"}).texts("key").value(), ElementsAre("a")) << "one is a list of one";
  EXPECT_THAT(oneKey(listOf<double>({0.5, 1.0})).numbers("key").value(), ElementsAre(0.5, 1.0));
  EXPECT_THAT(oneKey(listOf<int>({1, 2})).numbers("key").value(), ElementsAre(1.0, 2.0));
}

TEST(RosSettingsTest, WhatIsAbsentIsNothing) {
  for (const RosSettings& settings : {oneKey(1), RosSettings{"~bus", XmlRpcValue{}}}) {
    EXPECT_FALSE(settings.has("other"));
    EXPECT_FALSE(settings.number("other").has_value());
    EXPECT_FALSE(settings.integer("other").has_value());
    EXPECT_FALSE(settings.boolean("other").has_value());
    EXPECT_FALSE(settings.text("other").has_value());
    EXPECT_FALSE(settings.texts("other").has_value());
    EXPECT_FALSE(settings.numbers("other").has_value());
    EXPECT_THAT(settings.group("other")->keys(), IsEmpty());
  }
}

TEST(RosSettingsTest, KeysMayLieInGroups) {
  XmlRpcValue value;
  value["linear"]["x"]["max_velocity"] = 1.5;
  const RosSettings settings{"~", value};
  EXPECT_TRUE(settings.has("linear/x/max_velocity"));
  EXPECT_DOUBLE_EQ(1.5, settings.number("linear/x/max_velocity").value());
  EXPECT_FALSE(settings.has("linear/y/max_velocity"));
  EXPECT_THROW(settings.has("linear/x/max_velocity/deeper"), ConfigError) << "a value where a group belongs";
  EXPECT_DOUBLE_EQ(1.5, settings.group("linear")->group("x")->number("max_velocity").value());
}

TEST(RosSettingsTest, NamesAreThoseTheUserWrote) {
  XmlRpcValue value;
  value["drives"]["left"]["address"] = 3;
  const RosSettings settings{"~", value};
  EXPECT_EQ("~cycle_rate", settings.fullName("cycle_rate"));
  EXPECT_EQ("~drives/left/address", settings.group("drives")->group("left")->fullName("address"));
  EXPECT_EQ("~drives/left", settings.group("drives")->group("left")->fullName("")) << "the group itself";
}

// A key with a slip of the pen does nothing, and must not do so in silence.
TEST(RosSettingsTest, UnknownKeysAreNamedWithTheNearestKnownOne) {
  XmlRpcValue value;
  value["cycle_rat"] = 50;
  value["colour_of_the_cable"] = std::string{"violet"};
  value["linear"]["x"]["max_velocty"] = 1.0;
  const RosSettings settings{"~", value};
  settings.number("cycle_rate");
  settings.number("linear/x/max_velocity");
  EXPECT_THAT(settings.unknownKeys(),
              ElementsAre("~colour_of_the_cable is not known and is ignored",
                          "~cycle_rat is not known and is ignored; did you mean ~cycle_rate?",
                          "~linear/x/max_velocty is not known and is ignored; did you mean ~linear/x/max_velocity?"));
}

// Parameters outlive the node that had them: the next one finds what it does not know.
TEST(RosSettingsTest, AnUnknownKeyOfANodeMayBeLeftOver) {
  XmlRpcValue value;
  value["cycle_rat"] = 50;
  value["bus"]["interfac"] = std::string{"can0"};
  const RosSettings settings{"~", value};
  settings.number("cycle_rate");
  const auto bus = settings.group("bus");
  EXPECT_THAT(settings.unknownKeys("/nord_driver"),
              ElementsAre("~cycle_rat is not known and is ignored; did you mean ~cycle_rate? Left over from an earlier "
                          "start? rosparam delete /nord_driver/cycle_rat"));
  EXPECT_THAT(bus->unknownKeys("/robot/nord_driver"),
              ElementsAre("~bus/interfac is not known and is ignored; left over from an earlier start? rosparam delete "
                          "/robot/nord_driver/bus/interfac"));
}

TEST(RosSettingsTest, KeysThatWereAskedForOrHandedOutAreKnown) {
  XmlRpcValue value;
  value["a"] = 1;
  value["type"] = std::string{"diff_drive_controller/DiffDriveController"};
  value["bus"]["anything"] = 1;
  const RosSettings settings{"~", value};
  settings.has("a");
  settings.accept("type");
  const auto bus = settings.group("bus");
  EXPECT_THAT(settings.unknownKeys(), IsEmpty());
  EXPECT_THAT(bus->unknownKeys(), ElementsAre("~bus/anything is not known and is ignored"));
}

}  // namespace
}  // namespace nord_driver::node
