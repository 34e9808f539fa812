#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

constexpr const char* kInitiate = "57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00";
constexpr const char* kRefused = "10 01 08 03 0C 16";

/// A module nobody has parameterised, and class-2 masters that talk to it.
class Class2 : public ::testing::Test {
 protected:
  /// One telegram in low priority from access point 50; the answer without its frame, or as it is.
  std::string send(unsigned access_point, const std::string& pdu) {
    std::vector<std::uint8_t> unit{static_cast<std::uint8_t>(access_point), 50};
    for (const std::uint8_t byte : fromHex(pdu)) unit.push_back(byte);
    const std::string answer = bus.askBytes(Conversation::variable(0x88, 0x81, bus.frameCount() & 0xFEu, unit));
    return answer.substr(0, 2) == "68" ? answer.substr(27, answer.size() - 33) : answer;
  }
  std::string poll(unsigned access_point) {
    std::string answer = send(access_point, "");
    for (int polls = 0; answer == "E5" && polls < 10; ++polls) answer = send(access_point, "");
    return answer;
  }
  std::string connect(const std::string& initiate = kInitiate) {
    const std::string taken = send(49, initiate);
    if (taken != "E5") return taken;
    const std::string grant = poll(49);
    return grant.substr(0, 2) == "56" ? poll(fromHex(grant)[1]) : grant;
  }
  Class2Server& connections() { return bus.segment.stations().module(0).connections(); }
  void letPass(Duration span) { bus.segment.run(span); }

  Conversation bus{oneModule(1)};
};

// Resource manager, initiate, record, idle and abort, byte for byte; the module is in WAIT_PRM all the time.
TEST_F(Class2, ByteForByte) {
  EXPECT_EQ("E5",
            bus.ask("68 19 19 68 88 81 6C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 98 16"));
  EXPECT_EQ("68 09 09 68 81 88 08 32 31 56 30 00 14 0E 16", bus.ask("68 05 05 68 88 81 5C 31 32 C8 16"));
  EXPECT_EQ("E5", bus.ask("68 05 05 68 88 81 7C 30 32 E7 16"));
  EXPECT_EQ("68 15 15 68 81 88 08 32 30 57 F0 01 00 00 00 00 00 00 02 00 02 00 00 00 00 BF 16",
            bus.ask("68 05 05 68 88 81 5C 30 32 C7 16"));
  EXPECT_EQ("E5", bus.ask("68 11 11 68 88 81 7C 30 32 5F 00 65 08 15 E4 00 00 00 00 00 00 AC 16"));
  EXPECT_EQ("E5", bus.ask("68 05 05 68 88 81 5C 30 32 C7 16"));
  EXPECT_EQ("68 09 09 68 81 88 08 32 30 5F 00 65 08 3F 16", bus.ask("68 05 05 68 88 81 7C 30 32 E7 16"));
  EXPECT_EQ("E5", bus.ask("68 06 06 68 88 81 5C 30 32 48 0F 16"));
  EXPECT_EQ("68 06 06 68 81 88 08 32 30 48 BB 16", bus.ask("68 05 05 68 88 81 7C 30 32 E7 16"));
  EXPECT_EQ(1u, connections().open());
  EXPECT_EQ("E5", bus.ask("68 08 08 68 88 81 5C 30 32 58 01 20 40 16"));
  EXPECT_EQ(0u, connections().open());
  EXPECT_EQ("10 01 08 03 0C 16", bus.ask("68 05 05 68 88 81 7C 30 32 E7 16")) << "it is closed";
  EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// BU 0220 8.3.3.2: up to three class-2 masters; the fourth finds no access point (RS), until one is free again.
TEST_F(Class2, ThreeConnections) {
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ("57 F0", connect().substr(0, 5)) << i;
  EXPECT_EQ(3u, connections().open());
  EXPECT_EQ(kRefused, send(49, kInitiate));
  EXPECT_EQ("E5", send(47, "58 01 20"));
  EXPECT_EQ("57 F0", connect().substr(0, 5));
}

// A master that says nothing for its Send_Timeout (1 s) is gone: ABT_TO, and the access point is free.
TEST_F(Class2, TimeOut) {
  connect();
  letPass(std::chrono::milliseconds(900));
  EXPECT_EQ("E5", send(48, "48"));
  EXPECT_EQ("48", poll(48));
  letPass(std::chrono::milliseconds(900));
  EXPECT_EQ(1u, connections().open());
  letPass(std::chrono::milliseconds(200));
  EXPECT_EQ(0u, connections().open());
  EXPECT_EQ("58 01 13", poll(48));
  EXPECT_EQ(kRefused, send(48, ""));
}

// Each reason of an abort a master can provoke.
TEST_F(Class2, AbortReasons) {
  EXPECT_EQ("58 01 16", connect("57 00 00 00 00 05 01 00 00 00 00 00 00 02 00 02 00 00 00 00")) << "ABT_STO: 50 ms";
  EXPECT_EQ("58 01 17", connect("57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 03 00")) << "ABT_IA: API 3";
  EXPECT_EQ("D7 80 A9 00", connect("57 00 00 00 00 64 00 00 00 00 00 00 00 02 00 02 00 00 00 00")) << "no read";
  EXPECT_EQ("58 01 12", connect("57 00 00")) << "ABT_FE: too short";
  connect();
  send(48, "5E 00 65 08");
  EXPECT_EQ("58 01 11", send(48, "5E 00 65 08")) << "ABT_SE: one is outstanding";
  connect();
  EXPECT_EQ("58 01 12", send(48, "77 00")) << "ABT_FE: no such function";
  EXPECT_EQ(0u, connections().open());
}

// A connection belongs to the master that opened it, and ends with the supply of the module.
TEST_F(Class2, OfOneMasterOnly) {
  connect();
  EXPECT_EQ("10 02 08 03 0D 16", bus.ask("68 05 05 68 88 82 6C 30 32 D8 16"));
  bus.station().setPowered(false);
  bus.station().setPowered(true);
  EXPECT_EQ(0u, connections().open());
}

// The type plate: BU 0220 8.3.4.8 gives 393 (0189h).
TEST_F(Class2, TypePlate) {
  connect();
  send(48, "5F 00 FF 04 08 00 FD E8");
  EXPECT_EQ("5F 00 FF 04", poll(48));
  send(48, "5E 00 FF 44");
  const std::string record = poll(48);
  EXPECT_EQ("5E 00 FF 44 08 00 FD E8", record.substr(0, 23));
  EXPECT_EQ("01 89 53 4B 20 43 55 34", record.substr(54, 23));
  EXPECT_EQ(3u * 72u - 1u, record.size());
  send(48, "5F 00 FF 04 08 00 FD E9");
  EXPECT_EQ("DF 80 B0 00", poll(48)) << "I&M1 is not there";
  send(48, "5E 00 FF 44");
  EXPECT_EQ("DE 80 B5 00", poll(48)) << "nothing was called";
}

// SK TU1, TU2 and TU3 have no acyclic channel.
TEST(Class2OfOtherModules, AreNotThere) {
  Conversation bus;
  EXPECT_EQ("10 01 08 03 0C 16",
            bus.ask("68 19 19 68 88 81 6C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 98 16"));
}

}  // namespace
}  // namespace nord_driver::sim
