#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"
#include "sim/profibus/simulated_segment.h"

namespace nord_driver::sim {
namespace {

// 66 bits of request, 32 bits of T_SDR, then eleven bits for each byte of the answer.
TEST(SimulatedSegment, BytesTakeTheirTime) {
  SimulatedSegment segment{oneDrive()};
  segment.open();
  const Instant start = segment.now();
  ASSERT_TRUE(segment.write(fromHex("10 08 01 49 52 16")));
  EXPECT_EQ(start, segment.now());
  ASSERT_TRUE(segment.waitReadable(start + seconds(1.0)));
  EXPECT_EQ(Duration{(66 + 32 + 11) * 2000}, segment.now() - start);  // 2 us a bit at 500 kbit/s
  std::uint8_t buffer[16];
  EXPECT_EQ(1u, segment.read(buffer, sizeof buffer));
  EXPECT_EQ(0x10, buffer[0]);
  EXPECT_FALSE(segment.waitReadable(segment.now() + Duration{21999}));
  EXPECT_TRUE(segment.waitReadable(segment.now() + Duration{1}));
}

TEST(SimulatedSegment, WaitsInNoTime) {
  SimulatedSegment segment{oneDrive()};
  segment.open();
  const Instant start = segment.now();
  EXPECT_FALSE(segment.waitReadable(start + seconds(60.0)));
  EXPECT_EQ(seconds(60.0), segment.now() - start);
  EXPECT_TRUE(segment.keepsBaudRate());
}

TEST(SimulatedSegment, SlowStation) {
  Conversation bus;
  bus.drive().setAnswerDelay(std::chrono::milliseconds(5));
  EXPECT_EQ("", bus.ask("10 08 01 49 52 16", 40, 1000));
  bus.segment.run(std::chrono::milliseconds(10));
  EXPECT_TRUE(bus.segment.waitReadable(bus.segment.now()));
  bus.segment.discardInput();
  EXPECT_FALSE(bus.segment.waitReadable(bus.segment.now()));
}

TEST(SimulatedSegment, LosesAndSpoils) {
  Conversation bus;
  bus.segment.loseRequests(1);
  EXPECT_EQ("", bus.ask("10 08 01 49 52 16"));
  bus.segment.loseAnswers(1);
  EXPECT_EQ("", bus.ask("10 08 01 49 52 16"));
  bus.segment.spoilAnswers(1);
  EXPECT_EQ("14 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
  EXPECT_EQ("10 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// Global_Control (Operate) to all: nobody would miss what is lost of it.
TEST(SimulatedSegment, LosesOfRequestsThoseThatAreAnswered) {
  Conversation bus;
  bus.segment.loseRequests(1);
  EXPECT_EQ("", bus.ask("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16"));
  EXPECT_EQ("", bus.ask("10 08 01 49 52 16"));
  EXPECT_EQ("10 01 08 00 09 16", bus.ask("10 08 01 49 52 16"));
}

// Disturbances are the line's fault, never the master's, and the same seed disturbs the same bytes.
TEST(SimulatedSegment, DisturbsRepeatably) {
  Disturbance disturbance;
  disturbance.lose = disturbance.flip = disturbance.duplicate = 0.02;
  std::string runs[2];
  for (std::string& run : runs) {
    Conversation bus;
    bus.segment.setDisturbance(disturbance);
    for (int i = 0; i < 200; ++i) run += bus.ask("10 08 01 49 52 16") + "|";
    EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  }
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_NE(std::string::npos, runs[0].find("||"));
}

TEST(SimulatedSegment, DeviceGoesAndComes) {
  SimulatedSegment segment{oneDrive()};
  ASSERT_TRUE(segment.open());
  segment.setDevicePresent(false);
  EXPECT_FALSE(segment.isOpen());
  EXPECT_FALSE(segment.write(fromHex("E5")));
  EXPECT_FALSE(segment.open());
  EXPECT_NE("", segment.lastError());
  segment.setDevicePresent(true);
  EXPECT_TRUE(segment.open());
  EXPECT_EQ("", segment.lastError());
}

// A minute of bus time with a turning drive: the models keep up, and nothing of it is written to EEPROM.
TEST(SimulatedSegment, RunsLong) {
  Conversation bus;
  bus.startUp();
  bus.pzdFor("047E 0000", std::chrono::milliseconds(20));
  bus.pzdFor("047F 2000", seconds(60.0));
  const double ideal = 60.0 * 25.0 / 2 * 6.283185307179586;
  EXPECT_GT(bus.drive().shaftAngle(), 0.95 * ideal);
  EXPECT_LT(bus.drive().shaftAngle(), ideal);  // ramp and slip
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  EXPECT_EQ(0u, bus.drive().parameters().eepromWrites());
}

}  // namespace
}  // namespace nord_driver::sim
