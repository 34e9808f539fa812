#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

#include "profile/drivecom.h"
#include "profile/velocity_mode_state.h"

namespace nord_driver::profile {
namespace {

// 50 Hz and two pole pairs: 100 % is 1500 rpm.
DrivecomScaling fiftyHertz() {
  DrivecomScaling scaling{2};
  scaling.setMaxFrequency(Hertz{50.0});
  return scaling;
}

DrivecomOutput output(Word control_word, std::int16_t setpoint = 0) {
  return fiftyHertz().toDrivecom({control_word, {setpoint, 0, 0}});
}

/// The state that the drive layer decodes from the translated word.
DriveState translated(Word status_word) {
  return StatusWord(fiftyHertz().fromDrivecom({status_word, 0}).status_word).state();
}

// BU 0070 6.4.2, object 6040: bits 0 to 7 are those of the control word without the profile; 8 to 10 are reserved.
TEST(Drivecom, EveryCommandKeepsItsEightBits) {
  EXPECT_EQ(0x007E, output(0x047E).control_word);
  EXPECT_EQ(0x007F, output(0x047F).control_word);
  EXPECT_EQ(0x007B, output(0x047B).control_word);
  EXPECT_EQ(0x007D, output(0x047D).control_word);
  EXPECT_EQ(0x00FE, output(0x04FE).control_word);
}

// The ring carries something in every cycle, and 0000 would be "block voltage".
TEST(Drivecom, WordsToBeIgnoredBecomeTheIdleWord) {
  EXPECT_EQ(0x007E, output(0x0000).control_word);
  EXPECT_EQ(0x007E, output(0x007F, 8192).control_word);
  EXPECT_EQ(0, output(0x007F, 8192).speed_setpoint);
  EXPECT_EQ(0x007E, DrivecomOutput{}.control_word);
}

// Valid for the first parameter set only (BU 0070 6.3.2), and bits 12 to 15 are free.
TEST(Drivecom, TheParameterSetIsLeftOut) {
  EXPECT_EQ(0x007F, output(0xC47F).control_word);
}

TEST(Drivecom, TheDirectionIsBitEleven) {
  EXPECT_EQ(0x087F, output(0x147F).control_word);
  EXPECT_EQ(0x007F, output(0x0C7F).control_word);
}

// The telegram of BU 0070 7.2, 50 % (2000h), as the profile has it: 750 of 1500 rpm.
TEST(Drivecom, SetpointOneBecomesRpm) {
  EXPECT_EQ(750, output(0x047F, 0x2000).speed_setpoint);
  EXPECT_EQ(-1500, output(0x047F, -0x4000).speed_setpoint);
}

TEST(Drivecom, WithoutP105EverySpeedIsZero) {
  const DrivecomScaling scaling{2};
  EXPECT_EQ(0, scaling.toDrivecom({0x047F, {0x2000, 0, 0}}).speed_setpoint);
  EXPECT_EQ(0x007F, scaling.toDrivecom({0x047F, {0x2000, 0, 0}}).control_word);
  EXPECT_EQ(0, scaling.fromDrivecom({0x0637, 750}).actual_values[0]);
}

// Object 6041: 9 remote, 10 setpoint reached, 11 limit, 14 direction (0 = right).
TEST(Drivecom, TheStatusWordIsToldInNordsBits) {
  EXPECT_EQ(0x0B70, fiftyHertz().fromDrivecom({0x0670, 0}).status_word);
  EXPECT_EQ(0x0B37, fiftyHertz().fromDrivecom({0x0637, 750}).status_word);
  EXPECT_EQ(0x1237, fiftyHertz().fromDrivecom({0x4237, -750}).status_word);
  EXPECT_EQ(0x0A37, fiftyHertz().fromDrivecom({0x0A37, 1500}).status_word);  // the limit has no bit
  EXPECT_EQ(0x0831, fiftyHertz().fromDrivecom({0x0031, 0}).status_word);     // local control
  EXPECT_EQ(0, fiftyHertz().fromDrivecom({0x0000, 0}).status_word);          // nobody there
}

TEST(Drivecom, TheLimitIsBitElevenOfTheStatusWord) {
  EXPECT_TRUE(drivecomLimitReached(0x0A37));
  EXPECT_FALSE(drivecomLimitReached(0x4637));
}

TEST(Drivecom, ActualSpeedBecomesActualValueOne) {
  EXPECT_EQ(0x2000, fiftyHertz().fromDrivecom({0x0637, 750}).actual_values[0]);
  EXPECT_EQ(-0x4000, fiftyHertz().fromDrivecom({0x4637, -1500}).actual_values[0]);
}

TEST(Drivecom, StatesKeepTheirMeaning) {
  EXPECT_EQ(DriveState::kSwitchOnDisabled, translated(0x0270));
  EXPECT_EQ(DriveState::kReadyToSwitchOn, translated(0x0631));
  EXPECT_EQ(DriveState::kOperationEnabled, translated(0x4E37));
  EXPECT_EQ(DriveState::kFault, translated(0x0218));
}

// The same for every word: the drive layer sees the state that the inverter meant.
RC_GTEST_PROP(Drivecom, TheTranslatedWordSpellsTheSameState, ()) {
  const auto word = static_cast<Word>(*rc::gen::inRange<unsigned>(1, 0x10000));
  RC_ASSERT(translated(word) == stateOf(word));
}

// Whatever the drive layer commands, bit 1 (voltage) falls only when it asked for it: the wheel never coasts by the way.
RC_GTEST_PROP(Drivecom, VoltageIsBlockedOnlyWhenAsked, ()) {
  const auto word = static_cast<Word>(*rc::gen::inRange<unsigned>(0, 0x10000));
  const bool asked = (word & 0x0400u) != 0 && (word & 0x0002u) == 0;
  RC_ASSERT(((output(word).control_word & 0x0002u) == 0) == asked);
}

// What goes out as a speed comes back as the same share, within one rpm.
RC_GTEST_PROP(Drivecom, ASpeedComesBackAsItWasSent, ()) {
  const auto share = static_cast<std::int16_t>(*rc::gen::inRange(-16384, 16385));
  const std::int16_t rpm = output(0x047F, share).speed_setpoint;
  RC_ASSERT(std::abs(fiftyHertz().fromDrivecom({0x0637, rpm}).actual_values[0] - share) <= 11);
}

}  // namespace
}  // namespace nord_driver::profile
