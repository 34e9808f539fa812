#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "profile/status_word.h"

namespace nord_driver::profile {
namespace {

DriveState stateOf(Word word) {
  return StatusWord(word).state();
}

// BU 2700 6.4.3, "Decoded frequency inverter statuses", each row with its X bits 0 and 1.
TEST(StatusWord, DecodesEveryRowOfTheManualsTable) {
  for (const int word : {0x00, 0x10, 0x20, 0x30})
    EXPECT_EQ(DriveState::kNotReadyToSwitchOn, stateOf(static_cast<Word>(word)));
  for (const int word : {0x40, 0x50, 0x60, 0x70})
    EXPECT_EQ(DriveState::kSwitchOnDisabled, stateOf(static_cast<Word>(word)));
  EXPECT_EQ(DriveState::kReadyToSwitchOn, stateOf(0x31));
  EXPECT_EQ(DriveState::kSwitchedOn, stateOf(0x33));
  EXPECT_EQ(DriveState::kOperationEnabled, stateOf(0x37));
  for (const int word : {0x08, 0x18, 0x28, 0x38}) EXPECT_EQ(DriveState::kFault, stateOf(static_cast<Word>(word)));
  for (const int word : {0x0F, 0x1F, 0x2F, 0x3F})
    EXPECT_EQ(DriveState::kFaultReactionActive, stateOf(static_cast<Word>(word)));
  EXPECT_EQ(DriveState::kQuickStopActive, stateOf(0x17));
}

// The telegram examples of BU 2700 6.6 and BU 0070 7.2; bits 7 to 15 vary and never matter.
TEST(StatusWord, DecodesTheManualsTelegrams) {
  EXPECT_EQ(DriveState::kSwitchOnDisabled, stateOf(0x0B70));
  EXPECT_EQ(DriveState::kReadyToSwitchOn, stateOf(0x0B31));
  EXPECT_EQ(DriveState::kOperationEnabled, stateOf(0x0B37));
  EXPECT_EQ(DriveState::kOperationEnabled, stateOf(0x0F37));
  for (unsigned high = 0; high < 512; ++high) {
    EXPECT_EQ(DriveState::kReadyToSwitchOn, stateOf(static_cast<Word>(high << 7 | 0x31)));
  }
}

TEST(StatusWord, CallsABitPatternOfNoRowUnknown) {
  EXPECT_EQ(DriveState::kUnknown, stateOf(0x0002));
  EXPECT_EQ(DriveState::kUnknown, stateOf(0x0071));
}

// Each accessor is exactly one bit (BU 2700 6.4.2).
TEST(StatusWord, NamesEachBit) {
  using Accessor = bool (StatusWord::*)() const noexcept;
  const Accessor accessors[] = {
      &StatusWord::readyToSwitchOn,
      &StatusWord::switchedOn,
      &StatusWord::operationEnabled,
      &StatusWord::fault,
      &StatusWord::voltageEnabled,
      &StatusWord::quickStopInactive,
      &StatusWord::switchOnDisabled,
      &StatusWord::warning,
      &StatusWord::setpointReached,
      &StatusWord::busControl,
      &StatusWord::bit10,
      &StatusWord::directionRight,
      &StatusWord::directionLeft,
      &StatusWord::bit13,
  };
  for (unsigned bit = 0; bit < 14; ++bit) {
    const StatusWord one(static_cast<Word>(1u << bit));
    for (unsigned i = 0; i < 14; ++i) EXPECT_EQ(i == bit, (one.*accessors[i])()) << "bit " << bit << ", accessor " << i;
  }
  EXPECT_EQ(3, StatusWord(0x8B31).parameterSet());
}

// A bus module under 24 V answers for an inverter that is off; its zeros are no state of the inverter.
TEST(StatusWord, AllZeroIsNotUseful) {
  EXPECT_FALSE(StatusWord(0x0000).isUseful());
  EXPECT_TRUE(StatusWord(0x0B70).isUseful());
  EXPECT_TRUE(StatusWord(0x0230).isUseful());
}

TEST(StatusWord, NamesTheStates) {
  EXPECT_EQ(std::string("ready to switch on"), toString(DriveState::kReadyToSwitchOn));
  EXPECT_EQ(std::string("unknown"), toString(DriveState::kUnknown));
}

}  // namespace
}  // namespace nord_driver::profile
