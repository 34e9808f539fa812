#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

// After power-on: the boot-up message, then pre-operational; no process data (BU 0060 p. 57).
TEST(CanNode, BootsUp) {
  CanConversation bus;
  EXPECT_EQ(Frames{"732#00"}, bus.takeAfter(milliseconds(500)));
  EXPECT_EQ(NmtState::kPreOperational, bus.node().state());
  EXPECT_EQ("", bus.ask("232#7E040000"));
  EXPECT_EQ(1u, bus.referee().count(CanRule::kRpdoBeforeOperational));
}

// The trace of BU 0060 p. 96, byte for byte.
TEST(CanNode, TraceOfTheManual) {
  CanConversation bus;
  bus.boot();
  bus.send("000#0132");
  EXPECT_EQ(Frames{"1B2#700B0000"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ("1B2#310B0000", bus.ask("232#7E040000"));
  EXPECT_EQ("1B2#370B0020", bus.repeat("232#7F040020", seconds(2.0), "1B2"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.01);
}

// P102, set 1, is written with 1.03 s: BU 0060 p. 61; read back as 16 bits.
TEST(CanNode, ParameterOfTheManual) {
  CanConversation bus;
  bus.boot();
  EXPECT_EQ("6066200100000000", bus.sdo("2B 66 20 01 67 00 00 00"));
  EXPECT_EQ("4B66200167000000", bus.sdo("40 66 20 01 00 00 00 00"));
  EXPECT_EQ(103, bus.drive().parameters().value(102, 0));
  EXPECT_EQ(200, bus.drive().parameters().value(102, 1));
  EXPECT_EQ(1u, bus.drive().parameters().eepromWrites());
}

TEST(CanNode, NmtCommands) {
  CanConversation bus;
  bus.boot();
  bus.start();
  EXPECT_EQ(NmtState::kOperational, bus.node().state());
  bus.send("000#0200");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(NmtState::kStopped, bus.node().state());
  bus.send("000#8032");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(NmtState::kPreOperational, bus.node().state());
  bus.send("000#0131");  // another node's
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(NmtState::kPreOperational, bus.node().state());
  EXPECT_EQ(1u, bus.referee().count(CanRule::kNmtUnknownNode));
  bus.send("000#8132");
  EXPECT_EQ(Frames{"732#00"}, bus.takeAfter(milliseconds(200)));
  bus.send("000#8200");
  EXPECT_EQ(Frames{"732#00"}, bus.takeAfter(milliseconds(200)));
}

// A stopped node answers no SDO, only guarding.
TEST(CanNode, StoppedNodeIsSilent) {
  CanConversation bus;
  bus.boot();
  bus.send("000#0232");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ("", bus.sdo("40 00 10 00 00 00 00 00"));
  EXPECT_EQ(1u, bus.referee().count(CanRule::kSdoToStopped));
  EXPECT_EQ("732#04", bus.ask("732#R1"));
}

// Guarding: state with a toggle bit; heartbeat: state without, every 1017h milliseconds (CiA 301 7.2.8.3).
TEST(CanNode, GuardingAndHeartbeat) {
  CanConversation bus;
  bus.boot();
  EXPECT_EQ("732#7F", bus.ask("732#R1"));
  EXPECT_EQ("732#FF", bus.ask("732#R1"));
  bus.start();
  EXPECT_EQ("732#05", bus.ask("732#R1"));
  bus.sdo("2B 17 10 00 32 00 00 00");  // 50 ms
  EXPECT_EQ((Frames{"732#05", "732#05", "732#05", "732#05"}), bus.takeAfter(milliseconds(210)));
  EXPECT_TRUE(bus.referee().content());
  bus.send("732#R1");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(1u, bus.referee().count(CanRule::kGuardingBesideHeartbeat));
}

/// Enabled with 50 %.
void driveOn(CanConversation& bus) {
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.repeat("232#7F040020", seconds(2.0), "1B2");
  ASSERT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state());
}

// Life guarding: 100Ch x 100Dh without a request, and the inverter trips with E10.0: 8100h, register 01
// (BU 0060 p. 93).
TEST(CanNode, LifeGuardingStopsTheDrive) {
  CanConversation bus;
  bus.boot();
  bus.sdo("2B 0C 10 00 64 00 00 00");  // 100 ms
  bus.sdo("2F 0D 10 00 02 00 00 00");  // twice
  driveOn(bus);
  EXPECT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state()) << "not before the first request";
  bus.ask("732#R1");
  bus.take();
  EXPECT_EQ(Frames{}, bus.takeAfter(milliseconds(170)));
  const Frames frames = bus.takeAfter(milliseconds(50));
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ("0B2#0081010000000000", frames.front());
  EXPECT_EQ(100, bus.drive().inverter().faultNumber());
  EXPECT_EQ(NmtState::kPreOperational, bus.node().state());
  EXPECT_EQ("4F01100001000000", bus.sdo("40 01 10 00 00 00 00 00"));
  EXPECT_EQ("4303100100810000", bus.sdo("40 03 10 01 00 00 00 00"));
  EXPECT_EQ("4BBC220164000000", bus.sdo("40 BC 22 01 00 00 00 00")) << "P700[-01]";
}

// P513 = -0.1: the inverter ignores all bus errors (BU 2700 7.1.1).
TEST(CanNode, P513LetsItRunOn) {
  SimConfig config = oneCanDrive();
  config.drives[0].parameters.push_back({513, 0, 0, -1});
  CanConversation bus{config};
  bus.boot();
  bus.sdo("2B 0C 10 00 64 00 00 00");
  bus.sdo("2F 0D 10 00 02 00 00 00");
  driveOn(bus);
  bus.ask("732#R1");
  bus.bus.run(seconds(1.0));
  EXPECT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state());
  EXPECT_EQ(1u, bus.node().counters().masters_lost);
}

// The heartbeat consumer (1016h) does the same, from the first heartbeat of the master on.
TEST(CanNode, HeartbeatConsumerStopsTheDrive) {
  CanConversation bus;
  bus.boot();
  EXPECT_EQ("6016100100000000", bus.sdo("23 16 10 01 C8 00 01 00"));  // node 1, 200 ms
  driveOn(bus);
  for (int i = 0; i < 10; ++i) {
    bus.send("701#05");
    bus.repeat("232#7F040020", milliseconds(100), "1B2");
  }
  EXPECT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state());
  bus.repeat("232#7F040020", milliseconds(210), "1B2");
  EXPECT_EQ(InverterState::kFault, bus.drive().inverter().state());
}

// P513 = 0.5 s: control words must keep coming; E10.0 as over PROFIBUS, and code 0 after the acknowledgement.
TEST(CanNode, TelegramTimeout) {
  SimConfig config = oneCanDrive();
  config.drives[0].parameters.push_back({513, 0, 0, 5});
  CanConversation bus{config};
  bus.boot();
  driveOn(bus);
  bus.bus.run(milliseconds(450));
  EXPECT_EQ(InverterState::kOperationEnabled, bus.drive().inverter().state());
  bus.take();
  bus.bus.run(milliseconds(100));
  EXPECT_EQ(InverterState::kFault, bus.drive().inverter().state());
  EXPECT_EQ("0B2#0081010000000000", bus.take().front());
  // Taking the enable away acknowledges (BU 0020 8).
  EXPECT_EQ("0B2#0000000000000000", bus.repeat("232#7E040000", milliseconds(50), "0B2"));
  EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive().inverter().state());
}

// A station without mains is silent; when it is back it boots.
TEST(CanNode, UnpluggedAndBack) {
  CanConversation bus;
  bus.boot();
  bus.start();
  bus.drive().setPlugged(false);
  EXPECT_EQ("", bus.ask("732#R1"));
  bus.drive().setPlugged(true);
  const Frames frames = bus.takeAfter(milliseconds(500));
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ("732#00", frames.front());
  EXPECT_EQ(NmtState::kPreOperational, bus.node().state());
}

// Wrong identity, as the master's configuration has it: 1018h.
TEST(CanNode, Identity) {
  CanConversation bus;
  bus.boot();
  CanIdentity identity;
  identity.vendor = 0x12345678;
  bus.node().setIdentity(identity);
  EXPECT_EQ("4318100178563412", bus.sdo("40 18 10 01 00 00 00 00"));
  EXPECT_EQ("4F18100004000000", bus.sdo("40 18 10 00 00 00 00 00"));
}

}  // namespace
}  // namespace nord_driver::sim
