#include <gtest/gtest.h>

#include "profile/control_word.h"

namespace nord_driver::profile {
namespace {

// The commanding words are those of BU 2700 6.4.1 and BU 0020 9, with bit 10 = 1 in each of them.
TEST(ControlWord, SpellsTheManualsCommands) {
  EXPECT_EQ(0x047E, controlWord(Command::kShutdown, 1));
  EXPECT_EQ(0x047F, controlWord(Command::kEnableOperation, 1));
  EXPECT_EQ(0x047B, controlWord(Command::kQuickStop, 1));
  EXPECT_EQ(0x047D, controlWord(Command::kDisableVoltage, 1));
}

// BU 2700 6.4.1: bits 0 to 12 in their order, bits 8 and 9 for P480 [-11] and [-12].
TEST(ControlWord, HasEachBitInItsPlace) {
  using namespace control_bit;
  const Word bits[] = {kOn,        kEnableVoltage,  kNoQuickStop, kEnableOperation, kEnableRamp,
                       kRunRamp,   kEnableSetpoint, kAcknowledge, kBusBit8,         kBusBit9,
                       kDataValid, kRight,          kLeft};
  for (unsigned i = 0; i < 13; ++i) EXPECT_EQ(1u << i, bits[i]) << "bit " << i;
}

// Bits 14 and 15 select the set: 00, 01, 10, 11 are sets 1 to 4.
TEST(ControlWord, CarriesTheParameterSetInItsTopBits) {
  EXPECT_EQ(0x447E, controlWord(Command::kShutdown, 2));
  EXPECT_EQ(0x847E, controlWord(Command::kShutdown, 3));
  EXPECT_EQ(0xC47F, controlWord(Command::kEnableOperation, 4));
  EXPECT_EQ(1, parameterSet(0x0B31));
  EXPECT_EQ(2, parameterSet(0x4B31));
  EXPECT_EQ(3, parameterSet(0x8B31));
  EXPECT_EQ(4, parameterSet(0xCB31));
  EXPECT_EQ(0x847E, withParameterSet(0xC47E, 3));
}

// The word that asks without commanding carries no set: it would be ignored anyway, and 0000 is recognised in a trace.
TEST(ControlWord, IgnoredWordIsZeroInEverySet) {
  EXPECT_EQ(0x0000, controlWord(Command::kIgnored, 1));
  EXPECT_EQ(0x0000, controlWord(Command::kIgnored, 3));
}

// Quick stop keeps bit 1: without it the word would be OFF2, and the motor would coast.
TEST(ControlWord, QuickStopKeepsTheVoltage) {
  EXPECT_NE(0, controlWord(Command::kQuickStop, 1) & control_bit::kEnableVoltage);
  EXPECT_EQ(0, controlWord(Command::kQuickStop, 1) & control_bit::kNoQuickStop);
}

}  // namespace
}  // namespace nord_driver::profile
