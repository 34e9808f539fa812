#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

class CanSdo : public testing::Test {
 protected:
  CanSdo() { bus.boot(); }
  CanConversation bus;
};

/// The abort code in the answer to a request, as BU 0060 p. 62 prints it.
std::string abortOf(const std::string& answer) {
  if (answer.size() != 16 || answer.substr(0, 2) != "80") return "no abort: " + answer;
  return answer.substr(14, 2) + answer.substr(12, 2) + answer.substr(10, 2) + answer.substr(8, 2);
}

// Each code of BU 0060 p. 62 and what causes it.
TEST_F(CanSdo, AbortCodes) {
  EXPECT_EQ("06010002", abortOf(bus.sdo("2B BC 22 01 00 00 00 00"))) << "P700 is read-only";
  EXPECT_EQ("06010002", abortOf(bus.sdo("2B 01 30 00 00 00 00 00"))) << "the status word";
  EXPECT_EQ("06020000", abortOf(bus.sdo("40 E7 23 00 00 00 00 00"))) << "there is no P999";
  EXPECT_EQ("06020000", abortOf(bus.sdo("40 40 60 00 00 00 00 00"))) << "P551 is off";
  EXPECT_EQ("06090011", abortOf(bus.sdo("40 66 20 05 00 00 00 00"))) << "P102 has four sets and no array";
  EXPECT_EQ("06090011", abortOf(bus.sdo("40 01 22 01 00 00 00 00"))) << "P513 is plain";
  EXPECT_EQ("06070010", abortOf(bus.sdo("23 66 20 01 67 00 00 00"))) << "32 bits for a parameter of 16";
  EXPECT_EQ("06070010", abortOf(bus.sdo("2B 65 22 01 67 00 00 00"))) << "16 bits for P613";
  EXPECT_EQ("06090031", abortOf(bus.sdo("2B 66 20 01 01 7D 00 00"))) << "P102 = 320.01 s";
  EXPECT_EQ("06090032", abortOf(bus.sdo("2B 01 22 00 FE FF 00 00"))) << "P513 = -0.2 s";
  EXPECT_EQ("05040001", abortOf(bus.sdo("E0 66 20 01 00 00 00 00"))) << "no such command";
  EXPECT_EQ("05040001", abortOf(bus.sdo("60 00 00 00 00 00 00 00"))) << "a segment without a transfer";
  bus.drive().setInverterPower(false);
  EXPECT_EQ("06060000", abortOf(bus.sdo("40 66 20 01 00 00 00 00"))) << "the inverter is off";
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Sub-indices: plain 0, with sets 4 * (n - 1) + p, of an array without sets n (BU 0060 p. 61, p. 54).
TEST_F(CanSdo, SubIndices) {
  ParameterStore& parameters = bus.drive().parameters();
  parameters.preset(513, 0, 0, -1);
  EXPECT_EQ("4B012200FFFF0000", bus.sdo("40 01 22 00 00 00 00 00")) << "FFFFh is -0.1 s";
  parameters.preset(102, 3, 0, 444);
  EXPECT_EQ("4B662004BC010000", bus.sdo("40 66 20 04 00 00 00 00"));
  parameters.preset(701, 0, 4, 61);
  EXPECT_EQ("4BBD22053D000000", bus.sdo("40 BD 22 05 00 00 00 00"));
  parameters.preset(613, 0, 1, -2);
  EXPECT_EQ("43652202FEFFFFFF", bus.sdo("40 65 22 02 00 00 00 00")) << "32 bits";
  EXPECT_EQ("6065220100000000", bus.sdo("23 65 22 01 40 E2 01 00"));
  EXPECT_EQ(123456, parameters.value(613));
}

// The other reading of the manual: arrays without sets by the table too.
TEST(CanSdoByTable, SubIndicesOfArrays) {
  CanDriveConfig can;
  can.array_sub_by_table = true;
  CanConversation bus{oneCanDrive(can)};
  bus.boot();
  bus.drive().parameters().preset(701, 0, 1, 61);
  EXPECT_EQ("4BBD22053D000000", bus.sdo("40 BD 22 05 00 00 00 00"));
  EXPECT_EQ("06090011", abortOf(bus.sdo("40 BD 22 02 00 00 00 00")));
}

// P560 decides between RAM and EEPROM; an SDO cannot say it (BU 0060 has no such flag).
TEST_F(CanSdo, EepromOnlyByP560) {
  bus.sdo("2B 30 22 00 00 00 00 00");
  const auto before = bus.drive().parameters().eepromWrites();
  bus.sdo("2B 66 20 01 67 00 00 00");
  EXPECT_EQ(before, bus.drive().parameters().eepromWrites());
  bus.drive().setInverterPower(false);
  bus.drive().setInverterPower(true);
  EXPECT_EQ(200, bus.drive().parameters().value(102));
}

// Segmented upload of the device name: size, then seven bytes each with a toggle bit (CiA 301 7.2.4.3.6).
TEST_F(CanSdo, SegmentedUpload) {
  EXPECT_EQ("410810000A000000", bus.sdo("40 08 10 00 00 00 00 00"));
  EXPECT_EQ("00534B205455332D", bus.sdo("60 00 00 00 00 00 00 00"));
  EXPECT_EQ("1943414F00000000", bus.sdo("70 00 00 00 00 00 00 00"));
  EXPECT_EQ("05040001", abortOf(bus.sdo("60 00 00 00 00 00 00 00"))) << "it is over";
  bus.sdo("40 08 10 00 00 00 00 00");
  EXPECT_EQ("05030000", abortOf(bus.sdo("70 00 00 00 00 00 00 00"))) << "the toggle bit is wrong";
}

TEST_F(CanSdo, SegmentedDownload) {
  EXPECT_EQ("6066200100000000", bus.sdo("21 66 20 01 02 00 00 00"));
  EXPECT_EQ("2000000000000000", bus.sdo("0B 67 00 00 00 00 00 00"));
  EXPECT_EQ(103, bus.drive().parameters().value(102));
}

// One request at a time: what comes before the answer is lost, and the referee saw it. An abort ends the wait.
TEST_F(CanSdo, OneRequestAtATime) {
  bus.node().setAnswerDelay(milliseconds(50));
  bus.send("632#4066200100000000");
  bus.bus.run(milliseconds(10));
  bus.send("632#4067200100000000");
  bus.bus.run(milliseconds(100));
  EXPECT_EQ(Frames{"5B2#4B662001C8000000"}, bus.take());
  EXPECT_EQ(1u, bus.referee().count(CanRule::kSdoWhilePending));
  bus.send("632#4066200100000000");
  bus.bus.run(milliseconds(10));
  bus.send("632#8066200100000405");
  EXPECT_EQ(Frames{}, bus.takeAfter(milliseconds(100)));
  EXPECT_EQ(1u, bus.referee().total());
}

// What an experimenter can do: slow, silent, refused.
TEST_F(CanSdo, Switches) {
  ParameterSwitches switches;
  switches.silent = true;
  bus.drive().setParameterSwitches(switches);
  EXPECT_EQ("", bus.sdo("40 66 20 01 00 00 00 00"));
  EXPECT_EQ("4F01100000000000", bus.sdo("40 01 10 00 00 00 00 00")) << "only parameters are silent";
  switches.silent = false;
  switches.refuse = PkwRefusal{1, 102};
  bus.drive().setParameterSwitches(switches);
  EXPECT_EQ("06010002", abortOf(bus.sdo("40 66 20 01 00 00 00 00")));
  EXPECT_EQ("4B672001C8000000", bus.sdo("40 67 20 01 00 00 00 00"));
}

}  // namespace
}  // namespace nord_driver::sim
