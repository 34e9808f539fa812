#include <gtest/gtest.h>

#include "sim/canopen/can_emergency.h"

namespace nord_driver::sim {
namespace {

// The table of BU 0060 p. 93, and where it is cut off that of BU 0570 p. 37.
TEST(CanEmergency, CodesOfTheFaults) {
  EXPECT_EQ(0x4210, emergencyCode(10));
  EXPECT_EQ(0x4310, emergencyCode(21));
  EXPECT_EQ(0x2310, emergencyCode(30));
  EXPECT_EQ(0x7112, emergencyCode(31));
  EXPECT_EQ(0x2211, emergencyCode(32));
  EXPECT_EQ(0x2212, emergencyCode(33));
  EXPECT_EQ(0x2200, emergencyCode(41));
  EXPECT_EQ(0x3210, emergencyCode(50));
  EXPECT_EQ(0x3110, emergencyCode(51));
  EXPECT_EQ(0x3230, emergencyCode(60));
  EXPECT_EQ(0x3120, emergencyCode(61));
  EXPECT_EQ(0x3130, emergencyCode(70));
  EXPECT_EQ(0x6310, emergencyCode(80));
  EXPECT_EQ(0x5530, emergencyCode(82));
  EXPECT_EQ(0x8100, emergencyCode(100));
  EXPECT_EQ(0x8100, emergencyCode(107));
  EXPECT_EQ(0x5000, emergencyCode(108));
  EXPECT_EQ(0x5110, emergencyCode(110));
  EXPECT_EQ(0x7305, emergencyCode(130));
  EXPECT_EQ(0x1000, emergencyCode(190)) << "unknown to the module: read P700";
}

// 1003h: the newest first, the oldest falls off, emptied by writing 0.
TEST(CanEmergency, History) {
  CanEmergencyState state;
  for (std::uint16_t code = 1; code <= 6; ++code) state.remember(code);
  EXPECT_EQ(4, state.count());
  EXPECT_EQ(6u, state.entry(0));
  EXPECT_EQ(3u, state.entry(3));
  state.forget();
  EXPECT_EQ(0, state.count());
}

}  // namespace
}  // namespace nord_driver::sim
