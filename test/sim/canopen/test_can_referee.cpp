#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

class CanRefereeTest : public testing::Test {
 protected:
  CanRefereeTest() { bus.boot(); }
  /// How often `rule` was broken, when nothing else was.
  std::uint64_t only(CanRule rule) {
    bus.bus.run(milliseconds(20));
    return bus.referee().total() == bus.referee().count(rule) ? bus.referee().count(rule) : 0;
  }
  CanConversation bus;
};

TEST_F(CanRefereeTest, Nmt) {
  bus.send("000#0132AA");
  EXPECT_EQ(1u, only(CanRule::kNmtLength));
  bus.referee().forget();
  bus.send("000#0332");
  EXPECT_EQ(1u, only(CanRule::kNmtCommand));
  bus.referee().forget();
  bus.send("000#0105");
  EXPECT_EQ(1u, only(CanRule::kNmtUnknownNode));
}

TEST_F(CanRefereeTest, Identifiers) {
  CanFrame extended = nord_driver::frame("632#40");
  extended.extended = true;
  bus.bus.send(extended);
  EXPECT_EQ(1u, only(CanRule::kExtendedFrame));
  bus.referee().forget();
  for (const char* text : {"0B2#00", "1B2#00000000", "5B2#4000000000000000", "732#05"}) bus.send(text);
  EXPECT_EQ(4u, only(CanRule::kIdOfANode));
  bus.referee().forget();
  bus.send("2B2#00");  // the TPDO that is off
  bus.send("7E5#00");  // LSS
  EXPECT_EQ(2u, only(CanRule::kUnknownId));
  bus.referee().forget();
  for (const char* text : {"701#05", "080#", "605#4000100000000000", "705#R1"}) bus.send(text);
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(CanRefereeTest, Lengths) {
  bus.send("080#0102");
  EXPECT_EQ(1u, only(CanRule::kSyncLength));
  bus.referee().forget();
  bus.send("632#40");
  EXPECT_EQ(1u, only(CanRule::kSdoLength));
  bus.referee().forget();
  bus.send("732#R8");
  EXPECT_EQ(1u, only(CanRule::kRemoteLength));
}

// A node that fell back to pre-operational by itself: a few RPDOs were on their way, then the master must have noticed.
TEST_F(CanRefereeTest, RpdoAfterTheNodeHasTold) {
  bus.sdo("2B 17 10 00 0A 00 00 00");  // heartbeat every 10 ms
  bus.start();
  bus.repeat("232#7E040000", milliseconds(100), "1B2");
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.drive().setPlugged(false);
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  EXPECT_TRUE(bus.referee().content()) << "it cannot know";
  bus.drive().setPlugged(true);
  bus.bus.run(milliseconds(150));  // the boot-up message
  for (int i = 0; i < 3; ++i) bus.send("232#7E040000");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.send("232#7E040000");
  EXPECT_EQ(1u, only(CanRule::kRpdoBeforeOperational));
}

// Somebody else has started it, or a command of ours was lost: it says itself what it hears.
TEST_F(CanRefereeTest, RpdoToANodeThatSaysThatItIsOperational) {
  bus.sdo("2B 17 10 00 0A 00 00 00");  // heartbeat every 10 ms
  bus.bus.inject(nord_driver::frame("000#0132"));
  bus.bus.run(milliseconds(50));
  bus.send("232#7E040000");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.send("000#8032");
  bus.send("232#7E040000");
  EXPECT_EQ(1u, only(CanRule::kRpdoBeforeOperational)) << "not before it says so again";
}

// A node that was kept from running: the master's words of before, and those without bit 10 with which it begins anew,
// are taken together; a tenth of a second later it must know.
TEST_F(CanRefereeTest, ZeroControlWordAfterAStandstill) {
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.bus.stations().stoodStill();
  for (const char* text : {"232#7E040000", "232#7E040000", "232#00000000", "232#00000000", "232#7E040000"})
    bus.send(text);
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.repeat("232#7E040000", milliseconds(100), "1B2");
  bus.send("232#00000000");
  EXPECT_EQ(1u, only(CanRule::kZeroControlWord));
}

TEST_F(CanRefereeTest, Report) {
  EXPECT_EQ("no rule broken", bus.referee().report());
  bus.send("000#0132AA");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ("1 x an NMT command that is not two bytes long (CiA 301 7.2.8.2.1)", bus.referee().report());
}

}  // namespace
}  // namespace nord_driver::sim
