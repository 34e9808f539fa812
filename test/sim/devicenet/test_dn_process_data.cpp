// Assemblies, fragments, bit strobe, change of state: BU 0280 4.2.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"
#include "sim/devicenet/dn_stations.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using Texts = DnConversation::Texts;

// Control word 047E, 047F and half the frequency, little endian behind the byte of the module: BU 0280 4.2.4, 7.2.
TEST(DnProcessData, Instance100) {
  DnConversation bus;
  bus.connect();
  EXPECT_EQ("3C9#00310B0000", bus.poll("44D#00 7E 04 00 00", milliseconds(500)));
  bus.poll("44D#00 7F 04 00 20", milliseconds(3000));
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.1);
  const std::string status = bus.ask("44D#00 7F 04 00 20");
  EXPECT_EQ("3C9#00", status.substr(0, 6));
  EXPECT_EQ("37", status.substr(6, 2));
  EXPECT_EQ("0020", status.substr(10, 4)) << "IW1 = 2000h";
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST(DnProcessData, OutputsAndInputsOfTheModule) {
  SimConfig config = dnGateway();
  DnConversation bus{config};
  bus.connect();
  bus.module().setInputs(0x0A);
  EXPECT_EQ("3C9#0A", bus.ask("44D#03 7E 04 00 00").substr(0, 6));
  EXPECT_EQ(3, bus.module().outputs());
  bus.module().parameters().preset(150, 0, 0, 2);
  EXPECT_EQ(1, bus.module().outputs()) << "P150";
}

// 33 bytes are five frames each way; nothing is acknowledged.
TEST(DnProcessData, FourInvertersInFragments) {
  DnConversation bus{dnGateway(4, 102)};
  bus.connect();
  const Texts poll{"44D#00 00 7E 04 00 00 00 00", "44D#41 00 00 7E 04 00 00 00", "44D#42 00 00 00 7E 04 00 00",
                   "44D#43 00 00 00 00 7E 04 00", "44D#84 00 00 00 00 00"};
  bus.poll(poll, milliseconds(500));
  for (const std::string& frame : poll) bus.send(frame);
  const Texts answer = bus.takeAfter(milliseconds(20));
  ASSERT_EQ(5u, answer.size());
  EXPECT_EQ("3C9#0000", answer[0].substr(0, 8));
  EXPECT_EQ("3C9#41", answer[1].substr(0, 6));
  EXPECT_EQ("3C9#84", answer[4].substr(0, 6));
  EXPECT_EQ(16u, answer[4].size()) << "28 bytes in four fragments, five in the last one";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive(i).inverter().state()) << i;
  }
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST(DnProcessData, AGapInTheFragmentsDropsTheMessage) {
  DnConversation bus{dnGateway(4, 102)};
  bus.connect();
  for (const char* frame : {"44D#00 00 7E 04 00 00 00 00", "44D#42 00 00 00 7E 04 00 00", "44D#43 00 00 00 00 7E 04 00",
                            "44D#84 00 00 00 00 00"}) {
    bus.send(frame);
  }
  EXPECT_THAT(bus.takeAfter(milliseconds(20)), testing::IsEmpty());
  EXPECT_EQ(0u, bus.module().counters().polls);
}

// The inverter that is off is all zero, the others are not disturbed.
TEST(DnProcessData, AnInverterThatIsOff) {
  DnConversation bus{dnGateway(2, 102)};
  bus.connect();
  bus.drive(0).setInverterPower(false);
  const Texts poll{"44D#00 00 7E 04 00 00 00 00", "44D#41 00 00 7E 04 00 00 00", "44D#42 00 00 00 00 00 00 00",
                   "44D#43 00 00 00 00 00 00 00", "44D#84 00 00 00 00 00"};
  bus.poll(poll, milliseconds(500));
  for (const std::string& frame : poll) bus.send(frame);
  const Texts answer = bus.takeAfter(milliseconds(20));
  ASSERT_EQ(5u, answer.size());
  EXPECT_EQ("3C9#0000000000000000", answer[0]);
  EXPECT_NE("3C9#4100000000000000", answer[1]);
  EXPECT_EQ("9402FF", bus.request("0E 65 01 05")) << "P105 of FI 1: resource unavailable";
  EXPECT_EQ("8EF401", bus.request("0E 6F 01 05")) << "P105 of FI 2";
}

// The example of BU 0280 4.2.5: inputs 21 bytes, outputs 17. By its own table the first number of P163 is the length of
// the status: 4 and 8 there make 17 in and 21 out; the example has them the other way round.
TEST(DnProcessData, VariableLengths) {
  DnConversation bus{dnGateway(3, 120)};
  ParameterStore& parameters = bus.module().parameters();
  const int lengths[4][3]{{8, 8, 2}, {4, 8, 2}, {4, 4, 0}, {0, 0, 0}};
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned k = 0; k < 3; ++k) parameters.preset(static_cast<std::uint16_t>(162 + i), 0, k, lengths[i][k]);
  }
  parameters.preset(161, 0, 0, 1);
  parameters.preset(161, 0, 1, 1);
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 03 0A");
  EXPECT_EQ("8E1100", bus.request("0E 05 02 07"));
  EXPECT_EQ("8E1500", bus.request("0E 05 02 08"));
}

// Ten bytes each way (facts 3.4): `00 01..07`, `81 08 09 0A`. Without its first fragment the second one is nothing.
TEST(DnProcessData, TenBytesInTwoFragments) {
  DnConversation bus{dnGateway(2, 120)};
  ParameterStore& parameters = bus.module().parameters();
  const int lengths[4][3]{{6, 6, 2}, {4, 4, 2}, {0, 0, 0}, {0, 0, 0}};
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned k = 0; k < 3; ++k) parameters.preset(static_cast<std::uint16_t>(162 + i), 0, k, lengths[i][k]);
  }
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 03 0A");
  EXPECT_EQ("8E0A00", bus.request("0E 05 02 07"));
  EXPECT_EQ("8E0A00", bus.request("0E 05 02 08"));
  bus.request("10 05 02 09 64 00");
  bus.send("44D#81 08 09 0A");
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(0, bus.module().countersOf(0).last_control);
  bus.send("44D#00 01 02 03 04 05 06 07");
  EXPECT_THAT(bus.askAll("44D#81 08 09 0A", milliseconds(5)), ElementsAre("3C9#00700B0000000070", "3C9#810B0000"));
  EXPECT_EQ(0x0201, bus.module().countersOf(0).last_control);
  EXPECT_EQ(0x0403, parameters.value(176, 0, 2));
  EXPECT_EQ(0x0605, parameters.value(176, 0, 3));
  EXPECT_EQ(0x0807, bus.module().countersOf(1).last_control);
  EXPECT_EQ(0x0A09, parameters.value(176, 0, 6));
}

TEST(DnProcessData, LengthsOfTheInstances) {
  const ParameterStore parameters{dnModuleParameterDefinitions()};
  const std::pair<unsigned, std::size_t> expected[]{{20, 4}, {21, 4}, {100, 5}, {101, 8}, {102, 33}, {120, 0}};
  for (const auto& [instance, length] : expected) {
    const DnLayout layout = DnLayout::ofInstance(instance, parameters);
    EXPECT_EQ(length, layout.inputs()) << instance;
    EXPECT_EQ(length, layout.outputs()) << instance;
  }
}

// Run forward at 750 rpm (EE 02) of 1500 at 50 Hz; then a fault, its reset, and nothing moves before "run" comes again.
TEST(DnProcessData, AcDriveProfile) {
  DnConversation bus{oneDnDrive(21)};
  bus.connect();
  bus.poll("44D#60 00 00 00", milliseconds(400));
  EXPECT_EQ("3C9#F0030000", bus.ask("44D#60 00 00 00")) << "ready, at reference, from net";
  bus.poll("44D#61 00 EE 02", milliseconds(4000));
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.1);
  EXPECT_EQ("3C9#F404", bus.ask("44D#61 00 EE 02").substr(0, 8)) << "at reference, ready, running forward; enabled";
  bus.drive().inverter().trip(30, false);
  bus.poll("44D#61 00 EE 02", milliseconds(4000));
  EXPECT_EQ("3C9#E107", bus.ask("44D#61 00 EE 02").substr(0, 8)) << "faulted";
  bus.poll("44D#65 00 EE 02", milliseconds(500));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  EXPECT_EQ(0.0, bus.drive().inverter().frequency()) << "run stands";
  bus.poll("44D#60 00 EE 02", milliseconds(100));
  bus.poll("44D#62 00 EE 02", milliseconds(4000));
  EXPECT_NEAR(-25.0, bus.drive().inverter().frequency(), 0.1) << "run reverse";
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Bit 9 of the eight bytes is this slave's: 0 lets the process data through, 1 keeps the last ones. Instance 110 has
// five bytes; 102 is too long.
TEST(DnProcessData, BitStrobe) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 05 0A"));
  EXPECT_EQ("8E0500", bus.request("0E 05 03 07"));
  EXPECT_EQ("8E0800", bus.request("0E 05 03 08"));
  EXPECT_EQ("906400", bus.request("10 05 03 09 64 00"));
  EXPECT_EQ("389#00700B0000", bus.ask("450#00 00 00 00 00 00 00 00"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  DnConversation four{dnGateway(4, 102)};
  four.goOnline();
  EXPECT_EQ("44B#0A940204", four.ask("44E#0A 4B 03 01 05 0A")) << "more than eight bytes";
}

// Both allocated: the strobe brings the inputs, the poll the outputs. Each has a time-out of its own, and the poll's stops
// the inverter however long strobes come (BU 0280 4.1.3).
TEST(DnProcessData, BitStrobeWithAPollBesideIt) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 07 0A"));
  for (const char* instance : {"02", "03"}) {
    EXPECT_EQ("8E0500", bus.request(std::string{"0E 05 "} + instance + " 07"));
    EXPECT_EQ(instance[1] == '2' ? "8E0500" : "8E0800", bus.request(std::string{"0E 05 "} + instance + " 08"));
    EXPECT_EQ("906400", bus.request(std::string{"10 05 "} + instance + " 09 64 00"));
  }
  EXPECT_EQ("389#00700B0000", bus.ask("450#00 00 00 00 00 00 00 00"));
  EXPECT_EQ("3C9#00700B0000", bus.ask("44D#00 7E 04 00 00"));
  EXPECT_EQ("389#00310B0000", bus.ask("450#00 00 00 00 00 00 00 00"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  for (int i = 0; i < 45; ++i) {
    bus.send("450#00 00 00 00 00 00 00 00");
    bus.bus.run(milliseconds(10));
  }
  EXPECT_EQ(102, bus.drive().inverter().faultNumber()) << "E10.2: polled no more for 400 ms";
}

// At once, when a value changes, and when the packet rate is over; each is acknowledged by 44A, else it comes again.
TEST(DnProcessData, ChangeOfState) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 11 0A"));
  bus.request("0E 05 04 07");
  bus.request("0E 05 02 08");
  bus.request("10 05 02 09 64 00");
  const Texts first = bus.askAll("44C#0A 10 05 04 09 64 00", milliseconds(10));
  EXPECT_THAT(first, ElementsAre("349#00700B0000", "44B#0A906400"));
  EXPECT_THAT(bus.takeAfter(milliseconds(20)), ElementsAre("349#00700B0000")) << "not acknowledged in 16 ms";
  bus.send("44A#");
  EXPECT_THAT(bus.takeAfter(milliseconds(50)), testing::IsEmpty());
  bus.drive().inverter().setWarning(10);
  EXPECT_THAT(bus.takeAfter(milliseconds(10)), ElementsAre("349#00F00B0000"));
  bus.send("44A#");
  const Texts acknowledged = bus.askAll("44D#00 7E 04 00 00", milliseconds(5));
  ASSERT_FALSE(acknowledged.empty());
  EXPECT_EQ("3C9#", acknowledged[0]) << "the data of the scanner are acknowledged";
  bus.send("44A#");
  bus.bus.run(milliseconds(5));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST(DnProcessData, CyclicWithoutAcknowledges) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 61 0A"));
  bus.request("0E 05 04 07");
  bus.request("0E 05 02 08");
  bus.request("10 05 04 09 64 00");
  bus.request("10 05 02 09 64 00");
  unsigned answers = 0;
  for (int i = 0; i < 10; ++i) {
    bus.send("44D#00 7E 04 00 00");
    for (const std::string& text : bus.takeAfter(milliseconds(100))) answers += text.substr(0, 4) == "349#" ? 1u : 0u;
  }
  EXPECT_NEAR(10.0, answers, 1.0);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// "Lose the next requests" means what the scanner would miss an answer to.
TEST(DnProcessData, NobodyAnswersAnAcknowledge) {
  RobotSim robot{dnGateway()};
  const DnStations stations{robot};
  const auto isAnswered = [&](std::uint32_t id) { return stations.isAnswered(dataFrame(id, ByteView{})); };
  EXPECT_FALSE(isAnswered(0x44A));
  for (const std::uint32_t asked : {0x400u, 0x44Cu, 0x44Du, 0x44Eu}) EXPECT_TRUE(isAnswered(asked)) << asked;
}

}  // namespace
}  // namespace nord_driver::sim
