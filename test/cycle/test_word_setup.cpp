// drives/<name>/setpoints: defaults, and refusals that name key, value and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/word_setup.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using profile::WordUse;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Duration kTimeout = std::chrono::milliseconds{500};

struct Configured {
  MapSettings drive{"~drives/left/", {}};
  Series series = Series::kSk5xxe;
  Duration timeout = kTimeout;

  WordSetup read() const { return readWordSetup(drive, series, timeout); }
  std::string refusal() const {
    try {
      read();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST(WordSetupTest, HasNothingByDefault) {
  EXPECT_TRUE(Configured{}.read().empty());
}

// A time-out never takes the limit away: it goes back to the most that was configured, P112 itself at most.
TEST(WordSetupTest, ALimitIsInPercentAndGoesBackToItself) {
  Configured config;
  config.drive.set("setpoints/grip/function", "torque_limit").set("setpoints/grip/limit", 60.0);
  const SetpointSetup setpoint = config.read().setpoints.at(0);
  EXPECT_EQ("grip", setpoint.name);
  EXPECT_EQ(WordUse::kTorqueLimit, setpoint.use);
  EXPECT_DOUBLE_EQ(60.0, setpoint.limit.value());
  EXPECT_FALSE(setpoint.neutral);
  EXPECT_DOUBLE_EQ(100.0, setpoint.nominal.value());
  EXPECT_FALSE(setpoint.moves);
  EXPECT_EQ(kTimeout, setpoint.timeout);
  config.drive.set("setpoints/grip/limit", 101.0);
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("~drives/left/setpoints/grip/limit"), HasSubstr("101")));
  config.drive.set("setpoints/grip/limit", 60.0).set("setpoints/grip/neutral", 61.0);
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("grip/neutral"), HasSubstr("61")));
}

// What can turn the motor has a limit that somebody has chosen, and grows old with the velocity command at the latest.
TEST(WordSetupTest, WhatCanTurnTheMotorIsBoundLikeACommand) {
  Configured config;
  config.drive.set("setpoints/boost/function", "frequency_addition");
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("setpoints/boost/limit is missing"), HasSubstr("turn the motor")));
  config.drive.set("setpoints/boost/limit", 5.0);
  const SetpointSetup setpoint = config.read().setpoints.at(0);
  EXPECT_TRUE(setpoint.moves);
  EXPECT_TRUE(setpoint.is_signed);
  EXPECT_FALSE(setpoint.nominal) << "P105 of the set in force";
  EXPECT_DOUBLE_EQ(0.0, setpoint.neutral.value());
  config.drive.set("setpoints/boost/timeout", 0.6);
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("boost/timeout"), HasSubstr("0.6"), HasSubstr("0.5")));
  config.drive.set("setpoints/boost/timeout", 0.0);
  EXPECT_THAT(config.refusal(), HasSubstr("boost/timeout")) << "0 would be for ever";
}

TEST(WordSetupTest, RefusesAFunctionTheSeriesHasNot) {
  Configured config;
  config.drive.set("setpoints/slow/function", "minimum_frequency").set("setpoints/slow/limit", 5.0);
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("\"minimum_frequency\""), HasSubstr("sk5xxe has: torque_limit, ")));
  config.drive.set("setpoints/slow/function", "torque");
  EXPECT_THAT(config.refusal(), HasSubstr("\"torque\""));
  config.drive.erase("setpoints/slow/function");
  EXPECT_THAT(config.refusal(), HasSubstr("setpoints/slow/function is missing"));
}

// BU 0220 and BU 0200 disagree on what 100 % of a frequency is: only whoever commissions it can say.
TEST(WordSetupTest, AFrequencyOfSk2xxeNeedsItsNominal) {
  Configured config;
  config.series = Series::kSk2xxe;
  config.drive.set("setpoints/slow/function", "maximum_frequency");
  EXPECT_THAT(config.refusal(),
              AllOf(HasSubstr("setpoints/slow/nominal is missing"), HasSubstr("BU 0220"), HasSubstr("BU 0200")));
  config.drive.set("setpoints/slow/nominal", 100.0);
  EXPECT_DOUBLE_EQ(100.0, config.read().setpoints.at(0).nominal.value());
}

TEST(WordSetupTest, RefusesTwoOfAKindAndMoreThanTwo) {
  Configured config;
  config.drive.set("setpoints/a/function", "torque_limit").set("setpoints/b/function", "torque_limit");
  EXPECT_THAT(config.refusal(), HasSubstr("that \"a\" has not already"));
  config.drive.set("setpoints/b/function", "current_limit").set("setpoints/c/function", "maximum_frequency");
  EXPECT_THAT(config.refusal(), HasSubstr("two further setpoints at most"));
  Configured named;
  named.drive.set("setpoints/2nd/function", "torque_limit");
  EXPECT_THAT(named.refusal(), HasSubstr("\"2nd\""));
  Configured flat;
  flat.drive.set("setpoints", "torque_limit");
  EXPECT_THAT(flat.refusal(), HasSubstr("~drives/left/setpoints is not valid, expected a group"));
}

TEST(WordSetupTest, RefusesWhatTheBusDoesNotCarry) {
  Configured config;
  config.drive.set("setpoints/grip/function", "torque_limit");
  DriveIdentity identity;
  identity.process_values = 3;
  EXPECT_NO_THROW(checkWordsCarried(config.drive, config.read(), identity));
  identity.process_values = 1;
  try {
    checkWordsCarried(config.drive, config.read(), identity);
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("~drives/left/setpoints"), HasSubstr("the bus carries 0 of them")));
  }
}

// --- ranges ----------------------------------------------------------------------------------------------------------

std::string refusalOf(const char* function, const std::string& key, double value, Series series = Series::kSk5xxe) {
  Configured config;
  config.series = series;
  config.drive.set("setpoints/one/function", function).set("setpoints/one/limit", 1.0);
  config.drive.set("setpoints/one/nominal", 50.0).set("setpoints/one/" + key, value);
  return config.refusal();
}

// Twice a word's 100 % is all it carries (BU 0020 7.3.6); a frequency goes as high as P105 may.
TEST(WordSetupTest, LimitsWhatIsCommandedByWhatAWordCarries) {
  EXPECT_EQ("accepted", refusalOf("torque_precontrol", "limit", 200.0));
  EXPECT_THAT(refusalOf("torque_precontrol", "limit", 200.1), HasSubstr("one/limit: 200.1"));
  EXPECT_EQ("accepted", refusalOf("frequency_addition", "limit", 400.0));
  EXPECT_THAT(refusalOf("frequency_addition", "limit", 400.1), HasSubstr("one/limit: 400.1"));
  EXPECT_EQ("accepted", refusalOf("torque_limit", "limit", 0.0)) << "no torque at all is a limit, too";
  EXPECT_THAT(refusalOf("torque_limit", "limit", -0.1), HasSubstr("one/limit: -0.1"));
}

TEST(WordSetupTest, MayReturnToNothing) {
  EXPECT_EQ("accepted", refusalOf("torque_limit", "neutral", 0.0));
  EXPECT_THAT(refusalOf("torque_limit", "neutral", -0.1), HasSubstr("one/neutral: -0.1"));
}

TEST(WordSetupTest, TakesANominalFromATenthOfAHertzOn) {
  for (const double inside : {0.1, 400.0}) {
    EXPECT_EQ("accepted", refusalOf("frequency_addition", "nominal", inside, Series::kSk2xxe)) << inside;
  }
  for (const double outside : {0.09, 400.1}) {
    EXPECT_THAT(refusalOf("frequency_addition", "nominal", outside, Series::kSk2xxe), HasSubstr("one/nominal"));
  }
}

TEST(WordSetupTest, ALimitLastsAnHourAtMostOrForEver) {
  for (const double inside : {0.0, 3600.0}) EXPECT_EQ("accepted", refusalOf("torque_limit", "timeout", inside));
  EXPECT_THAT(refusalOf("torque_limit", "timeout", 3601.0), HasSubstr("one/timeout: 3601"));
}

// cmd_vel_timeout 0: the velocity command never grows old either.
TEST(WordSetupTest, WhereNoCommandGrowsOldNoneHasTo) {
  Configured config;
  config.timeout = Duration::zero();
  config.drive.set("setpoints/boost/function", "frequency_addition").set("setpoints/boost/limit", 5.0);
  ASSERT_EQ("accepted", config.refusal());
  EXPECT_EQ(Duration::zero(), config.read().setpoints.at(0).timeout);
  config.drive.set("setpoints/boost/timeout", 3600.0);
  EXPECT_EQ("accepted", config.refusal());
}

TEST(WordSetupTest, TakesATorqueOfAnyMotor) {
  for (const double inside : {1e-3, 1e5}) {
    Configured config;
    config.drive.set("torque_at_limit", inside);
    EXPECT_EQ(inside, config.read().torque_at_limit);
  }
  for (const double outside : {0.9e-3, 1.1e5}) {
    Configured config;
    config.drive.set("torque_at_limit", outside);
    EXPECT_THAT(config.refusal(), HasSubstr("~drives/left/torque_at_limit")) << outside;
  }
}

// --- what is read beside it ------------------------------------------------------------------------------------------

TEST(WordSetupTest, OutputsGoOffWithTheVelocityCommand) {
  EXPECT_EQ(kTimeout, Configured{}.read().release_after);
}

TEST(WordSetupTest, EachFunctionIsNamedAsConfigurationsWriteIt) {
  EXPECT_STREQ("torque_limit", setpointWord(WordUse::kTorqueLimit));
  EXPECT_STREQ("current_switch_off_limit", setpointWord(WordUse::kCurrentSwitchOff));
  EXPECT_STREQ("torque_precontrol", setpointWord(WordUse::kTorquePrecontrol));
  EXPECT_STREQ("", setpointWord(WordUse::kFrequency)) << "the velocity is no further setpoint";
}

// --- what the bus carries --------------------------------------------------------------------------------------------

std::string carriedBy(std::uint8_t values, const Configured& config) {
  DriveIdentity identity;
  identity.process_values = values;
  try {
    checkWordsCarried(config.drive, config.read(), identity);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(WordSetupTest, TakesAsManySetpointsAsTheBusCarries) {
  Configured config;
  config.drive.set("setpoints/grip/function", "torque_limit");
  EXPECT_EQ("accepted", carriedBy(2, config));
  config.drive.set("setpoints/boost/function", "frequency_addition").set("setpoints/boost/limit", 5.0);
  EXPECT_EQ("accepted", carriedBy(3, config));
  EXPECT_THAT(carriedBy(2, config), HasSubstr("2 beside the velocity, but the bus carries 1 of them"));
}

TEST(WordSetupTest, RefusesASignalTheBusDoesNotCarry) {
  Configured config;
  config.drive.set("signals/bit/source", "bus_in_bit_1");
  EXPECT_EQ("accepted", carriedBy(3, config));
  EXPECT_THAT(carriedBy(1, config), AllOf(HasSubstr("signals/bit/source"), HasSubstr("longer telegram")));
}

TEST(WordSetupTest, RefusesATorqueTheBusDoesNotCarry) {
  Configured config;
  config.drive.set("torque_at_limit", 10.0);
  EXPECT_EQ("accepted", carriedBy(2, config));
  EXPECT_THAT(carriedBy(1, config), HasSubstr("~drives/left/torque_at_limit"));
}

}  // namespace
}  // namespace nord_driver::cycle
