#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

void loses(NordWire& wire, const char* exchange) {
  wire.startCycle();
  wire.sends(exchange);
  wire.staysSilent();
  wire.sends(exchange);
  wire.staysSilent();
  wire.cycleEnds();
}

// After the last retry a slave is given up: it is asked for its FDL status, and then starts anew with FCV = 0, FCB = 1.
TEST(Loss, StartsAnewWith6D) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(LossCause::kSilence, wire.tells(DpEventKind::kSlaveLost).cause);
  EXPECT_EQ(1u, wire.status().counters.losses);
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  wire.cycle("68 05 05 68 88 81 6D 3C 3E F0 16", kWantsPrm);
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  wire.tells(DpEventKind::kDataExchangeEntered);
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// The inputs of a lost slave stay readable, but are not fresh.
TEST(Loss, KeepsTheLastInputs) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  loses(wire, kExchange5D);
  EXPECT_EQ("00 00 00 00 00 00 00 00 0B 31 00 00", toHex(wire.master.inputs(0)));
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
}

// A slave that comes back is in data exchange again well within 2 s, at a bus cycle of 20 ms.
TEST(Loss, ReturnsWithinTwoSeconds) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  for (int i = 0; i < 20; ++i) {  // away for 5 s
    wire.startCycle();
    wire.sends(kFdlStatus8);
    wire.staysSilent();
    wire.cycleEnds();
    wire.advance(249ms);
  }
  const Instant back = wire.now;
  while (wire.status().phase == SlavePhase::kSilent) {
    ASSERT_LT(wire.now - back, 2s) << "the station is not found again";
    const Instant start = wire.now;
    wire.startCycle();
    if (!wire.master.cycleDone()) {
      wire.sends(kFdlStatus8);
      wire.receives(kHere8);
    }
    wire.now = start + 20ms;
  }
  for (const auto& [request, answer] : {std::pair{kDiag6D, kWantsPrm},
                                        {kSetPrm5D, "E5"},
                                        {kChkCfg7D, "E5"},
                                        {kDiag5D, kReady},
                                        {kExchange7D, kInputs}}) {
    const Instant start = wire.now;
    wire.cycle(request, answer);
    EXPECT_LE(wire.now - start, 50ms);
    wire.now = std::max(wire.now, start + 20ms);
  }
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_LT(wire.now - back, 700ms);
}

// RS in data exchange: the slave's watchdog ran out, or it was switched off and on. From the beginning, at once.
TEST(Loss, StartsOverWhenTheSlaveLeftDataExchange) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kNotActivated);
  EXPECT_EQ(SlavePhase::kFirstDiagnosis, wire.status().phase);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(LossCause::kLeftDataExchange, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  wire.tells(DpEventKind::kDataExchangeEntered);
}

// A diagnosis with Prm_Req in data exchange, or one of no owner: from the beginning.
TEST(Loss, StartsOverWhenTheDiagnosisAsksForParameters) {
  for (const char* diagnosis :
       {"68 0B 0B 68 81 88 08 3E 3C 02 05 00 01 75 31 39 16", "68 0B 0B 68 81 88 08 3E 3C 02 04 00 FF 75 31 36 16"}) {
    NordWire wire;
    wire.startsUp();
    wire.startCycle();
    wire.sends(kExchange7D);
    wire.receives(kInputsDh);
    wire.sends(kDiag5D);
    wire.receives(diagnosis);
    wire.cycleEnds();
    EXPECT_FALSE(wire.status().exchanged_this_cycle);
    EXPECT_EQ(LossCause::kParametersRequested, wire.tells(DpEventKind::kSlaveLost).cause);
    wire.isFree();
  }
}

// A slave with another length than configured is named so, and tried again after a pause, not in a tight loop.
TEST(Loss, NamesAnotherLength) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  for (int i = 0; i < 2; ++i) {
    wire.sends(kExchange7D);
    wire.receives("68 07 07 68 01 08 08 0B 31 00 00 4D 16");
    wire.staysSilent();
  }
  wire.cycleEnds();
  EXPECT_EQ(LossCause::kWrongAnswers, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.tells(DpEventKind::kConfigurationFault);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  wire.startCycle();
  wire.cycleEnds();
  wire.advance(250ms);
  wire.isFree();
}

// Silence in the start-up leads back to FDL status, and the count starts at 6D. A slave that comes and goes without
// ever exchanging data is told once.
TEST(Loss, InTheStartUp) {
  NordWire wire;
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  wire.isFree();
  loses(wire, kSetPrm5D);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  wire.startCycle();
  wire.cycleEnds();
  wire.advance(250ms);
  wire.isFound();
  wire.tellsNothing();
  loses(wire, kDiag6D);
  wire.advance(250ms);
  wire.startsUp();
  EXPECT_EQ(0u, wire.status().counters.losses);
}

// The link was opened anew: what was under way is forgotten, every slave starts from the beginning, the line is given
// its pause.
TEST(Loss, RestartStartsEverySlaveFromTheBeginning) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.advance(1s);
  wire.restart();
  EXPECT_TRUE(wire.master.cycleDone());
  EXPECT_EQ(LossCause::kLinkRestarted, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
}

}  // namespace
}  // namespace nord_driver::profibus
