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

}  // namespace
}  // namespace nord_driver::cycle
