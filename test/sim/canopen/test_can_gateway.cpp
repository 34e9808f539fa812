#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

/// FI1, FI2 and FI4 of SK 2xxE behind the module with node id 5; nothing is connected as FI3.
SimConfig gateway(bool servers_set = false) {
  SimConfig config = oneCanDrive();
  config.drives.clear();
  for (const unsigned inverter : {1u, 2u, 4u}) {
    DriveConfig drive;
    drive.name = "fi" + std::to_string(inverter);
    drive.address = 5;
    drive.device.series = Series::kSk2xxe;
    CanDriveConfig can;
    can.connection = CanConnection::kGateway;
    drive.place = inverter;
    can.servers_set = servers_set;
    drive.bus = can;
    config.drives.push_back(drive);
  }
  return config;
}

class CanGateway : public testing::Test {
 protected:
  CanGateway() { bus.boot(); }
  std::string ask(const std::string& request, const std::string& id) {
    bus.take();
    bus.send(request);
    for (const std::string& text : bus.takeAfter(milliseconds(20))) {
      if (text.substr(0, 3) == id) return text.substr(4);
    }
    return "";
  }
  std::string sdo(const std::string& data) { return ask("605#" + data, "585"); }
  CanConversation bus{gateway()};
};

// PDO n is inverter n's: status word and three actual values; 3000h:n, 3002h:3n-2.. (BU 0260 p. 40-42).
TEST_F(CanGateway, OnePdoForEachInverter) {
  EXPECT_EQ("43001A0110010130", sdo("40001A0100000000"));
  EXPECT_EQ("43021A0210070330", sdo("40021A0200000000"));
  EXPECT_EQ("4303160110040030", sdo("4003160100000000"));
  EXPECT_EQ("43031604100C0230", sdo("4003160400000000"));
  bus.send("000#0105");
  const Frames frames = bus.takeAfter(milliseconds(20));
  EXPECT_EQ((Frames{"185#700B000000000000", "285#700B000000000000", "385#0000000000000000", "485#700B000000000000"}),
            frames);
  EXPECT_EQ("310B000000000000", ask("305#7E04000000000000", "285"));
  EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive(1).inverter().state());
  EXPECT_EQ(InverterState::kSwitchOnDisabled, bus.drive(0).inverter().state());
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// 10 ms inhibit time, 250 ms event timer: BU 0260 p. 41. The module's own PDO is there, and off.
TEST_F(CanGateway, TimesAndTheModulesOwnPdo) {
  EXPECT_EQ("4B00180364000000", sdo("4000180300000000"));
  EXPECT_EQ("4B001805FA000000", sdo("4000180500000000"));
  EXPECT_EQ("43041801000000C0", sdo("4004180100000000"));
  EXPECT_EQ("43041A0108010430", sdo("40041A0100000000"));
}

// Inputs and outputs of the module go with the fifth PDO, once the master has given it an identifier.
TEST_F(CanGateway, InputsAndOutputs) {
  EXPECT_EQ("60", sdo("2304180185060040").substr(0, 2));
  EXPECT_EQ("60", sdo("23041401A5060000").substr(0, 2));
  bus.node().setModuleInputs(0x05);
  bus.send("000#0105");
  bus.bus.run(milliseconds(20));
  EXPECT_EQ("685#05", bus.take().back());
  bus.send("6A5#02");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(0x02, bus.node().moduleOutputs());
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// One SDO server for each inverter (1200h-1203h); all but the first are the master's to set.
TEST_F(CanGateway, ServersOfTheInverters) {
  bus.drive(0).parameters().preset(102, 0, 0, 111);
  bus.drive(1).parameters().preset(102, 0, 0, 222);
  EXPECT_EQ("4301120100000080", sdo("4001120100000000"));
  EXPECT_EQ("6001120100000000", sdo("2301120145060000"));
  EXPECT_EQ("6001120200000000", sdo("23011202C5050000"));
  EXPECT_EQ("4B6620016F000000", sdo("4066200100000000"));
  EXPECT_EQ("4B662001DE000000", ask("645#4066200100000000", "5C5"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST(CanGatewayServers, AsDeliveredWithIdentifiers) {
  CanConversation bus{gateway(true)};
  bus.boot();
  bus.drive(2).parameters().preset(102, 0, 0, 444);
  EXPECT_EQ("588#4B662001BC010000", bus.ask("608#4066200100000000"));
  EXPECT_EQ("587#8066200100000606", bus.ask("607#4066200100000000")) << "nothing is connected as FI3";
}

// A fault of one inverter: byte 3 of the message is its number 0-3 (BU 0260 p. 78), 1001h is 1 while any is faulty.
TEST_F(CanGateway, Emergencies) {
  bus.drive(2).inverter().trip(31, false);
  EXPECT_EQ(Frames{"085#1271010300000000"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ("4F01100001000000", sdo("4001100000000000"));
  bus.drive(2).inverter().acknowledge();
  EXPECT_EQ(Frames{"085#0000000300000000"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ("4F01100000000000", sdo("4001100000000000"));
}

// One of them goes missing: its status word is 0, 1001h is 1 (BU 0260 p. 50), the others work on; E10.9 stays away as
// the inverter itself is off.
TEST_F(CanGateway, OneInverterMissing) {
  bus.send("000#0105");
  bus.bus.run(milliseconds(20));
  bus.take();
  bus.drive(1).setPlugged(false);
  const Frames frames = bus.takeAfter(milliseconds(20));
  EXPECT_EQ((Frames{"085#0010010100000000", "285#0000000000000000"}), frames);
  EXPECT_TRUE(bus.node().alive());
  EXPECT_EQ("310B000000000000", ask("205#7E04000000000000", "185"));
  bus.drive(1).setPlugged(true);
  bus.bus.run(seconds(1.0));
  EXPECT_EQ("4F01100000000000", sdo("4001100000000000"));
  for (std::size_t i = 0; i < 3; ++i) bus.drive(i).setPlugged(false);
  EXPECT_EQ("", sdo("4001100000000000")) << "nobody is there any more";
}

// The 24 V of the gateway off: it says and hears nothing, and its inverters miss it, each with E10.9 (P120), as behind
// the sister modules; on again it boots up with what is stored. The inverters have their mains all the while.
TEST_F(CanGateway, ItsOwnSupply) {
  bus.send("000#0105");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.drive(0).inDataExchange());
  EXPECT_EQ(Supply::kOwn, bus.drive(0).module().supply());
  EXPECT_EQ(&bus.drive(0).module(), &bus.drive(2).module());
  bus.drive(0).module().setPowered(false);
  bus.take();
  EXPECT_EQ(Frames{}, bus.takeAfter(seconds(1.0)));
  EXPECT_EQ("", sdo("4001100000000000"));
  EXPECT_EQ("", bus.ask("705#R1"));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(bus.drive(i).inverter().powered());
    EXPECT_FALSE(bus.drive(i).inDataExchange());
    EXPECT_EQ(fault::kNoModule, bus.drive(i).inverter().faultNumber());
  }
  bus.drive(2).module().setPowered(true);
  EXPECT_EQ("705#00", bus.takeAfter(milliseconds(150)).front()) << "the boot-up message";
  EXPECT_EQ("4F01100001000000", sdo("4001100000000000"));
  EXPECT_TRUE(bus.drive(1).inverter().acknowledge()) << "the cause is gone";
  EXPECT_EQ("60", sdo("2B0C1000FA000000").substr(0, 2));
  bus.send("000#0105");
  EXPECT_EQ("310B000000000000", ask("305#7E04000000000000", "285"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Its answers are lost or late, whichever of its drives is asked to do so.
TEST_F(CanGateway, MuteAndLate) {
  bus.drive(1).setMute(true);
  EXPECT_TRUE(bus.node().mute());
  EXPECT_EQ("", sdo("4001100000000000"));
  bus.drive(2).setMute(false);
  EXPECT_EQ("4F01100000000000", sdo("4001100000000000"));
  bus.drive(1).setAnswerDelay(milliseconds(50));
  EXPECT_EQ("", sdo("4001100000000000"));
  EXPECT_EQ(Frames{"585#4F01100000000000"}, bus.takeAfter(milliseconds(50)));
}

// 1010h stores, 1011h brings back what was delivered (BU 0260 p. 50), both counted from the next reset.
TEST_F(CanGateway, StoreAndRestore) {
  EXPECT_EQ("60", sdo("2B0C1000FA000000").substr(0, 2));
  EXPECT_EQ("8010100120000008", sdo("2310100100000000")) << "not without the signature";
  EXPECT_EQ("60", sdo("2310100173617665").substr(0, 2));
  EXPECT_EQ("60", sdo("2B0C100001000000").substr(0, 2));
  bus.send("000#8205");
  bus.bus.run(milliseconds(200));
  EXPECT_EQ("4B0C1000FA000000", sdo("400C100000000000"));
  EXPECT_EQ("60", sdo("231110016C6F6164").substr(0, 2));
  EXPECT_EQ("4B0C1000FA000000", sdo("400C100000000000"));
  bus.send("000#8105");
  bus.bus.run(milliseconds(200));
  EXPECT_EQ("4B0C100000000000", sdo("400C100000000000"));
}

/// All three enabled by their first PDO; the module has been told what to watch.
void enableAll(CanConversation& bus) {
  bus.send("000#0105");
  bus.bus.run(milliseconds(20));
  for (const char* words : {"7E04000000000000", "7F04002000000000"}) {
    for (int i = 0; i < 20; ++i) {
      for (const char* id : {"205#", "305#", "505#"}) bus.send(std::string(id) + words);
      bus.bus.run(milliseconds(5));
    }
  }
}

// P153 [-01] and [-02] of the sister module (BU 2700 7.1.1, BU 0220 5.2.1).
TEST_F(CanGateway, PausesOnTheSystemBusAreThoseOfTheFactory) {
  EXPECT_EQ(10, bus.node().module()->parameters().value(153, 0, 0)) << "ms, TxSDO";
  EXPECT_EQ(5, bus.node().module()->parameters().value(153, 0, 1)) << "ms, TxPDO";
}

// P151 of the module: no valid control word for any of the inverters for that long, and all trip with E10.3; the module
// stays in the time-out until each is acknowledged (BU 2700 7.1.1, BU 0220 4.2.3.2). P513 is not looked at.
TEST_F(CanGateway, P151StopsAll) {
  EXPECT_EQ("6097200000000000", sdo("2B972000C8000000"));  // 200 ms
  for (std::size_t i = 0; i < 3; ++i) bus.drive(i).parameters().preset(513, 0, 0, 1);
  enableAll(bus);
  bus.repeat("205#7F04002000000000", milliseconds(500), "185");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(InverterState::kOperationEnabled, bus.drive(i).inverter().state());
  bus.bus.run(milliseconds(210));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(103, bus.drive(i).inverter().faultNumber());
  EXPECT_TRUE(bus.node().module()->timedOut());
  EXPECT_EQ("4BAA2001FC030000", sdo("40AA200100000000")) << "P170[-01] = 102.0";
  bus.repeat("205#7E04000000000000", milliseconds(20), "185");
  bus.repeat("305#7E04000000000000", milliseconds(20), "285");
  EXPECT_TRUE(bus.node().module()->timedOut());
  bus.repeat("505#7E04000000000000", milliseconds(20), "485");
  EXPECT_FALSE(bus.node().module()->timedOut());
}

// A lost master (life guarding): E10.2 with P151 = 0, nothing with -1: the table of BU 2700 7.1.1.
TEST_F(CanGateway, LifeGuardingByP151) {
  for (const bool watched : {true, false}) {
    EXPECT_EQ("6097200000000000", sdo(watched ? "2B97200000000000" : "2B972000FFFF0000"));
    sdo("2B0C100064000000");
    sdo("2F0D100002000000");
    enableAll(bus);
    bus.send("705#R1");
    bus.bus.run(milliseconds(300));
    EXPECT_EQ(watched ? 102 : 0, bus.drive(1).inverter().faultNumber());
    bus.send("000#8105");
    bus.bus.run(milliseconds(200));
    for (std::size_t i = 0; i < 3; ++i) bus.drive(i).setInverterPower(false);
    for (std::size_t i = 0; i < 3; ++i) bus.drive(i).setInverterPower(true);
    bus.bus.run(milliseconds(500));
  }
}

// The drive profile is that of the technology units, 1010h that of the gateway.
TEST(CanNodeOfTheOwnPort, HasNoDriveProfile) {
  CanDriveConfig can;
  can.connection = CanConnection::kOnboard;
  SimConfig config = oneCanDrive(can);
  config.drives[0].parameters.push_back({551, 0, 0, 1});
  CanConversation bus{config};
  bus.boot();
  EXPECT_EQ("8040600000000206", bus.sdo("40 40 60 00 00 00 00 00"));
  EXPECT_EQ("8010100100000206", bus.sdo("40 10 10 01 00 00 00 00"));
  bus.start();
  EXPECT_EQ("1B2#310B0000", bus.ask("232#7E040000"));
}

// An inverter on the system bus is a node of its own, here with node id 34 = FI2 and P509 = 3; its objects are those
// of the inverter's own port, as no source prints any.
TEST(CanNodeOnTheSystemBus, AsItsOwnPort) {
  CanDriveConfig can;
  can.connection = CanConnection::kSystemBus;
  SimConfig config = oneCanDrive(can, 34);
  config.drives[0].device.series = Series::kSk2xxe;
  CanConversation bus{config};
  bus.boot();
  bus.send("000#0122");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ("1A2#310B0000", bus.ask("222#7E040000"));
}

}  // namespace
}  // namespace nord_driver::sim
