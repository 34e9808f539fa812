// The registers of the simulated gateway, by the bytes of the Modbus specification.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/interbus/register_gateway.h"
#include "sim/interbus/ring_settings.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

class RegisterGatewayTest : public ::testing::Test {
 protected:
  RegisterGatewayTest() {
    run(Duration::zero());
    run(milliseconds{1000});
  }
  void run(Duration span) {
    ring.advance(now += span);
    gateway.advance(now);
  }
  /// The answer to a request of this PDU, without its header.
  std::string ask(const std::vector<std::uint8_t>& pdu) {
    std::vector<std::uint8_t> request{0x12, 0x34, 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1), 1};
    request.insert(request.end(), pdu.begin(), pdu.end());
    EXPECT_EQ(request.size(), modbusLength(request));
    const ModbusBytes answer = gateway.handle(request, now);
    if (answer.size() < 7) return "";
    EXPECT_EQ(answer.size() - 6, answer[5]);
    return toHex(ByteView{answer}.sub(7));
  }

  SimConfig config = ringConfig();
  Instant now{std::chrono::hours{1}};
  RobotSim robot{config};
  IbsRing ring{robot};
  RegisterGateway gateway{config.bus.as<IbsBusConfig>(), ring};
};

TEST_F(RegisterGatewayTest, InputsAreReadByFunctions3And4) {
  EXPECT_EQ("04 08 0B 70 00 00 0B 70 00 00", ask({4, 0, 0, 0, 4}));
  EXPECT_EQ("03 02 0B 70", ask({3, 0, 2, 0, 1}));
}

TEST_F(RegisterGatewayTest, OutputsAreWrittenAndReadBack) {
  EXPECT_EQ("10 00 64 00 02", ask({16, 0, 100, 0, 2, 4, 0x04, 0x7E, 0x00, 0x00}));
  EXPECT_EQ(0x047E, ring.outputs()[0]);
  EXPECT_EQ("06 00 66 04 7E", ask({6, 0, 102, 0x04, 0x7E}));
  EXPECT_EQ("03 08 04 7E 00 00 04 7E 00 00", ask({3, 0, 100, 0, 4}));
  run(milliseconds{50});
  EXPECT_EQ("17 04 0B 31 00 00", ask({23, 0, 0, 0, 2, 0, 100, 0, 1, 2, 0x04, 0x7F}));
  EXPECT_EQ(0x047F, ring.outputs()[0]);
}

// MODBUS Application Protocol V1.1b3, chapter 7.
TEST_F(RegisterGatewayTest, WhatIsNotThereIsAnException) {
  EXPECT_EQ("84 02", ask({4, 0, 100, 0, 1}));
  EXPECT_EQ("83 02", ask({3, 0, 3, 0, 2}));
  EXPECT_EQ("83 03", ask({3, 0, 0, 0, 126}));
  EXPECT_EQ("83 03", ask({3, 0, 0, 0, 0}));
  EXPECT_EQ("90 02", ask({16, 0, 103, 0, 2, 4, 0, 0, 0, 0}));
  EXPECT_EQ("90 03", ask({16, 0, 100, 0, 2, 3, 0, 0, 0}));
  EXPECT_EQ("AB 01", ask({43, 14, 1, 0}));
}

TEST_F(RegisterGatewayTest, AnotherUnitOrProtocolIsNotAnswered) {
  EXPECT_TRUE(gateway.handle(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 6, 2, 4, 0, 0, 0, 1}, now).empty());
  EXPECT_TRUE(gateway.handle(std::vector<std::uint8_t>{0, 1, 0, 1, 0, 6, 1, 4, 0, 0, 0, 1}, now).empty());
}

TEST_F(RegisterGatewayTest, ARegisterSaysThatTheRingRuns) {
  EXPECT_EQ("04 02 00 01", ask({4, 0, 200, 0, 1}));
  ring.setCut(true);
  run(milliseconds{10});
  EXPECT_EQ("04 02 00 00", ask({4, 0, 200, 0, 1}));
}

// A clean end of the requests, or of the computer: the outputs become 0, not the drives' stop.
TEST_F(RegisterGatewayTest, TheWatchdogEndsTheOutputs) {
  EXPECT_EQ("10 01 2C 00 01", ask({16, 1, 0x2C, 0, 1, 2, 0, 100}));
  EXPECT_EQ("03 02 00 64", ask({3, 1, 0x2C, 0, 1}));
  ask({16, 0, 100, 0, 1, 2, 0x04, 0x7E});
  run(milliseconds{100});
  ask({4, 0, 0, 0, 4});
  EXPECT_EQ(0x047E, ring.outputs()[0]);
  run(milliseconds{1});
  EXPECT_EQ(0, ring.outputs()[0]) << "reading feeds it not";
  EXPECT_EQ(1u, gateway.watchdogTrips());
  run(milliseconds{100});
  EXPECT_EQ("no rule broken", ring.report()) << "the zeros are the gateway's own";
}

TEST_F(RegisterGatewayTest, SwitchesSpoilTheAnswers) {
  gateway.setSwitches({false, {}, std::uint8_t{6}, 0});
  EXPECT_EQ("84 06", ask({4, 0, 0, 0, 1}));
  gateway.setSwitches({true, {}, {}, 0});
  EXPECT_EQ("", ask({16, 0, 100, 0, 1, 2, 0x04, 0x7E}));
  EXPECT_EQ(0x047E, ring.outputs()[0]) << "carried out all the same";
  gateway.setSwitches({false, {}, {}, 1});
  EXPECT_EQ(0x35, gateway.handle(std::vector<std::uint8_t>{0x12, 0x34, 0, 0, 0, 6, 1, 4, 0, 0, 0, 1}, now)[1]);
}

TEST(ModbusLength, WaitsForTheWholeRequest) {
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, 1, 0xFF};
  EXPECT_EQ(12u, modbusLength(bytes));
  EXPECT_EQ(0u, modbusLength(ByteView{bytes}.sub(0, 11)));
  EXPECT_EQ(0u, modbusLength(ByteView{bytes}.sub(0, 5)));
}

}  // namespace
}  // namespace nord_driver::sim
