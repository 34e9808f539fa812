#include <gtest/gtest.h>

#include <string>

#include "transport/canopen/emergency.h"

namespace nord_driver::profile {
namespace {

// BU 0060 p. 93: a P513 time-out is sent as 00 81 01 ..; its code stands for E10.0 to E10.7.
TEST(Emergency, NamesTheFaultsACodeStandsFor) {
  EXPECT_STREQ("E10.0 .. E10.7", emergencyFaults(0x8100));
  EXPECT_STREQ("bus time-out or bus module", emergencyText(0x8100));
  EXPECT_STREQ("E2.0, E2.1, E2.2", emergencyFaults(0x4310));
  EXPECT_STREQ("E3.1", emergencyFaults(0x7112));
  EXPECT_STREQ("E6.0", emergencyFaults(0x3230));
}

// 1000h is a fault the module cannot name: P700 tells it.
TEST(Emergency, GivesNoNumberWhereTheManualGivesNone) {
  EXPECT_STREQ("", emergencyFaults(0x1000));
  EXPECT_STREQ("", emergencyFaults(0x7320));
  EXPECT_STREQ("position sensor", emergencyText(0x7320));
}

// Two options report 3.2 and 3.3 under different codes (BU 0060 p. 93, BU 0570 p. 37).
TEST(Emergency, KnowsBothCodesOfTheIgbtFaults) {
  EXPECT_STREQ(emergencyFaults(0x2211), emergencyFaults(0x2311));
  EXPECT_STREQ(emergencyFaults(0x2212), emergencyFaults(0x2312));
}

// A code no manual lists still has its class of CiA 301 7.2.7.1.
TEST(Emergency, FallsBackToTheClassOfACode) {
  EXPECT_STREQ("communication", emergencyText(0x8130));
  EXPECT_STREQ("protocol error: a PDO of the wrong length, for example", emergencyText(0x8210));
  EXPECT_STREQ("temperature", emergencyText(0x4200));
  EXPECT_STREQ("an error only its device knows", emergencyText(0xFF01));
  EXPECT_STREQ("a code neither CiA 301 nor a manual lists", emergencyText(0xB000));
  EXPECT_STREQ("", emergencyFaults(0x8130));
}

// The search relies on the order.
TEST(Emergency, TheTableIsSorted) {
  const EmergencyInfo* before = nullptr;
  for (const EmergencyInfo& row : emergencyTable()) {
    if (before != nullptr) {
      EXPECT_LT(before->code, row.code);
    }
    EXPECT_EQ(&row, findEmergency(row.code));
    before = &row;
  }
  EXPECT_EQ(nullptr, findEmergency(0x0001));
  EXPECT_EQ(nullptr, findEmergency(0xFFFF));
}

}  // namespace
}  // namespace nord_driver::profile
