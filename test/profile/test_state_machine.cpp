#include <gtest/gtest.h>

#include <set>

#include "profile/state_machine.h"

namespace nord_driver::profile {
namespace {

int numberOf(DriveState state, Word now, Word before = 0x047E) {
  const Transition* transition = transitionFor(state, now, before);
  return transition == nullptr ? 0 : transition->number;
}

TEST(StateMachine, HasTheManualsFifteenTransitions) {
  std::set<int> numbers;
  for (const Transition& row : transitions()) numbers.insert(row.number);
  EXPECT_EQ(15u, numbers.size());
  EXPECT_EQ(1, *numbers.begin());
  EXPECT_EQ(15, *numbers.rbegin());
}

// The way up: 047E leaves "switch-on disabled", 047F goes through "switched on".
TEST(StateMachine, FollowsTheManualsStart) {
  EXPECT_EQ(2, numberOf(DriveState::kSwitchOnDisabled, 0x047E));
  EXPECT_EQ(3, numberOf(DriveState::kReadyToSwitchOn, 0x047F));
  EXPECT_EQ(4, numberOf(DriveState::kSwitchedOn, 0x047F));
  EXPECT_EQ(0, numberOf(DriveState::kSwitchOnDisabled, 0x047F));
}

TEST(StateMachine, KnowsEachWayOutOfOperationEnabled) {
  EXPECT_EQ(8, numberOf(DriveState::kOperationEnabled, 0x047E));
  EXPECT_EQ(9, numberOf(DriveState::kOperationEnabled, 0x047D));
  EXPECT_EQ(11, numberOf(DriveState::kOperationEnabled, 0x047B));
  EXPECT_EQ(5, numberOf(DriveState::kOperationEnabled, 0x0477));
  EXPECT_EQ(0, numberOf(DriveState::kOperationEnabled, 0x047F));
}

// Bits 1 and 2 cleared together are OFF2, the higher priority: the motor coasts (BU 2700 6.4.1).
TEST(StateMachine, DisableVoltageBeatsQuickStop) {
  EXPECT_EQ(9, numberOf(DriveState::kOperationEnabled, 0x0479));
}

// "Operation enabled" needs bits 0 to 6 all 1 (no. 4).
TEST(StateMachine, EnablesOnlyWithAllSevenBits) {
  for (unsigned bit = 0; bit < 7; ++bit) {
    EXPECT_NE(4, numberOf(DriveState::kSwitchedOn, static_cast<Word>(0x047F & ~(1u << bit)))) << "bit " << bit;
  }
}

TEST(StateMachine, AcknowledgesOnTheEdgeOnly) {
  EXPECT_EQ(15, numberOf(DriveState::kFault, 0x04FE, 0x047E));
  EXPECT_EQ(0, numberOf(DriveState::kFault, 0x04FE, 0x04FE));
  EXPECT_EQ(0, numberOf(DriveState::kFault, 0x047E, 0x04FE));
}

// Bit 10 = 0: nothing is evaluated, neither zeros nor a stop without it (BU 2700 6.4.3, information).
TEST(StateMachine, IgnoresWordsWithoutBit10) {
  EXPECT_EQ(0, numberOf(DriveState::kOperationEnabled, 0x0000));
  EXPECT_EQ(0, numberOf(DriveState::kOperationEnabled, 0x007E));
}

TEST(StateMachine, LeadsOutOfQuickStopOnlyByDisablingTheVoltage) {
  EXPECT_EQ(12, numberOf(DriveState::kQuickStopActive, 0x047D));
  EXPECT_EQ(0, numberOf(DriveState::kQuickStopActive, 0x047F));
}

}  // namespace
}  // namespace nord_driver::profile
