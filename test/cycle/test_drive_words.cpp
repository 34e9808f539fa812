// The words of one drive from one state to what is sent: which of them is written, and with what.
#include <gtest/gtest.h>

#include <array>

#include "cycle/drive_words.h"
#include "cycle/signals_bench.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using profile::WordUse;
using Words = std::array<std::int16_t, 3>;

constexpr std::int16_t kFull = 16384, kHalf = 8192;
constexpr Word kIdle = 0x047E;

SetpointSetup setpoint(WordUse use, double nominal) {
  SetpointSetup made;
  made.use = use;
  made.nominal = nominal;
  return made;
}

/// In Hz, of P105.
SetpointSetup addition() {
  SetpointSetup made;
  made.use = WordUse::kFrequencyAddition;
  made.limit = 10.0;
  made.neutral = 0.0;
  made.moves = true;
  made.is_signed = true;
  return made;
}

/// Enabled in parameter set 1, with P105 = 50 Hz; every bit without a function in P480.
class DriveWordsTest : public ::testing::Test {
 protected:
  DriveWordsTest() {
    state_.set = 1;
    state_.max_frequency = Hertz{50.0};
    state_.follows = true;
    for (int i = 0; i < 12; ++i) device_.bus_bit_functions.push_back(0);
    output_.control_word = kIdle;
  }
  void functions(std::size_t set, const WordFunctions& functions) { device_.word_functions[set - 1] = functions; }
  void command(double value) { commands_.setpoints[0] = {value, now_, true}; }
  void switchOn(std::size_t index = 0) { commands_.outputs[index] = {true, now_, true}; }
  /// What goes to the drive in one cycle of a node that has just come.
  Words sent(const WordSetup& setup) {
    DriveWords words{setup, series_, carried_};
    return sentBy(words);
  }
  Words sentBy(DriveWords& words) {
    output_.setpoints = {};
    words.put(output_, state_, device_, commands_, now_);
    return output_.setpoints;
  }
  static WordSetup with(const SetpointSetup& setpoint) {
    WordSetup setup;
    setup.setpoints = {setpoint};
    return setup;
  }
  static WordSetup with(std::initializer_list<SignalSetup> signals) {
    WordSetup setup;
    setup.signals = signals;
    return setup;
  }

  Series series_ = Series::kSk5xxe;
  std::size_t carried_ = 3;
  DriveWords::State state_;
  DeviceData device_;
  WordCommands commands_;
  profile::ProcessOutput output_;
  Instant now_{std::chrono::hours{1}};
};

// --- setpoints -------------------------------------------------------------------------------------------------------

// 200 % is one step beyond a word: -200 % in its place would turn the motor the other way.
TEST_F(DriveWordsTest, TwiceTheNominalIsTheMostOfAWord) {
  SetpointSetup precontrol = setpoint(WordUse::kTorquePrecontrol, 100.0);
  precontrol.limit = 200.0;
  precontrol.moves = precontrol.is_signed = true;
  functions(1, {{1, 11, 0}, {1, 0, 0}});
  command(200.0);
  EXPECT_EQ((Words{0, 32767, 0}), sent(with(precontrol)));
  command(-200.0);
  EXPECT_EQ((Words{0, -32768, 0}), sent(with(precontrol)));
}

// Nobody can say what a frequency is without P105: nothing is added, and the limit is the drive's own.
TEST_F(DriveWordsTest, AFrequencyWithoutP105IsTheSafestOne) {
  SetpointSetup limit;
  limit.use = WordUse::kMaximumFrequency;
  functions(1, {{1, 4, 7}, {1, 0, 0}});
  state_.max_frequency.reset();
  command(5.0);
  EXPECT_EQ((Words{0, 0, 0}), sent(with(addition())));
  EXPECT_EQ((Words{0, 0, kFull}), sent(with(limit)));
}

// With bit 10 low the drive evaluates nothing: no word of ours stands there for when it does.
TEST_F(DriveWordsTest, BesideAControlWordNobodyHeedsNothingIsSent) {
  functions(1, {{1, 2, 17}, {1, 0, 0}});
  output_.control_word = 0;
  EXPECT_EQ((Words{0, 0, 0}), sent(with(setpoint(WordUse::kTorqueLimit, 100.0))));
  switchOn(0);
  switchOn(1);
  EXPECT_EQ((Words{0, 0, 0}), sent(with({output(SignalSource::kBusInBit, 3), output(SignalSource::kControlBit, 8)})));
  EXPECT_EQ(0, output_.control_word);
}

TEST_F(DriveWordsTest, WithoutAParameterSetNoWordIsKnown) {
  functions(1, {{1, 2, 17}, {1, 0, 0}});
  functions(4, {{1, 2, 17}, {1, 0, 0}});
  switchOn();
  for (const std::uint8_t none : {std::uint8_t{0}, std::uint8_t{5}}) {
    state_.set = none;
    EXPECT_EQ((Words{0, 0, 0}), sent(with(setpoint(WordUse::kTorqueLimit, 100.0)))) << unsigned{none};
    EXPECT_EQ((Words{0, 0, 0}), sent(with({output(SignalSource::kBusInBit, 3)}))) << unsigned{none};
  }
  state_.set = 4;
  EXPECT_EQ((Words{0, kFull, 0}), sent(with(setpoint(WordUse::kTorqueLimit, 100.0))));
}

// P547 and P548 are those of the set that is commanded, and of no other one.
TEST_F(DriveWordsTest, TheWordsOfTheParameterSetCount) {
  functions(1, {{1, 4, 17}, {1, 0, 0}});
  functions(2, {{1, 17, 4}, {1, 0, 0}});
  functions(3, {{1, 0, 0}, {1, 0, 0}});
  functions(4, {{1, 0, 0}, {1, 0, 0}});
  command(5.0);
  switchOn();
  const WordSetup bits = with({output(SignalSource::kBusInBit, 3)});
  EXPECT_EQ((Words{0, 1638, 0}), sent(with(addition())));
  EXPECT_EQ((Words{0, 0, 8}), sent(bits));
  state_.set = 2;
  EXPECT_EQ((Words{0, 0, 1638}), sent(with(addition())));
  EXPECT_EQ((Words{0, 8, 0}), sent(bits));
}

// Its function is being written or read again: what was an addition may be a torque now.
TEST_F(DriveWordsTest, WhatTurnsTheMotorIsNotSentToAWordInDoubt) {
  functions(1, {{1, 4, 0}, {1, 0, 0}});
  command(5.0);
  ASSERT_EQ((Words{0, 1638, 0}), sent(with(addition())));
  state_.in_doubt = true;
  EXPECT_EQ((Words{0, 0, 0}), sent(with(addition())));
}

// A limit stays in the word that was known last: 0 would take the torque away from a drive that is being stopped.
TEST_F(DriveWordsTest, ALimitStaysInItsWordWhileTheWordsAreReadAgain) {
  DriveWords words{with(setpoint(WordUse::kTorqueLimit, 100.0)), series_, carried_};
  command(50.0);
  functions(1, {{1, 0, 2}, {1, 0, 0}});
  ASSERT_EQ((Words{0, 0, kHalf}), sentBy(words));
  functions(1, {});
  EXPECT_EQ((Words{0, 0, kHalf}), sentBy(words));
  functions(1, {{1, 2, 0}, {1, 0, 0}});
  EXPECT_EQ((Words{0, kHalf, 0}), sentBy(words));
}

// P546 = 3 of SK 750E: setpoint 3 is a half of its 32 bits, whatever P548 says (BU 0020 6.1.2).
TEST_F(DriveWordsTest, NoLimitIsSentInTheMiddleOfA32BitTarget) {
  series_ = Series::kSk750e;
  functions(1, {{3, 0, 2}, {6, 0, 0}});
  EXPECT_EQ((Words{0, 0, 0}), sent(with(setpoint(WordUse::kTorqueLimit, 100.0))));
  functions(1, {{1, 0, 2}, {1, 0, 0}});
  EXPECT_EQ((Words{0, 0, kFull}), sent(with(setpoint(WordUse::kTorqueLimit, 100.0))));
}

// --- signals ---------------------------------------------------------------------------------------------------------

// An output of the module is no bit of the inverter, where the bits are numbered the same.
TEST_F(DriveWordsTest, OutputsOfTheModuleStayOutOfTheBusBits) {
  functions(1, {{1, 17, 0}, {1, 0, 0}});
  switchOn();
  EXPECT_EQ((Words{0, 0, 0}), sent(with({output(SignalSource::kModuleOutput, 1)})));
  EXPECT_EQ(1, output_.module_outputs);
}

}  // namespace
}  // namespace nord_driver::cycle
