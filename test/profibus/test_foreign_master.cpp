// When what is heard is another master, and when it is noise: a token has no checksum.
#include <gtest/gtest.h>

#include <random>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

// Requests of another master are counted and told, once per 10 s: their checksum makes one enough.
TEST(ForeignMaster, IsBelievedByOneRequest) {
  NordWire wire;
  wire.arrives("10 08 03 49 54 16");
  EXPECT_EQ(3, wire.tells(DpEventKind::kForeignMaster).master);
  wire.arrives("10 08 03 49 54 16  68 05 05 68 88 83 6D 3C 3E F2 16");
  wire.tellsNothing();
  EXPECT_EQ(3u, wire.master.counters().foreign_telegrams);
  wire.advance(10s);
  wire.arrives("10 08 03 49 54 16");
  EXPECT_EQ(3, wire.tells(DpEventKind::kForeignMaster).master);
}

// Three bytes of noise are a token as often as not.
TEST(ForeignMaster, IsNotBelievedByOneToken) {
  NordWire wire;
  wire.arrives("DC 05 03");
  wire.tellsNothing();
  EXPECT_EQ(0u, wire.master.counters().foreign_telegrams);
}

// A master without a neighbour hands the token to itself, many times a second.
TEST(ForeignMaster, IsBelievedByItsSecondToken) {
  NordWire wire;
  wire.arrives("DC 03 03");
  wire.advance(30ms);
  wire.arrives("DC 03 03");
  EXPECT_EQ(3, wire.tells(DpEventKind::kForeignMaster).master);
  EXPECT_EQ(1u, wire.master.counters().foreign_telegrams);
}

// Two masters hand it to and fro.
TEST(ForeignMaster, IsBelievedInARing) {
  NordWire wire;
  for (int i = 0; i < 2; ++i) {
    wire.arrives("DC 05 03");
    wire.advance(10ms);
    wire.arrives("DC 03 05");
    wire.advance(10ms);
  }
  wire.tells(DpEventKind::kForeignMaster);
}

TEST(ForeignMaster, IsNotBelievedByTokensThatDoNotAgree) {
  NordWire wire;
  for (const char* noise : {"DC 05 03", "DC 11 07", "DC 05 44"}) {
    wire.arrives(noise);
    wire.advance(20ms);
  }
  wire.tellsNothing();
}

// A token comes round in milliseconds, and behind another one at the earliest when that has been sent.
TEST(ForeignMaster, IsNotBelievedByTokensOutOfTime) {
  NordWire wire;
  wire.arrives("DC 03 03");
  wire.advanceBits(40);
  wire.arrives("DC 03 03");
  wire.tellsNothing();
  wire.advance(3s);
  wire.arrives("DC 03 03");
  wire.tellsNothing();
}

// Behind bytes that are no telegram it is a piece of something else.
TEST(ForeignMaster, IsNotBelievedByTokensInsideNoise) {
  NordWire wire;
  for (int i = 0; i < 5; ++i) {
    wire.arrives("E7 A7 DC 03 03");
    wire.advance(20ms);
  }
  wire.tellsNothing();
}

// An open line, or one without termination: hours of it are nobody.
TEST(ForeignMaster, IsNotMadeOfNoise) {
  NordWire wire;
  std::mt19937 random{17};
  for (int burst = 0; burst < 20'000; ++burst) {
    std::string noise;
    const unsigned length = 1 + static_cast<unsigned>(random() % 6);
    for (unsigned i = 0; i < length; ++i) {
      // Every other byte begins a token: far more of them than chance would make.
      const unsigned byte = i == 0 ? 0xDCu : static_cast<unsigned>(random() % 256);
      char text[4];
      std::snprintf(text, sizeof text, "%02X ", byte);
      noise += text;
    }
    wire.arrives(noise);
    wire.advance(std::chrono::milliseconds{50 + random() % 200});
    while (const auto event = wire.master.pollEvent()) {
      EXPECT_NE(static_cast<int>(DpEventKind::kForeignMaster), static_cast<int>(event->kind)) << burst;
    }
  }
}

}  // namespace
}  // namespace nord_driver::profibus
