// A slave that answers every exchange and refuses it: its watchdog may be fed by the requests, while no stop word is
// taken. It is lost as a silent one is, and left alone until its watchdog has run out.
#include <gtest/gtest.h>

#include <string>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr const char* kRdl = "68 0F 0F 68 01 08 0C 00 00 00 00 00 00 00 00 0B 31 00 00 51 16";
constexpr const char* kRdh = "68 0F 0F 68 01 08 0D 00 00 00 00 00 00 00 00 0B 31 00 00 52 16";
constexpr const char* kRr = "10 01 08 02 0B 16";
constexpr const char* kUe = "10 01 08 01 0A 16";
constexpr const char* kNr = "10 01 08 09 12 16";

/// One exchange refused, and the diagnosis behind it, which is clean, where it is asked for.
void refuses(NordWire& wire, const char* exchange, const char* refusal, const char* diagnosis_request) {
  wire.startCycle();
  wire.sends(exchange);
  wire.receives(refusal);
  if (wire.status().phase == SlavePhase::kDataExchange) {
    wire.sends(diagnosis_request);
    wire.receives(kReady);
  }
  wire.cycleEnds();
}

class Refusals : public testing::TestWithParam<const char*> {};

TEST_P(Refusals, ThatLastAreALoss) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  const Instant taken = wire.now;
  Instant asked{};
  for (int i = 0; wire.status().phase == SlavePhase::kDataExchange; ++i) {
    ASSERT_LT(i, 20) << "the exchange goes on for ever";
    asked = wire.now;
    refuses(wire, kExchange5D, GetParam(), kDiag7D);
    EXPECT_FALSE(wire.status().exchanged_this_cycle);
  }
  EXPECT_GE(wire.now - taken, 90ms);
  EXPECT_LE(wire.now - taken, 160ms);
  const DpEvent lost = wire.tells(DpEventKind::kSlaveLost);
  EXPECT_EQ(LossCause::kRefused, lost.cause);
  EXPECT_NE(std::string::npos, std::string{lost.text}.find("refuses data exchange"));
  EXPECT_NE(std::string::npos, std::string{wire.status().note}.find("refuses data exchange"));
  EXPECT_EQ(1u, wire.status().counters.losses);
  // Nothing is sent until its watchdog of 100 ms has run out, with some to spare; then it is set up again.
  while (wire.now < asked + 150ms) {
    wire.startCycle();
    wire.cycleEnds();
    wire.advance(10ms);
  }
  wire.advance(500ms);
  wire.isFree();
  wire.takesParameters();
}

INSTANTIATE_TEST_SUITE_P(Codes, Refusals, testing::Values(kRdl, kRdh, kRr, kUe, kNr));

// A watchdog of 3 s: the pause before the start-up is as long.
TEST(Refusals, ALongWatchdogIsWaitedFor) {
  SlaveConfig slave = nordModule(8);
  slave.watchdog = 3s;
  NordWire wire{quietBus(), slave};
  wire.isFound();
  wire.isFree();
  wire.cycle("68 0C 0C 68 88 81 5D 3D 3E 88 96 02 0B 75 31 00 B2 16", kShortAcknowledge);
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  refuses(wire, kExchange7D, kRr, kDiag5D);
  refuses(wire, kExchange7D, kRr, kDiag5D);  // without a limit, the second is the last
  const Instant asked = wire.now;
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  while (wire.now < asked + 3s) {
    wire.startCycle();
    wire.cycleEnds();
    wire.advance(50ms);
  }
  wire.advance(1s);
  wire.isFree();
}

// The line is opened anew meanwhile: the outputs it has may be the last it took.
TEST(Refusals, BehindAReopenedLineNothingIsParameterisedSooner) {
  NordWire wire;
  wire.startsUp();
  refuses(wire, kExchange7D, kRr, kDiag5D);
  refuses(wire, kExchange7D, kRr, kDiag5D);
  wire.restart();
  wire.isFound();
  wire.cycle(kExchange6D, kNotActivated);
  wire.isFree();
}

// One taken exchange between them, and they begin to count anew.
TEST(Refusals, ThatPassAreNone) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  for (int i = 0; i < 10; ++i) {
    refuses(wire, kExchange7D, kRr, kDiag5D);
    refuses(wire, kExchange7D, kRdl, kDiag5D);
    wire.cycle(kExchange7D, kInputs);
    EXPECT_TRUE(wire.status().exchanged_this_cycle);
    wire.cycle(kExchange5D, kInputs);
  }
  wire.tellsNothing();
  EXPECT_EQ(0u, wire.status().counters.losses);
}

// Found again before its watchdog has run out, it refuses the first word: it is in data exchange, and Set_Prm would
// start the watchdog anew.
TEST(Refusals, OfTheFirstWordLeadToNoNewParametersAtOnce) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  wire.restart();
  wire.isFound();
  refuses(wire, kExchange6D, kRr, kDiag5D);
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

}  // namespace
}  // namespace nord_driver::profibus
