// drives/<name>/signals: sources by series and bus, and refusals that name key, value and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/signal_setup.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Configured {
  MapSettings drive{"~drives/left/", {}};
  Series series = Series::kSk2xxe;

  std::vector<SignalSetup> read() const { return readSignals(drive, series); }
  std::string refusal() const {
    try {
      read();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
  std::string refusal(const DriveIdentity& identity) const {
    try {
      checkSignalsCarried(drive, read(), identity);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST(SignalSetupTest, AnOutputGoesOffByItselfAndMovesNothing) {
  Configured config;
  config.drive.set("signals/lamp/source", "module_output_1");
  const SignalSetup lamp = config.read().at(0);
  EXPECT_EQ("lamp", lamp.name);
  EXPECT_EQ(SignalSource::kModuleOutput, lamp.source);
  EXPECT_EQ(1, lamp.number);
  EXPECT_FALSE(lamp.hold);
  EXPECT_FALSE(lamp.may_move);
  config.drive.set("signals/lamp/on_timeout", "hold");
  EXPECT_TRUE(config.read().at(0).hold);
}

TEST(SignalSetupTest, KnowsEverySource) {
  for (const char* word : {"bus_in_bit_0", "bus_in_bit_7", "control_bit_8", "control_bit_9", "module_output_2",
                           "bus_out_bit_0", "bus_out_bit_7", "status_bit_10", "status_bit_13", "digital_input_7",
                           "relay_1", "module_input_4", "analog_input_2"}) {
    Configured config;
    config.drive.set("signals/one/source", word);
    ASSERT_EQ("accepted", config.refusal()) << word;
    EXPECT_EQ(word, sourceText(config.read().at(0)));
  }
}

TEST(SignalSetupTest, RefusesWhatThereIsNot) {
  for (const char* word :
       {"bus_in_bit_8", "control_bit_7", "control_bit_10", "module_output_0", "module_output_3", "bus_out_bit_8",
        "status_bit_9", "status_bit_11", "status_bit_12", "status_bit_14", "digital_input_0", "digital_input_13",
        "relay_0", "relay_5", "module_input_0", "module_input_5", "analog_input_0", "analog_input_3", "lamp"}) {
    Configured config;
    config.drive.set("signals/one/source", word);
    EXPECT_THAT(config.refusal(),
                AllOf(HasSubstr("~drives/left/signals/one/source"), HasSubstr(word), HasSubstr("one of bus_in_bit_0")));
  }
  Configured absent;
  absent.drive.set("signals/one/on_timeout", "hold");
  EXPECT_THAT(absent.refusal(), HasSubstr("signals/one/source is missing"));
}

// SK 300E has six inputs, eight bus bits in P480 and no analogue actual values (BU 0020 6.1), and no POSICON, whose relay 4
// bit 13 would be (7.3.4).
TEST(SignalSetupTest, RefusesWhatTheSeriesHasNot) {
  for (const char* word : {"digital_input_7", "control_bit_8", "analog_input_1", "status_bit_13"}) {
    Configured config;
    config.series = Series::kSk300e;
    config.drive.set("signals/one/source", word);
    EXPECT_THAT(config.refusal(), HasSubstr("a source that sk300e has")) << word;
  }
}

TEST(SignalSetupTest, TakesTheStatusBitsASeriesHas) {
  for (const auto& [series, word] : {std::pair{Series::kSk300e, "status_bit_10"},
                                     {Series::kSk700e, "status_bit_13"},
                                     {Series::kSk750e, "status_bit_13"}}) {
    Configured config;
    config.series = series;
    config.drive.set("signals/one/source", word);
    EXPECT_EQ("accepted", config.refusal()) << profile::toString(series) << word;
  }
}

TEST(SignalSetupTest, WhatMayMoveNeverHolds) {
  Configured config;
  config.drive.set("signals/jog/source", "control_bit_8").set("signals/jog/may_move", true);
  EXPECT_TRUE(config.read().at(0).may_move);
  config.drive.set("signals/jog/on_timeout", "hold");
  EXPECT_THAT(config.refusal(), AllOf(HasSubstr("signals/jog/on_timeout"), HasSubstr("release")));
  config.drive.set("signals/jog/on_timeout", "release").set("signals/jog/source", "module_output_1");
  EXPECT_THAT(config.refusal(), HasSubstr("signals/jog/may_move"));
}

TEST(SignalSetupTest, EachOutputIsSwitchedByOne) {
  Configured config;
  config.drive.set("signals/a/source", "module_output_1").set("signals/b/source", "module_output_1");
  EXPECT_THAT(config.refusal(), HasSubstr("that \"a\" does not switch already"));
  config.drive.set("signals/a/source", "relay_1").set("signals/b/source", "relay_1");
  EXPECT_EQ("accepted", config.refusal()) << "two may read";
}

TEST(SignalSetupTest, RefusesWhatTheBusDoesNotCarry) {
  DriveIdentity identity;
  identity.process_values = 3;
  Configured lamp;
  lamp.drive.set("signals/lamp/source", "module_output_1");
  EXPECT_THAT(lamp.refusal(identity), AllOf(HasSubstr("signals/lamp/source"), HasSubstr("are not carried")));
  identity.module_io = true;
  EXPECT_EQ("accepted", lamp.refusal(identity));
  Configured bit;
  bit.drive.set("signals/bit/source", "bus_in_bit_1");
  EXPECT_EQ("accepted", bit.refusal(identity));
  identity.process_values = 1;
  EXPECT_THAT(bit.refusal(identity), HasSubstr("longer telegram"));
  Configured control;
  control.drive.set("signals/bit/source", "control_bit_8");
  EXPECT_EQ("accepted", control.refusal(identity));
  identity.nord_profile = false;
  EXPECT_THAT(control.refusal(identity), HasSubstr("the profile of this drive"));
}

}  // namespace
}  // namespace nord_driver::cycle
