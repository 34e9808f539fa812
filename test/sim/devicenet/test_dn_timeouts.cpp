// Who notices that the scanner is gone, and what the drives do then: BU 0280 4.1.3, 5 and 6.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

/// Runs at half the frequency.
void run(DnConversation& bus) {
  bus.connect();
  bus.poll("44D#00 7E 04 00 00", milliseconds(500));
  bus.poll("44D#00 7F 04 00 20", milliseconds(3000));
  ASSERT_NEAR(25.0, bus.drive().inverter().frequency(), 0.1);
}

// Four times the packet rate of 100 ms: E10.2 and 5220; acknowledged by the next allocation and an edge of bit 7.
TEST(DnTimeouts, PacketRate) {
  DnConversation bus{dnGateway()};
  run(bus);
  bus.bus.run(milliseconds(380));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  bus.bus.run(milliseconds(20));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
  EXPECT_EQ(5220, bus.module().parameters().value(170));
  EXPECT_EQ(4, bus.module().parameters().value(173) & 4);
  EXPECT_EQ("8E04", bus.request("0E 05 02 01")) << "timed out";
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00"));
  bus.referee().forget();  // the poll just now
  EXPECT_EQ("940CFF", bus.request("10 05 02 09 64 00")) << "it is over for good";
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 02"));
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 02 0A"));
  for (const char* order : {"0E 05 02 07", "0E 05 02 08", "10 05 02 09 64 00"}) bus.request(order);
  bus.poll("44D#00 7F 04 00 20", milliseconds(100));
  EXPECT_TRUE(bus.module().timedOut()) << "the inverter still stands in its fault";
  bus.poll("44D#00 FF 04 00 20", milliseconds(100));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  bus.poll("44D#00 7E 04 00 00", milliseconds(50));
  EXPECT_FALSE(bus.module().timedOut());
  EXPECT_EQ(0, bus.module().parameters().value(170));
  EXPECT_EQ(5220, bus.module().parameters().value(170, 0, 1)) << "the last one";
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// The same with P513 = -0.1: the inverter ignores it and runs on.
TEST(DnTimeouts, InverterThatIgnoresBusErrors) {
  DnConversation bus{dnGateway()};
  bus.drive().parameters().preset(513, 0, 0, -1);
  run(bus);
  bus.bus.run(milliseconds(2000));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.1);
}

// P151: words without bit 10, or no data at all, for that long; polling goes on.
TEST(DnTimeouts, ControlWordsThatAreNotValid) {
  for (const char* idle : {"44D#00 00 00 00 00", "44D#"}) {
    DnConversation bus{dnGateway()};
    bus.module().parameters().preset(151, 0, 0, 300);
    run(bus);
    bus.poll(idle, milliseconds(280));
    EXPECT_EQ(0, bus.drive().inverter().faultNumber()) << idle;
    bus.poll(idle, milliseconds(40));
    EXPECT_EQ(103, bus.drive().inverter().faultNumber()) << idle;
    EXPECT_EQ(1020, bus.module().parameters().value(170)) << idle;
  }
  DnConversation bus{dnGateway()};
  run(bus);
  bus.poll("44D#00 00 00 00 00", milliseconds(3000));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber()) << "P151 = 0: the drive runs on";
}

// Released, the packet rate watches no more; P151 does.
TEST(DnTimeouts, Release) {
  DnConversation bus{dnGateway()};
  bus.module().parameters().preset(151, 0, 0, 300);
  run(bus);
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 03"));
  bus.bus.run(milliseconds(320));
  EXPECT_EQ(103, bus.drive().inverter().faultNumber());
  DnConversation without{dnGateway()};
  run(without);
  EXPECT_EQ("44B#0ACC", without.ask("44E#0A 4C 03 01 03"));
  without.bus.run(milliseconds(5000));
  EXPECT_EQ(0, without.drive().inverter().faultNumber()) << "nothing watches";
}

// Behind SK CU4 and TU4 P513 counts for nothing; on a technology unit it watches, P151 is not there.
TEST(DnTimeouts, P513) {
  DnConversation gateway{dnGateway()};
  gateway.drive().parameters().preset(513, 0, 0, 2);
  run(gateway);
  gateway.poll("44D#00 00 00 00 00", milliseconds(1000));
  EXPECT_EQ(0, gateway.drive().inverter().faultNumber());
  DnConversation own;
  own.drive().parameters().preset(513, 0, 0, 2);
  run(own);
  own.poll("44D#00 00 00 00 00", milliseconds(220));
  EXPECT_EQ(103, own.drive().inverter().faultNumber());
}

TEST(DnTimeouts, PacketRateOfATechnologyUnit) {
  DnConversation bus;
  run(bus);
  bus.bus.run(milliseconds(410));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
}

TEST(DnTimeouts, P120) {
  DnConversation bus{dnGateway()};
  run(bus);
  bus.module().setPowered(false);
  bus.bus.run(milliseconds(20));
  EXPECT_EQ(109, bus.drive().inverter().faultNumber());
  DnConversation off{dnGateway()};
  off.drive().parameters().preset(120, 0, 0, 0);
  run(off);
  off.module().setPowered(false);
  off.bus.run(milliseconds(1000));
  EXPECT_EQ(0, off.drive().inverter().faultNumber()) << "P120 = 0";
}

// Unplugged: a technology unit goes with its inverter, a gateway lives on.
TEST(DnTimeouts, Unplugged) {
  DnConversation own;
  run(own);
  own.drive().setPlugged(false);
  own.bus.run(milliseconds(5));
  EXPECT_FALSE(own.module().alive());
  DnConversation gateway{dnGateway()};
  run(gateway);
  gateway.drive().setPlugged(false);
  EXPECT_EQ("3C9#0000000000", gateway.ask("44D#00 7E 04 00 00"));
}

}  // namespace
}  // namespace nord_driver::sim
