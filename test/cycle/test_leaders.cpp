// drives/<name>/follows, and what the drives themselves tell of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/leaders.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using test::MapSettings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Drives a, b and c; of each whom it follows, or nobody.
CycleConfig configured(const std::vector<std::string>& follows, bool all_drives = true) {
  std::vector<DriveSettings> drives;
  for (std::size_t i = 0; i < follows.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
    settings->set("series", "sk2xxe").set("pole_pairs", 2).set("address", 3 + static_cast<int>(i));
    if (!follows[i].empty()) settings->set("follows", follows[i]);
    drives.push_back({name, settings});
  }
  return readCycleConfig(MapSettings{"~"}, drives, {}, all_drives);
}

std::string errorOf(const std::vector<std::string>& follows) {
  try {
    configured(follows);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(Leaders, AreReadByName) {
  const CycleConfig config = configured({"", "a", "a"});
  EXPECT_FALSE(config.drives[0].leader);
  EXPECT_EQ(0u, config.drives[1].leader);
  EXPECT_THAT(followersOf(config, 0), ElementsAre(1u, 2u));
  EXPECT_THAT(followersOf(config, 1), IsEmpty());
}

TEST(Leaders, RefuseWhatCannotBe) {
  EXPECT_THAT(errorOf({"", "x"}),
              HasSubstr("drives/b/follows: \"x\" is not valid, expected one of the other drives: a"));
  EXPECT_THAT(errorOf({"a", ""}),
              HasSubstr("drives/a/follows: \"a\" is not valid, expected one of the other drives: b"));
  EXPECT_THAT(errorOf({"", "a", "b"}),
              HasSubstr("drives/c/follows: \"b\" is not valid, expected a drive that follows no other one itself"));
  EXPECT_THAT(errorOf({"b", "a"}), HasSubstr("a drive that follows no other one itself"));
}

// Accepted, they would be held by nobody: a follower goes as fast as its leader.
TEST(Leaders, HoldTheLimits) {
  for (const bool all_drives : {true, false}) {
    for (const char* const key : {"max_velocity", "max_acceleration", "max_jerk"}) {
      std::vector<DriveSettings> drives;
      for (const std::string name : {"front", "rear"}) {
        auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
        settings->set("series", "sk2xxe").set("pole_pairs", 2).set("address", name == "front" ? 3 : 4).set(key, 2.5);
        if (name == "rear") settings->set("follows", "front");
        drives.push_back({name, settings});
      }
      try {
        readCycleConfig(MapSettings{"~"}, drives, {}, all_drives);
        ADD_FAILURE() << key << " is taken";
      } catch (const ConfigError& error) {
        EXPECT_EQ(std::string("~drives/rear/") + key +
                      ": 2.5 is not valid, expected none: this drive follows \"front\", whose limits count",
                  error.what());
      }
    }
  }
}

TEST(Leaders, MayStandBehindTheirFollowers) {
  const CycleConfig config = configured({"b", ""});
  EXPECT_EQ(1u, config.drives[0].leader);
  EXPECT_THAT(followersOf(config, 1), ElementsAre(0u));
  EXPECT_THAT(errorOf({"b", "c", ""}),
              HasSubstr("drives/a/follows: \"b\" is not valid, expected a drive that follows no other one itself"));
}

// Each wheel is commanded by the base: one that obeyed another drive would turn it.
TEST(Leaders, LeadNoDriveOfTheBase) {
  std::vector<DriveSettings> drives;
  for (const std::string name : {"left", "right", "lift"}) {
    auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
    settings->set("series", "sk2xxe").set("pole_pairs", 2).set("joint", name);
    drives.push_back({name, settings});
  }
  MapSettings node{"~"};
  node.set("left_wheel", "left").set("right_wheel", "right").set("wheel_separation", 0.5).set("wheel_radius", 0.1);
  const auto errorWith = [&](DriveIndex follower, const char* leader) {
    auto settings = std::make_shared<MapSettings>(dynamic_cast<const MapSettings&>(*drives[follower].settings));
    settings->set("follows", leader);
    std::vector<DriveSettings> changed = drives;
    changed[follower].settings = settings;
    try {
      readCycleConfig(node, changed, {}, true);
    } catch (const ConfigError& error) {
      return std::string{error.what()};
    }
    return std::string{"none"};
  };
  for (const DriveIndex wheel : {DriveIndex{0}, DriveIndex{1}}) {
    EXPECT_THAT(errorWith(wheel, "lift"), HasSubstr("no such key of a drive of the base"));
  }
  EXPECT_EQ("none", errorWith(2, "left"));
}

// What a follower makes of a target nobody knows, and setpoint zero stops neither.
TEST(Leaders, PositionNothing) {
  for (const char* const positioning : {"a", "b"}) {
    std::vector<DriveSettings> drives;
    for (const std::string name : {"a", "b"}) {
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("series", "sk2xxe").set("pole_pairs", 2).set("address", name == "a" ? 3 : 4);
      if (name == positioning) settings->set("mode", "position");
      if (name == "b") settings->set("follows", "a");
      drives.push_back({name, settings});
    }
    try {
      readCycleConfig(MapSettings{"~"}, drives, {}, true);
      ADD_FAILURE() << positioning << " positions, and that was taken";
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("drives/b/follows: \"a\" is not valid, expected no such key where one of both "
                            "is `mode: position`"));
    }
  }
}

// A program that was asked for one drive reads no other one.
TEST(Leaders, MayBeAbsentWhereNotAllDrivesWereRead) {
  const CycleConfig config = configured({"", "x"}, false);
  EXPECT_FALSE(config.drives[1].leader);
  EXPECT_EQ("x", config.drives[1].follows);
}

DeviceData device(std::optional<std::int32_t> control_word, std::optional<std::int32_t> setpoint) {
  DeviceData made;
  made.control_word_source = control_word;
  made.setpoint_source = setpoint;
  return made;
}

// BU 0280 5.1.3 and BU 0020 6.2.2: 4 is PROFIBUS of the one and broadcast of the other.
TEST(Leaders, AreToldByTheNumbersOfEachSeries) {
  EXPECT_FALSE(unexpectedSource(device(4, 0), Series::kSk5xxe, false));
  EXPECT_EQ(509, unexpectedSource(device(4, 0), Series::kSk2xxe, false)->number);
  EXPECT_EQ(509, unexpectedSource(device(4, 0), Series::kSk1x0e, false)->number);
  for (const std::int32_t source : {9, 10}) {
    EXPECT_EQ(509, unexpectedSource(device(source, 0), Series::kSk5xxe, false)->number);
    EXPECT_EQ(509, unexpectedSource(device(source, 0), Series::kSk54xe, false)->number);
    EXPECT_EQ(510, unexpectedSource(device(4, source), Series::kSk5xxe, false)->number);
    EXPECT_STREQ("", followsMessage(device(source, {}), Series::kSk700e).c_str()) << "9 and 10 are PROFIBUS there";
    EXPECT_STREQ("", followsMessage(device(source, {}), Series::kSk300e).c_str());
  }
  EXPECT_EQ(510, unexpectedSource(device(3, 4), Series::kSk2xxe, false)->number);
  EXPECT_FALSE(unexpectedSource(device(3, 0), Series::kSk2xxe, false));
  EXPECT_FALSE(unexpectedSource(device(3, 3), Series::kSk2xxe, false));
}

// The control word of this bus with the setpoint of the terminals: setpoint 0 stops nothing (BU 0280 5.1.3, BU 0070 5.1).
TEST(SetpointSource, FromElsewhereThanTheControlWordIsUnexpected) {
  for (const std::int32_t source : {1, 2, 6}) {
    const auto found = unexpectedSource(device(4, source), Series::kSk5xxe, false);
    ASSERT_TRUE(found) << source;
    EXPECT_EQ(510, found->number);
    EXPECT_EQ(source, found->found);
    EXPECT_TRUE(found->elsewhere && found->is_array && !found->should_follow);
    EXPECT_STREQ("", followsMessage(device(4, source), Series::kSk5xxe).c_str()) << "no inverter leads it";
  }
  EXPECT_EQ(510, unexpectedSource(device(3, 1), Series::kSk2xxe, false)->number);
  EXPECT_EQ(510, unexpectedSource(device(3, 2), Series::kSk1x0e, false)->number);
  EXPECT_EQ(510, unexpectedSource(device(6, 1), Series::kSk54xe, false)->number);
  EXPECT_FALSE(unexpectedSource(device(4, 4), Series::kSk5xxe, false));
  EXPECT_FALSE(unexpectedSource(device(4, {}), Series::kSk5xxe, false)) << "not read";
  EXPECT_FALSE(unexpectedSource(device({}, 1), Series::kSk5xxe, false)) << "not read";
  EXPECT_FALSE(unexpectedSource(device(0, 4), Series::kSk5xxe, false)) << "local control: status bit 9 tells it";
}

// 2 and more are buses; at 0 and 1, the terminals, status bit 9 refuses the drive.
TEST(SetpointSource, CountsWhereTheControlWordIsOfABus) {
  EXPECT_EQ(510, unexpectedSource(device(2, 1), Series::kSk5xxe, false)->number);
  EXPECT_FALSE(unexpectedSource(device(1, 4), Series::kSk5xxe, false));
}

// BU 0020 6.1.2 and BU 0070 5.1: 9 and 13 are the control word alone; P510 is the auxiliary setpoint.
TEST(SetpointSource, OfOlderSeriesIsToldByP509) {
  for (const Series series : {Series::kSk300e, Series::kSk700e, Series::kSk750e}) {
    for (const std::int32_t source : {9, 13}) {
      const auto found = unexpectedSource(device(source, {}), series, false);
      ASSERT_TRUE(found) << source;
      EXPECT_EQ(509, found->number);
      EXPECT_TRUE(found->elsewhere && !found->is_array);
    }
    for (const std::int32_t source : {0, 8, 10, 14, 17, 20}) {
      EXPECT_FALSE(unexpectedSource(device(source, 1), series, false)) << source;
    }
  }
}

// BU 0280 4.2.3.1: with NetRef P509 and P510 are not queried.
TEST(SetpointSource, DoesNotCountWhereEachTelegramTellsIt) {
  EXPECT_FALSE(unexpectedSource(device(3, 1), Series::kSk2xxe, false, true));
  EXPECT_EQ(510, unexpectedSource(device(3, 4), Series::kSk2xxe, false, true)->number) << "led by another inverter";
}

TEST(Leaders, OfAFollowerMustBeHeard) {
  EXPECT_FALSE(unexpectedSource(device(3, 4), Series::kSk2xxe, true));
  EXPECT_FALSE(unexpectedSource(device(4, 0), Series::kSk2xxe, true));
  const auto deaf = unexpectedSource(device(3, 0), Series::kSk2xxe, true);
  ASSERT_TRUE(deaf);
  EXPECT_TRUE(deaf->should_follow);
  // Enabled by its leader, with the setpoint of this bus, which nobody gives it.
  const auto held = unexpectedSource(device(4, 3), Series::kSk2xxe, true);
  ASSERT_TRUE(held);
  EXPECT_EQ(510, held->number);
  EXPECT_TRUE(held->should_follow);
  EXPECT_FALSE(unexpectedSource(device({}, {}), Series::kSk2xxe, true)) << "it does not tell: the configuration counts";
}

TEST(Leaders, AreToldInASentence) {
  EXPECT_STREQ("P510[-01] = 4 (broadcast): its setpoint comes from another inverter",
               followsMessage(device(3, 4), Series::kSk2xxe).c_str());
  EXPECT_STREQ("P509 = 10 (broadcast): its control word comes from another inverter",
               followsMessage(device(10, 0), Series::kSk5xxe).c_str());
  EXPECT_STREQ("", followsMessage(device(3, 0), Series::kSk2xxe).c_str());
}

// Led without being configured to be: it is to be set so that it obeys this bus.
TEST(Leaders, NobodyConfiguredAreUnexpected) {
  for (const auto& led : {device(4, 0), device(3, 4)}) {
    const auto found = unexpectedSource(led, Series::kSk2xxe, false);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->should_follow);
    EXPECT_FALSE(found->elsewhere);
  }
}

// What was not read is no reason to refuse a follower; P510 of the older series is none of a source, and no array.
TEST(Leaders, OfAFollowerThatTellsOnePartCount) {
  EXPECT_FALSE(unexpectedSource(device({}, 3), Series::kSk2xxe, true));
  EXPECT_FALSE(unexpectedSource(device(3, {}), Series::kSk2xxe, true));
  const auto deaf = unexpectedSource(device(8, 0), Series::kSk700e, true);
  ASSERT_TRUE(deaf);
  EXPECT_FALSE(deaf->is_array);
}

}  // namespace
}  // namespace nord_driver::cycle
