// Compact PCP of the simulated gateway: services word by word.
#include <gtest/gtest.h>

#include <vector>

#include "sim/interbus/pcp_server.h"
#include "sim/interbus/ring_settings.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Words = std::vector<Word>;

class PcpServerTest : public ::testing::Test {
 protected:
  PcpServerTest() {
    run(Duration::zero());
    run(milliseconds{1000});
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end; now += milliseconds{1}) step();
    step();
  }
  void step() {
    ring.advance(now);
    server.advance(now);
  }
  Words result() const {
    Words words;
    for (unsigned i = 0; i < 7; ++i) words.push_back(server.resultAt(600 + i));
    return words;
  }
  /// The result of a service, after the block was cleared.
  Words invoke(const Words& words) {
    for (unsigned i = 0; i < 7; ++i) server.write(500 + i, 0);
    server.invoked(now);
    EXPECT_EQ(Words(7, 0), result());
    for (unsigned i = 0; i < 7; ++i) server.write(500 + i, i < words.size() ? words[i] : Word{0});
    server.invoked(now);
    run(milliseconds{50});
    return result();
  }

  SimConfig config = ringConfig();
  Instant now{std::chrono::hours{1}};
  RobotSim robot{config};
  IbsRing ring{robot};
  PcpServer server{IbsPcp{500, 600, 2, true}, ring};
};

// P508 is object 21FCh (BU 0070 5.1); without a connection nothing is read.
TEST_F(PcpServerTest, InitiateReadWrite) {
  EXPECT_EQ((Words{0x0181, 2, 0x0100, 0, 0, 0, 0}), invoke({0x0081, 2, 0x2069}));
  EXPECT_EQ((Words{0x018B, 2, 0, 0, 0, 0, 0}), invoke({0x008B, 2}));
  EXPECT_EQ((Words{0x0181, 2, 0, 0, 2, 500, 0}), invoke({0x0081, 2, 0x2069, 1})) << "P105 of set 1: 50.0 Hz";
  EXPECT_EQ((Words{0x0182, 2, 0, 0, 0, 0, 0}), invoke({0x0082, 2, 0x2066, 3, 2, 1000}));
  EXPECT_EQ(1000, robot.drive(0).parameters().value(102, 2)) << "P102 of set 3: 10.00 s (BU 0070 7.3)";
  EXPECT_EQ((Words{0x0182, 2, 0, 0, 0, 0, 0}), invoke({0x0082, 2, 0x2265, 1, 4, 1, 2})) << "P613";
}

TEST_F(PcpServerTest, ErrorsHaveClassAndCode) {
  invoke({0x008B, 3});
  EXPECT_EQ((Words{0x0181, 3, 0x0607, 0, 0, 0, 0}), invoke({0x0081, 3, 0x23E7}));
  EXPECT_EQ((Words{0x0181, 3, 0x0607, 0, 0, 0, 0}), invoke({0x0081, 3, 0x6041})) << "no parameter";
  EXPECT_EQ((Words{0x0181, 3, 0x0605, 0x11, 0, 0, 0}), invoke({0x0081, 3, 0x2069, 5}));
  EXPECT_EQ((Words{0x0182, 3, 0x0603, 0, 0, 0, 0}), invoke({0x0082, 3, 0x22BC, 1, 2, 1})) << "P700";
  EXPECT_EQ((Words{0x0182, 3, 0x0800, 0x31, 0, 0, 0}), invoke({0x0082, 3, 0x21FB, 0, 2, 5})) << "P507";
  EXPECT_EQ((Words{0x0182, 3, 0x0605, 0x12, 0, 0, 0}), invoke({0x0082, 3, 0x2069, 1, 4, 0, 500}));
  EXPECT_EQ((Words{0x018C, 9, 0x0100, 0, 0, 0, 0}), invoke({0x008B, 9})) << "no such reference";
  EXPECT_EQ((Words{0x0187, 3, 0x0500, 0, 0, 0, 0}), invoke({0x0087, 3})) << "Compact PCP knows three services";
  robot.drive(1).setInverterPower(false);
  EXPECT_EQ((Words{0x0181, 3, 0x0602, 0, 0, 0, 0}), invoke({0x0081, 3, 0x2069, 1}));
}

TEST_F(PcpServerTest, ARingThatStandsCarriesNothingAndForgetsConnections) {
  invoke({0x008B, 2});
  ring.setCut(true);
  run(milliseconds{10});
  EXPECT_EQ(Words(7, 0), invoke({0x0081, 2, 0x2069, 1}));
  ring.setCut(false);
  run(milliseconds{500});
  EXPECT_EQ(0x0100, invoke({0x0081, 2, 0x2069, 1})[2]);
}

// "Can therefore take several bus cycles" (BU 0070 6.3).
TEST_F(PcpServerTest, TakesSeveralRingCycles) {
  server.write(500, 0x008B);
  server.write(501, 2);
  server.invoked(now);
  run(milliseconds{2});
  EXPECT_EQ(0, result()[0]);
  run(milliseconds{20});
  EXPECT_EQ(0x018B, result()[0]);
  EXPECT_EQ(1u, server.services());
  run(milliseconds{100});
  EXPECT_EQ(1u, server.services()) << "once";
}

}  // namespace
}  // namespace nord_driver::sim
