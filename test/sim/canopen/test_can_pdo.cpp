#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

const char kDone[] = "60";
const char kRefused[] = "80";

class CanPdo : public testing::Test {
 protected:
  CanPdo() { bus.boot(); }
  /// Writes four bytes; the first byte of the answer.
  std::string write4(const std::string& object, const std::string& value) {
    return bus.sdo("23 " + object + value).substr(0, 2);
  }
  std::string write1(const std::string& object, const std::string& value) {
    return bus.sdo("2F " + object + value + "00 00 00").substr(0, 2);
  }
  CanConversation bus;
};

// As delivered: four RPDOs and the first TPDO are active, bit 30 is 1, type 255 (BU 0060 p. 58, 59).
TEST_F(CanPdo, AsDelivered) {
  EXPECT_EQ("4300140132020040", bus.sdo("40 00 14 01 00 00 00 00"));
  EXPECT_EQ("4303140132050040", bus.sdo("40 03 14 01 00 00 00 00"));
  EXPECT_EQ("43001801B2010040", bus.sdo("40 00 18 01 00 00 00 00"));
  EXPECT_EQ("43011801B20200C0", bus.sdo("40 01 18 01 00 00 00 00"));
  EXPECT_EQ("4F001802FF000000", bus.sdo("40 00 18 02 00 00 00 00"));
  EXPECT_EQ("4F001A0002000000", bus.sdo("40 00 1A 00 00 00 00 00"));
  EXPECT_EQ("43001A0110000130", bus.sdo("40 00 1A 01 00 00 00 00"));
  EXPECT_EQ("43011A0310020330", bus.sdo("40 01 1A 03 00 00 00 00")) << "IW2 before IW3: SK 5xxE (BU 0060 p. 59)";
}

// SK 300E, 700E and 750E have IW3 before IW2, SW3 before SW2.
TEST(CanPdoOfTheOlderSeries, WordOrder) {
  SimConfig config = oneCanDrive();
  config.drives[0].device.series = Series::kSk700e;
  CanConversation bus{config};
  bus.boot();
  EXPECT_EQ("43011A0310030330", bus.sdo("40 01 1A 03 00 00 00 00"));
  EXPECT_EQ("4301160410020230", bus.sdo("40 01 16 04 00 00 00 00"));
  bus.start();
  EXPECT_EQ("1B2#310B0000", bus.ask("232#7E040000")) << "P509 = 17 gives control to CANopen";
}

// Three actual values by the words of BU 0060 p. 59: TPDO 1 off, TPDO 2 on, then operational.
TEST_F(CanPdo, ThreeActualValues) {
  EXPECT_EQ(kDone, write4("00 18 01", "B2 01 00 C0"));
  EXPECT_EQ(kDone, write4("01 18 01", "B2 02 00 40"));
  bus.send("000#0132");
  EXPECT_EQ(Frames{"2B2#700B000000000000"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ("2B2#310B000000000000", bus.ask("332#7E04000000000000"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// The order of a change: off, count 0, entries, count, on (CiA 301 7.5.2.36); everything else is refused and counted.
TEST_F(CanPdo, MappingInOrder) {
  EXPECT_EQ(kRefused, write1("00 1A 00", "00")) << "the PDO is on";
  EXPECT_EQ(1u, bus.referee().count(CanRule::kMappingOrder));
  EXPECT_EQ(kDone, write4("00 18 01", "B2 01 00 C0"));
  EXPECT_EQ(kRefused, write4("00 1A 01", "10 01 03 30")) << "the count is not 0";
  EXPECT_EQ(2u, bus.referee().count(CanRule::kMappingOrder));
  EXPECT_EQ(kDone, write1("00 1A 00", "00"));
  EXPECT_EQ(kDone, write4("00 1A 01", "10 01 03 30"));
  EXPECT_EQ("8000 1A02 4100 0406", [&] {
    const std::string answer = bus.sdo("23 00 1A 02 10 00 00 30");
    return answer.substr(0, 4) + " " + answer.substr(4, 4) + " " + answer.substr(8, 4) + " " + answer.substr(12, 4);
  }()) << "the control word is no actual value: 0604 0041h";
  EXPECT_EQ(kDone, write4("00 1A 02", "10 00 01 30"));
  EXPECT_EQ(kDone, write1("00 1A 00", "02"));
  EXPECT_EQ(kDone, write4("00 18 01", "B2 01 00 40"));
  bus.send("000#0132");
  EXPECT_EQ(Frames{"1B2#0000700B"}, bus.takeAfter(milliseconds(20)));
  EXPECT_EQ(kRefused, write4("00 18 01", "B2 01 00 C0")) << "in pre-operational only (BU 0060 p. 63)";
  EXPECT_EQ(3u, bus.referee().count(CanRule::kMappingOrder));
}

// Bit 30 cannot be changed (BU 0060 p. 63), restricted identifiers are refused, an active PDO keeps its identifier.
TEST_F(CanPdo, CobIds) {
  EXPECT_EQ(kRefused, write4("00 18 01", "B2 01 00 80"));
  EXPECT_EQ(kDone, write4("00 18 01", "B2 01 00 C0"));
  EXPECT_EQ(kRefused, write4("00 18 01", "81 05 00 40")) << "an SDO's";
  EXPECT_EQ(kDone, write4("00 18 01", "99 01 00 40"));
  EXPECT_EQ(0u, bus.referee().total());
  EXPECT_EQ(kRefused, write4("00 18 01", "98 01 00 40"));
  EXPECT_EQ(1u, bus.referee().count(CanRule::kMappingOrder));
}

TEST(CanPdoFixedMapping, IsReadOnly) {
  CanDriveConfig can;
  can.fixed_mapping = true;
  CanConversation bus{oneCanDrive(can)};
  bus.boot();
  bus.sdo("23 00 18 01 B2 01 00 C0");
  EXPECT_EQ("80001A0002000106", bus.sdo("2F 00 1A 00 00 00 00 00"));
  EXPECT_EQ("4F001A0002000000", bus.sdo("40 00 1A 00 00 00 00 00"));
}

// Transmission type 0: after a SYNC if changed; n: with every n-th; an RPDO of such a type waits for the SYNC.
TEST_F(CanPdo, Synchronous) {
  EXPECT_EQ(kDone, write1("00 18 02", "02"));
  EXPECT_EQ(kDone, write1("00 14 02", "01"));
  bus.start();
  EXPECT_EQ(Frames{}, bus.takeAfter(milliseconds(100)));
  EXPECT_EQ("", bus.ask("080#"));
  EXPECT_EQ("1B2#700B0000", bus.ask("080#"));
  bus.ask("232#7E040000");
  EXPECT_EQ(InverterState::kSwitchOnDisabled, bus.drive().inverter().state());
  bus.ask("080#");
  EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive().inverter().state());
  EXPECT_EQ("1B2#310B0000", bus.ask("080#"));
}

TEST_F(CanPdo, AfterASyncIfChanged) {
  EXPECT_EQ(kDone, write1("00 18 02", "00"));
  bus.start();
  EXPECT_EQ("1B2#700B0000", bus.ask("080#"));
  EXPECT_EQ("", bus.ask("080#"));
  bus.ask("232#7E040000");
  EXPECT_EQ("1B2#310B0000", bus.ask("080#"));
}

// Types 252 and 253 are reserved (BU 0060 p. 58).
TEST_F(CanPdo, ReservedTypes) {
  EXPECT_EQ(kRefused, write1("00 18 02", "FC"));
  EXPECT_EQ(kDone, write1("00 18 02", "FE"));
}

// The event timer repeats without a change, the inhibit time holds changes back.
TEST_F(CanPdo, EventTimerAndInhibitTime) {
  EXPECT_EQ(kDone, bus.sdo("2B 00 18 05 32 00 00 00").substr(0, 2));  // 50 ms
  EXPECT_EQ(kRefused, bus.sdo("2B 00 18 03 64 00 00 00").substr(0, 2)) << "not while the PDO is on";
  bus.start();
  EXPECT_EQ(4u, bus.takeAfter(milliseconds(215)).size());
  bus.send("000#8032");
  bus.bus.run(milliseconds(5));
  write4("00 18 01", "B2 01 00 C0");
  EXPECT_EQ(kDone, bus.sdo("2B 00 18 03 C8 00 00 00").substr(0, 2));  // 20 ms
  EXPECT_EQ(kDone, bus.sdo("2B 00 18 05 00 00 00 00").substr(0, 2));
  write4("00 18 01", "B2 01 00 40");
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.send("232#7F040020");
  EXPECT_EQ(10u, bus.takeAfter(milliseconds(200)).size()) << "the ramp changes it all the time";
}

// A short RPDO is not taken, a PDO is given to no remote frame.
TEST_F(CanPdo, LengthAndRemoteFrames) {
  bus.start();
  EXPECT_EQ("", bus.ask("232#7E04"));
  EXPECT_EQ(InverterState::kSwitchOnDisabled, bus.drive().inverter().state());
  EXPECT_EQ(1u, bus.referee().count(CanRule::kRpdoLength));
  EXPECT_EQ("", bus.ask("1B2#R4"));
  EXPECT_EQ(1u, bus.referee().count(CanRule::kRemotePdo));
}

// A control word of zeros after valid ones stops nothing (BU 2700 6.4.1 note 2).
TEST_F(CanPdo, ZerosDoNotStop) {
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.repeat("232#7F040020", seconds(2.0), "1B2");
  bus.repeat("232#00000000", seconds(1.0), "1B2");
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.01);
  EXPECT_EQ(200u, bus.referee().count(CanRule::kZeroControlWord));
}

// A master that starts the node again does not know the parameter set in force: it may look before it commands.
TEST_F(CanPdo, ZerosAtTheStartOfAnExchangeAreNoMistake) {
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.send("000#8032");
  bus.send("000#0132");
  bus.repeat("232#00000000", milliseconds(50), "1B2");
  EXPECT_EQ(0u, bus.referee().count(CanRule::kZeroControlWord));
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.repeat("232#00000000", milliseconds(50), "1B2");
  EXPECT_EQ(10u, bus.referee().count(CanRule::kZeroControlWord));
}

// The same holds for an inverter that was off behind its module.
TEST_F(CanPdo, ZerosToAnInverterThatComesBackAreNoMistake) {
  bus.start();
  bus.repeat("232#7E040000", milliseconds(50), "1B2");
  bus.drive().setInverterPower(false);
  bus.repeat("232#00000000", milliseconds(50), "1B2");
  bus.drive().setInverterPower(true);
  bus.repeat("232#00000000", milliseconds(50), "1B2");
  EXPECT_EQ(0u, bus.referee().count(CanRule::kZeroControlWord));
}

}  // namespace
}  // namespace nord_driver::sim
