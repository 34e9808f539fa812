#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

/// A drive in data exchange, in group 1, with Sync_Req and Freeze_Req as asked for.
class SyncFreeze : public ::testing::Test {
 protected:
  void start(std::uint8_t flags) {
    bus.service(60, {});
    bus.service(61, {flags, 10, 1, 11, 0x75, 0x31, 0x01});
    bus.service(62, {0xF3, 0xF1});
    bus.service(60, {});
    bus.pzdFor("047E 0000", milliseconds(20));
    ASSERT_EQ("0B 37 20 00", bus.pzdFor("047F 2000", seconds(2.0)));
  }
  void control(std::uint8_t command, std::uint8_t group = 0) {
    bus.askBytes(Conversation::variable(0xFF, 0x81, 0x46, {58, 62, command, group}), 40, 100);
  }
  double frequency() { return bus.drive().inverter().frequency(); }

  Conversation bus;
};

// SYNC freezes every output, the stop word too: it acts on the next SYNC, while data exchange feeds the watchdog
// (BU 2700 6.3).
TEST_F(SyncFreeze, SyncHoldsTheStopWord) {
  start(0x88 | 0x20);
  control(0x20);
  EXPECT_TRUE(bus.station().inSyncMode());
  bus.pzdFor("047E 0000", seconds(3.0));
  EXPECT_EQ(25.0, frequency());
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  control(0x20);
  bus.pzdFor("047E 0000", seconds(3.0));
  EXPECT_EQ(0.0, frequency());
  EXPECT_EQ("0B 31 00 00", bus.pzd("047E 0000"));
}

// UNSYNC hands the stored outputs on and ends the mode; it wins over SYNC in the same telegram.
TEST_F(SyncFreeze, UnsyncEndsIt) {
  start(0x88 | 0x20);
  control(0x20);
  bus.pzdFor("047E 0000", milliseconds(100));
  control(0x30);
  EXPECT_FALSE(bus.station().inSyncMode());
  bus.segment.run(milliseconds(5));
  EXPECT_LT(frequency(), 25.0);
  EXPECT_EQ(0x047E, bus.station().counters().last_control);
}

// Without Sync_Req in Set_Prm, for another group, or from nobody's master it is not for this station.
TEST_F(SyncFreeze, IsTakenOnlyWhenMeant) {
  start(0x88);
  control(0x20);
  control(0x08);
  EXPECT_FALSE(bus.station().inSyncMode());
  EXPECT_FALSE(bus.station().inFreezeMode());
  start(0x88 | 0x30);
  control(0x28, 0x02);
  EXPECT_FALSE(bus.station().inSyncMode());
  bus.askBytes(Conversation::variable(0xFF, 0x82, 0x46, {58, 62, 0x28, 0}), 40, 100);
  EXPECT_FALSE(bus.station().inSyncMode());
  control(0x28, 0x01);
  EXPECT_TRUE(bus.station().inSyncMode());
  EXPECT_TRUE(bus.station().inFreezeMode());
  // Watchdog, freeze and sync in the second byte of the diagnosis.
  EXPECT_EQ("00 3C 00 01 75 31", bus.service(60, {}).substr(27, 17));
}

// FREEZE makes the status word stale until the next FREEZE or UNFREEZE.
TEST_F(SyncFreeze, FreezeHoldsTheStatusWord) {
  start(0x88 | 0x10);
  control(0x08);
  EXPECT_EQ("0B 37 20 00", bus.pzdFor("047E 0000", seconds(3.0)));
  EXPECT_EQ(0.0, frequency());
  control(0x08);
  EXPECT_EQ("0B 31 00 00", bus.pzd("047E 0000"));
  bus.pzdFor("047F 2000", seconds(2.0));
  EXPECT_EQ("0B 31 00 00", bus.pzd("047F 2000"));
  control(0x04);
  EXPECT_EQ("0B 37 20 00", bus.pzd("047F 2000"));
}

// A station that leaves data exchange leaves both modes.
TEST_F(SyncFreeze, EndsWithDataExchange) {
  start(0x88 | 0x30);
  control(0x28);
  bus.segment.run(milliseconds(150));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
  EXPECT_FALSE(bus.station().inSyncMode());
  EXPECT_FALSE(bus.station().inFreezeMode());
}

// Clear_Data is no stop: bit 10 of a zero is 0, the drive runs on (BU 2700 7.1.1).
TEST_F(SyncFreeze, ClearIsNoStop) {
  start(0x88);
  control(0x02);
  bus.segment.run(milliseconds(50));
  EXPECT_EQ(25.0, frequency());
}

}  // namespace
}  // namespace nord_driver::sim
