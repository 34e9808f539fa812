#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

#include "profile/cia402.h"
#include "profile/velocity_mode_state.h"

namespace nord_driver::profile {
namespace {

// 50 Hz and two pole pairs: 100 % is 1500 rpm.
Cia402Scaling fiftyHertz() {
  Cia402Scaling scaling{2};
  scaling.setMaxFrequency(Hertz{50.0});
  return scaling;
}

/// The state that the drive layer decodes from the translated word.
DriveState translated(Word status_word) {
  return StatusWord(fiftyHertz().fromCia402({status_word, 0}).status_word).state();
}

Cia402Output output(Word control_word, std::int16_t setpoint = 0) {
  return fiftyHertz().toCia402({control_word, {setpoint, 0, 0}}).value();
}

// Bits 4 to 6 stay set: 007F runs, 000F would not (BU 2700 6.4.3 no. 4).
TEST(Cia402, EveryCommandKeepsItsEightBits) {
  EXPECT_EQ(0x007E, output(0x047E).control_word);
  EXPECT_EQ(0x007F, output(0x047F).control_word);
  EXPECT_EQ(0x007B, output(0x047B).control_word);
  EXPECT_EQ(0x007D, output(0x047D).control_word);
  EXPECT_EQ(0x00FE, output(0x04FE).control_word);
}

// There is no bit 10: 0000 would be "disable voltage" and a turning motor would coast.
TEST(Cia402, WordsToBeIgnoredAreNotSent) {
  EXPECT_FALSE(fiftyHertz().toCia402({0x0000, {}}).has_value());
  EXPECT_FALSE(fiftyHertz().toCia402({0x007F, {8192, 0, 0}}).has_value());
}

// The profile knows set 1 only, and its bits 14 and 15 mean nothing (BU 0070 6.4.2).
TEST(Cia402, TheParameterSetIsLeftOut) {
  EXPECT_EQ(0x007E, output(0x847E).control_word);
}

// Bit 11 of 6040h: 0 = right; NORD's bit 11 (right) beats its bit 12.
TEST(Cia402, TheDirectionIsOneBit) {
  EXPECT_EQ(0x087F, output(0x147F).control_word);
  EXPECT_EQ(0x007F, output(0x1C7F).control_word);
  EXPECT_EQ(0x007F, output(0x0C7F).control_word);
}

TEST(Cia402, SetpointOneBecomesRpm) {
  EXPECT_EQ(750, output(0x047F, 0x2000).target_velocity);
  EXPECT_EQ(-1500, output(0x047F, -0x4000).target_velocity);
  EXPECT_EQ(0, output(0x047F, 0).target_velocity);
}

// With P104 > 0 an enabled motor turns at 0 rpm, to the right, and not where it was to turn.
TEST(Cia402, TheSmallestSetpointKeepsItsDirection) {
  for (const std::int16_t share : std::initializer_list<std::int16_t>{1, 2, 5, 10}) {
    EXPECT_EQ(1, output(0x047F, share).target_velocity) << share;
    EXPECT_EQ(-1, output(0x047F, static_cast<std::int16_t>(-share)).target_velocity) << share;
  }
  EXPECT_EQ(2, output(0x047F, 17).target_velocity) << "1.56 rpm";
}

// Nobody knows what a share of an unknown P105 is.
TEST(Cia402, WithoutP105EverySpeedIsZero) {
  const Cia402Scaling scaling{2};
  EXPECT_EQ(0, scaling.toCia402({0x047F, {0x2000, 0, 0}}).value().target_velocity);
  EXPECT_EQ(0, scaling.toCia402({0x047F, {-0x2000, 0, 0}}).value().target_velocity);
  EXPECT_EQ(0, scaling.fromCia402({0x0237, 750}).actual_values[0]);
}

TEST(Cia402, RpmBeyondTheObjectAreHeld) {
  Cia402Scaling scaling{1};
  scaling.setMaxFrequency(Hertz{600.0});
  EXPECT_EQ(32767, scaling.toCia402({0x047F, {16384, 0, 0}}).value().target_velocity);
  EXPECT_EQ(-32768, scaling.toCia402({0x047F, {-16384, 0, 0}}).value().target_velocity);
}

// Bit 10 is "setpoint reached" there and bit 8 here, bit 14 the direction there and bits 11 and 12 here; bit 9 is
// remote in both (BU 0070 6.4.2, BU 2700 6.4.2).
TEST(Cia402, TheStatusWordIsToldInNordsBits) {
  EXPECT_EQ(0x0B31, fiftyHertz().fromCia402({0x0631, 0}).status_word);
  EXPECT_EQ(0x0B37, fiftyHertz().fromCia402({0x0637, 750}).status_word);
  EXPECT_EQ(0x1237, fiftyHertz().fromCia402({0x4237, -750}).status_word);
  EXPECT_EQ(0x0970, fiftyHertz().fromCia402({0x0470, 0}).status_word);     // local control
  EXPECT_EQ(0x0AB7, fiftyHertz().fromCia402({0x0AB7, 1500}).status_word);  // warning, and a limit that has no bit
}

TEST(Cia402, ActualSpeedBecomesActualValueOne) {
  EXPECT_EQ(0x2000, fiftyHertz().fromCia402({0x0637, 750}).actual_values[0]);
  EXPECT_EQ(-0x4000, fiftyHertz().fromCia402({0x4637, -1500}).actual_values[0]);
}

// 0.1 Hz, the least that P105 can have, and eight pole pairs: 100 % is 0.75 rpm, and a share of it is still told.
TEST(Cia402, TheSlowestMotorHasASpeed) {
  Cia402Scaling scaling{8};
  scaling.setMaxFrequency(Hertz{0.1});
  EXPECT_EQ(21'845, scaling.fromCia402({0x0637, 1}).actual_values[0]);
  EXPECT_EQ(-21'845, scaling.fromCia402({0x4637, -1}).actual_values[0]);
}

// Words that nobody has filled in are those of an inverter that is not there, and of a command that moves nothing.
TEST(Cia402, WordsBeforeTheFirstTelegramSayNothing) {
  const Cia402Input from;
  EXPECT_EQ(0, from.status_word);
  EXPECT_EQ(0, from.actual_velocity);
  EXPECT_EQ(0, fiftyHertz().fromCia402(from).status_word);
  const Cia402Output to;
  EXPECT_EQ(0, to.control_word);
  EXPECT_EQ(0, to.target_velocity);
}

// An absent inverter's zeros must not gain a direction bit and pass for a drive.
TEST(Cia402, NoStatusStaysNoStatus) {
  EXPECT_EQ(0, fiftyHertz().fromCia402({0x0000, 0}).status_word);
}

TEST(Cia402, StatesKeepTheirMeaning) {
  EXPECT_EQ(DriveState::kNotReadyToSwitchOn, translated(0x0200));
  EXPECT_EQ(DriveState::kSwitchOnDisabled, translated(0x0270));
  EXPECT_EQ(DriveState::kReadyToSwitchOn, translated(0x0631));
  EXPECT_EQ(DriveState::kSwitchedOn, translated(0x0633));
  EXPECT_EQ(DriveState::kOperationEnabled, translated(0x4637));
  EXPECT_EQ(DriveState::kQuickStopActive, translated(0x0617));
  EXPECT_EQ(DriveState::kFaultReactionActive, translated(0x063F));
  EXPECT_EQ(DriveState::kFault, translated(0x0618));
  EXPECT_EQ(DriveState::kUnknown, translated(0x0622));
}

// The same for every word: the drive layer sees the state that the inverter meant.
RC_GTEST_PROP(Cia402, TheTranslatedWordSpellsTheSameState, ()) {
  const auto word = *rc::gen::inRange<unsigned>(1, 0x10000);
  const Word status = static_cast<Word>(word);
  RC_ASSERT(translated(status) == stateOf(status));
}

// What goes out as a speed comes back as the same share, within one rpm.
RC_GTEST_PROP(Cia402, ASpeedComesBackAsItWasSent, ()) {
  const auto share = static_cast<std::int16_t>(*rc::gen::inRange(-16384, 16385));
  const Cia402Scaling scaling = fiftyHertz();
  const std::int16_t rpm = scaling.toCia402({0x047F, {share, 0, 0}}).value().target_velocity;
  RC_ASSERT(std::abs(scaling.fromCia402({0x0637, rpm}).actual_values[0] - share) <= 11);
}

}  // namespace
}  // namespace nord_driver::profile
