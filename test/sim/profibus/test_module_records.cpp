#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

/// A module in data exchange; the frame count goes on at 5C, in low priority as the requests of class 1 have it.
class Records : public ::testing::Test {
 protected:
  explicit Records(const RecordSettings& settings = RecordSettings{}, bool dpv1 = true) : bus{withRecords(settings)} {
    bus.startUpModule({0x00, 0xF1, 0xF1}, 0, dpv1);
    bus.outputs("047E 0000 047E 0000");
  }
  static SimConfig withRecords(const RecordSettings& settings) {
    SimConfig config = oneModule(2);
    ModuleConfig module;
    module.settings.address = 8;
    module.settings.records = settings;
    config.bus.as<DpBusConfig>().modules.push_back(module);
    return config;
  }
  /// One telegram to SAP 51.
  std::string send(const std::string& pdu) {
    std::vector<std::uint8_t> unit{51, 51};
    for (const std::uint8_t byte : fromHex(pdu)) unit.push_back(byte);
    return bus.askBytes(Conversation::variable(0x88, 0x81, bus.frameCount() & 0xFEu, unit));
  }
  /// The request, then polls until the response is there; the response without its frame.
  std::string record(const std::string& pdu) {
    std::string answer = send(pdu);
    for (int polls = 0; answer == "E5" && polls < 100; ++polls) answer = send("");
    return answer.size() > 33 ? answer.substr(27, answer.size() - 33) : answer;
  }
  ModuleStation& module() { return bus.segment.stations().module(0); }

  Conversation bus;
};

// Write the order, poll, read the answer, poll: BU 0220 8.3.4.4, byte for byte. 15E5h: P509, which is 3.
TEST_F(Records, WriteAndReadByteForByte) {
  EXPECT_EQ("E5", bus.ask("68 11 11 68 88 81 5C 33 33 5F 00 65 08 15 E5 00 00 00 00 00 00 91 16"));
  EXPECT_EQ("E5", bus.ask("68 05 05 68 88 81 7C 33 33 EB 16"));
  EXPECT_EQ("68 09 09 68 81 88 08 33 33 5F 00 65 08 43 16", bus.ask("68 05 05 68 88 81 5C 33 33 CB 16"));
  EXPECT_EQ("E5", bus.ask("68 09 09 68 88 81 7C 33 33 5E 00 65 08 B6 16"));
  EXPECT_EQ("E5", bus.ask("68 05 05 68 88 81 5C 33 33 CB 16"));
  EXPECT_EQ("68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E5 00 00 00 00 00 03 3F 16",
            bus.ask("68 05 05 68 88 81 7C 33 33 EB 16"));
  EXPECT_EQ("E5", bus.ask("68 05 05 68 88 81 5C 33 33 CB 16"));  // nothing more
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Index 100 is the module: P151 (1151 = 47Fh) to 500 ms with AK 2, and back with AK 1.
TEST_F(Records, ReachTheModule) {
  EXPECT_EQ("5F 00 64 08", record("5F 00 64 08 247F 0000 0000 01F4"));
  EXPECT_EQ("5E 00 64 08 14 7F 00 00 00 00 01 F4", record("5E 00 64 08"));
  EXPECT_EQ(500, module().parameters().value(151));
  EXPECT_EQ(1u, module().parameters().eepromWrites());
  record("5F 00 64 08 E47F 0000 0000 01F5");  // AK 14: not to EEPROM
  EXPECT_EQ(501, module().parameters().value(151));
  EXPECT_EQ(1u, module().parameters().eepromWrites());
}

// What the module shows: P180 its address, P181 500 kbit/s = 4, P182 the configured identifiers, P173 its inverters.
TEST_F(Records, ReadWhatTheModuleShows) {
  const auto read = [&](const std::string& pke_and_index) {
    record("5F 00 64 08" + pke_and_index + "0000 0000");
    return record("5E 00 64 08").substr(12);
  };
  EXPECT_EQ("14 9C 00 00 00 00 00 08", read("149C 0000"));
  EXPECT_EQ("14 9D 00 00 00 00 00 04", read("149D 0000"));
  EXPECT_EQ("44 9E 02 00 00 00 00 F1", read("649E 0200"));
  EXPECT_EQ("44 9E 03 00 00 00 00 00", read("649E 0300"));
  EXPECT_EQ("14 95 00 00 00 00 0A 02", read("1495 0000"));
  EXPECT_EQ("44 98 01 00 00 00 04 7E", read("6498 0100"));  // P176[-02]: control word FI1
  EXPECT_EQ("64 98 00 00 00 00 00 11", read("9498 0000"));  // 17 elements
  EXPECT_EQ("74 96 00 00 00 00 00 01", read("2496 0000"));  // P174 cannot be written
}

// -1 for P151 switches everything off; below it and above 32767 is out of range. P152 = 1 sets everything back.
TEST_F(Records, ModuleParametersHaveTheirRanges) {
  const auto write = [&](const std::string& order) {
    record("5F 00 64 08" + order);
    return record("5E 00 64 08").substr(12);
  };
  EXPECT_EQ("14 7F 00 00 FF FF FF FF", write("247F 0000 FFFF FFFF"));
  EXPECT_EQ("74 7F 00 00 00 00 00 02", write("247F 0000 FFFF FFFE"));
  EXPECT_EQ("74 7F 00 00 00 00 00 02", write("247F 0000 0000 8000"));
  EXPECT_EQ("74 7E 00 00 00 00 00 02", write("247E 0000 0000 0005"));
  EXPECT_EQ("14 7E 00 00 00 00 00 04", write("247E 0000 0000 0004"));
  EXPECT_EQ("44 81 01 00 00 00 00 FA", write("7481 0100 0000 00FA"));
  write("2480 0000 0000 0001");
  EXPECT_EQ(0, module().parameters().value(150));
  EXPECT_EQ(0, module().parameters().value(151));
  EXPECT_EQ(0, module().parameters().value(152));
  EXPECT_EQ(10, module().parameters().value(153, 0, 0));
  EXPECT_EQ(5, module().parameters().value(153, 0, 1));
}

// Errors of DP-V1: another slot, another index, another length, another service.
TEST_F(Records, RefusesWhatIsNotThere) {
  EXPECT_EQ("DF 80 B2 00", record("5F 01 65 08 15E5 0000 0000 0000"));
  EXPECT_EQ("DE 80 B0 00", record("5E 00 63 08"));
  EXPECT_EQ("DE 80 B0 00", record("5E 00 69 08"));
  EXPECT_EQ("DF 80 B1 00", record("5F 00 65 04 15E5 0000"));
  EXPECT_EQ("DF 80 B1 00", record("5F 00 65 08 15E5 0000"));
  EXPECT_EQ("DF 80 B1 00", record("5F 00 65 04 15E5 0000 0000 0000"));
  EXPECT_EQ("D1 80 A9 00", record("51 00 65 08"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// "... a READ without a WRITE before it" is parameter error 9; an inverter that is not there 101, one that is off 102.
TEST_F(Records, AnswersWithParameterErrors) {
  EXPECT_EQ("5E 00 65 08 70 00 00 00 00 00 00 09", record("5E 00 65 08"));
  record("5F 00 68 08 15E5 0000 0000 0000");
  EXPECT_EQ("5E 00 68 08 75 E5 00 00 00 00 00 65", record("5E 00 68 08"));
  bus.segment.drive(0).setInverterPower(false);
  record("5F 00 65 08 15E5 0000 0000 0000");
  EXPECT_EQ("5E 00 65 08 75 E5 00 00 00 00 00 66", record("5E 00 65 08"));
  record("5F 00 66 08 15E5 0000 0000 0000");
  EXPECT_EQ("5E 00 66 08 15 E5 00 00 00 00 00 03", record("5E 00 66 08"));
  EXPECT_EQ("5E 00 66 08 70 00 00 00 00 00 00 09", record("5E 00 66 08"));  // read already
}

// A record order and an order in the parameter channel do not disturb each other.
TEST_F(Records, GoBesideTheParameterChannel) {
  Conversation& line = bus;
  line.startUpModule({0x00, 0xF5}, 0);
  line.outputs("1451 0000 0000 0000 047E 0000");
  record("5F 00 65 08 15E5 0000 0000 0000");
  EXPECT_EQ("14 51 00 00 00 00 01 F4", line.outputs("1451 0000 0000 0000 047E 0000").substr(0, 23));
  EXPECT_EQ("5E 00 65 08 15 E5 00 00 00 00 00 03", record("5E 00 65 08"));
}

// One service at a time: a second request finds no resource (FC 02), and the master is to blame.
TEST_F(Records, TakesOneServiceAtATime) {
  EXPECT_EQ("E5", send("5F 00 65 08 15E5 0000 0000 0000"));
  EXPECT_EQ("10 01 08 02 0B 16", send("5E 00 66 08"));
  EXPECT_EQ(1u, bus.referee().count(Rule::kRecordWhileOutstanding));
  EXPECT_EQ("E5", send(""));
  EXPECT_EQ("68 09 09 68 81 88 08 33 33 5F 00 65 08 43 16", send(""));
}

// A new start forgets the service and what could be read.
TEST_F(Records, ANewStartForgets) {
  record("5F 00 65 08 15E5 0000 0000 0000");
  send("5E 00 65 08");
  bus.startUpModule({0x00, 0xF1, 0xF1}, 0);
  EXPECT_EQ("E5", send(""));
  EXPECT_EQ("5E 00 65 08 70 00 00 00 00 00 00 09", record("5E 00 65 08"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// The server is not there outside data exchange.
TEST_F(Records, NeedDataExchange) {
  bus.service(61, {0x80, 0, 0, 11, 0x0B, 0xA8, 0, 0x80, 0, 0});
  EXPECT_EQ("10 01 08 03 0C 16", send("5E 00 65 08"));
  EXPECT_EQ(1u, bus.referee().count(Rule::kRecordBeforeReady));
}

class WithoutDpv1 : public Records {
 protected:
  WithoutDpv1() : Records(RecordSettings{}, false) {}
};

// Without DPV1_Enable in Set_Prm the service is not active (RS).
TEST_F(WithoutDpv1, RecordsAreNotActive) {
  EXPECT_EQ("10 01 08 03 0C 16", send("5E 00 65 08"));
}

class SlowRecords : public Records {
 protected:
  SlowRecords() : Records(slow()) {}
  static RecordSettings slow() {
    RecordSettings settings;
    settings.polls = 3;
    settings.busy = 2;
    return settings;
  }
};

// A slow module: nothing for three polls, and twice "state conflict" before the answer can be read.
TEST_F(SlowRecords, AnswerLate) {
  send("5F 00 65 08 15E5 0000 0000 0000");
  for (int i = 0; i < 3; ++i) EXPECT_EQ("E5", send(""));
  EXPECT_EQ("68 09 09 68 81 88 08 33 33 5F 00 65 08 43 16", send(""));
  EXPECT_EQ("DE 80 B5 00", record("5E 00 65 08"));
  EXPECT_EQ("DE 80 B5 00", record("5E 00 65 08"));
  EXPECT_EQ("5E 00 65 08 15 E5 00 00 00 00 00 03", record("5E 00 65 08"));
}

class OtherRecords : public Records {
 protected:
  OtherRecords() : Records(other()) {}
  static RecordSettings other() {
    RecordSettings settings;
    settings.by_slot = true;
    settings.plain_numbers = true;
    return settings;
  }
};

// As BU 2700 6.5 numbers them: slot 1 the module, slot 2 FI1; and parameter numbers without the 1000 (BU 0220 5).
TEST_F(OtherRecords, BySlotAndWithPlainNumbers) {
  EXPECT_EQ("DE 80 B2 00", record("5E 00 64 08"));
  record("5F 02 64 08 11FD 0000 0000 0000");  // 1FDh: P509
  EXPECT_EQ("5E 02 64 08 11 FD 00 00 00 00 00 03", record("5E 02 64 08"));
  record("5F 01 64 08 2097 0000 0000 0064");  // P151
  EXPECT_EQ("5E 01 64 08 10 97 00 00 00 00 00 64", record("5E 01 64 08"));
  EXPECT_EQ(100, module().parameters().value(151));
  record("5F 01 64 08 147F 0000 0000 0000");  // with the 1000 there is no such parameter
  EXPECT_EQ("00 00 00 00 00 00", record("5E 01 64 08").substr(18));
}

}  // namespace
}  // namespace nord_driver::sim
