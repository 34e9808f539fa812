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

// After the last retry a slave is given up: it is asked for its FDL status, and then, its watchdog of 100 ms over, starts
// anew with FCV = 0, FCB = 1.
TEST(Loss, StartsAnewWith6D) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  wire.advance(100ms);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(LossCause::kSilence, wire.tells(DpEventKind::kSlaveLost).cause);
  EXPECT_EQ(1u, wire.status().counters.losses);
  EXPECT_EQ(0u, wire.status().counters.departures) << "not known yet";
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  EXPECT_EQ(1u, wire.status().counters.departures);
  wire.cycle("68 05 05 68 88 81 6D 3C 3E F0 16", kWantsPrm);
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  wire.tells(DpEventKind::kDataExchangeEntered);
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(1u, wire.status().counters.departures);
}

// Found before its watchdog has run out, it is in data exchange still, and the wheel behind it may turn: the stop word is
// the first it hears. Set_Prm would start the watchdog anew and clear the outputs, which stops nothing.
TEST(Loss, FoundInTimeItHearsTheNextWordAtOnce) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  wire.forgetEvents();
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.isGoneOnWith();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  wire.tells(DpEventKind::kDataExchangeEntered);
  wire.cycle(kExchange7D, kInputs);
  wire.tellsNothing();
  EXPECT_EQ(1u, wire.status().counters.losses);
  EXPECT_EQ(0u, wire.status().counters.departures);
}

// Its Stat_Diag stood when it fell silent: whether it does still is asked, for its inputs do not count until then, and
// it need not announce that it has gone.
TEST(Loss, FoundInTimeItIsAskedForAStandingStatDiag) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives("68 0B 0B 68 81 88 08 3E 3C 00 0E 00 01 75 31 40 16");
  wire.cycleEnds();
  loses(wire, kExchange7D);
  wire.isFound();
  wire.isGoneOnWith();
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// That word, too, it may hear without being heard: it is told once that it was lost, and its state is asked for again.
TEST(Loss, FoundInTimeAndSilentAgainItIsTheSameLoss) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  wire.forgetEvents();
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  loses(wire, kExchange6D);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  wire.advance(100ms);
  wire.isFound();
  wire.isFree();
  wire.tellsNothing();
  EXPECT_EQ(1u, wire.status().counters.losses);
}

// It was off meanwhile, and says so.
TEST(Loss, FoundInTimeAndNotInDataExchangeItStartsAnew) {
  NordWire wire;
  wire.startsUp();
  loses(wire, kExchange7D);
  wire.forgetEvents();
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  wire.cycle(kExchange6D, kNotActivated);
  wire.tellsNothing();
  wire.isFree();
  wire.takesParameters();
  EXPECT_EQ(1u, wire.status().counters.losses);
}

// A slave stays in data exchange until its watchdog runs out, and so does its master, for as long as it was told: the
// slave hears every stop word meanwhile. Whether it took a request nobody knows: the next one begins the frame count.
TEST(Loss, ComesWhenTheSilenceHasLasted) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  const Instant answered = wire.now;
  loses(wire, kExchange5D);  // twice 12 ms of telegram and 5 ms of slot
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.tellsNothing();
  loses(wire, kExchange6D);
  EXPECT_LT(wire.now - answered, 90ms);
  wire.tellsNothing();
  loses(wire, kExchange6D);
  EXPECT_EQ(LossCause::kSilence, wire.tells(DpEventKind::kSlaveLost).cause);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  EXPECT_EQ(1u, wire.status().counters.losses);
  wire.isFound();
}

TEST(Loss, IsNoneWhenTheSilenceWasShort) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 50ms);
  wire.startsUp();
  for (int i = 0; i < 5; ++i) {
    wire.cycle(i == 0 ? kExchange7D : kExchange5D, kInputs);
    loses(wire, i == 0 ? kExchange5D : kExchange7D);
    EXPECT_STRNE("", wire.status().note);
    wire.cycle(kExchange6D, kInputs);
    EXPECT_TRUE(wire.status().exchanged_this_cycle);
    EXPECT_STREQ("", wire.status().note);
    wire.cycle(kExchange5D, kInputs);
    wire.cycle(kExchange7D, kInputs);
  }
  wire.tellsNothing();
  EXPECT_EQ(0u, wire.status().counters.losses);
}

// What says "not in data exchange" ends it at once.
TEST(Loss, IsCertainByAnAnswer) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 50ms);
  wire.startsUp();
  loses(wire, kExchange7D);
  wire.cycle(kExchange6D, kNotActivated);
  EXPECT_EQ(LossCause::kLeftDataExchange, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.isFree();
}

// Its watchdog of 100 ms has run out: it is in data exchange no longer, whatever the limit.
TEST(Loss, ComesWithTheWatchdogAtTheLatest) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 10s);
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  const Instant answered = wire.now;
  loses(wire, kExchange5D);
  while (wire.status().phase == SlavePhase::kDataExchange) loses(wire, kExchange6D);
  EXPECT_GE(wire.now - answered, 100ms);
  EXPECT_LE(wire.now - answered, 140ms);
}

// A slave that did not answer costs the others no more than that.
TEST(Loss, NothingElseIsAskedOfASilentSlave) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  wire.announcesWithoutTelling();
  EXPECT_TRUE(wire.status().exchanged_this_cycle) << "its inputs were good";
  loses(wire, kExchange6D);  // and no diagnosis
  wire.isGoneOnWith();
  wire.tellsNothing();
}

// It exchanges data, and does not tell its diagnosis for as long as that.
TEST(Loss, OfTheDiagnosisIsALossToo) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  const Instant begin = wire.now;
  for (int i = 0; wire.status().phase == SlavePhase::kDataExchange; ++i) {
    ASSERT_LT(wire.now - begin, 300ms);
    wire.startCycle();
    wire.sends(i == 0 ? kExchange7D : kExchange6D);
    wire.receives(kInputsDh);
    for (int sending = 0; sending < 2; ++sending) {
      wire.sends(kDiag5D);
      wire.staysSilent();
    }
    wire.cycleEnds();
  }
  EXPECT_GE(wire.now - begin, 90ms);
  wire.tells(DpEventKind::kSlaveLost);
}

// E5 is a single byte, and noise makes it.
TEST(Loss, AShortAcknowledgeIsNoOtherLengthAtOnce) {
  NordWire wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.startsUp();
  wire.startCycle();
  for (int i = 0; i < 2; ++i) {
    wire.sends(kExchange7D);
    wire.receives("E5");
    wire.staysSilent();
  }
  wire.cycleEnds();
  wire.tellsNothing();
  wire.cycle(kExchange6D, kInputs);
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
  EXPECT_EQ(1u, wire.status().counters.departures);
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  wire.tells(DpEventKind::kDataExchangeEntered);
  EXPECT_EQ(1u, wire.status().counters.departures);
}

// Until it is in data exchange again it cannot leave it a second time.
TEST(Loss, LeavesDataExchangeOnce) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kNotActivated);
  ASSERT_EQ(1u, wire.status().counters.departures);
  wire.isFree();
  wire.cycle(kSetPrm5D, kNotActivated);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  wire.advance(1s);
  wire.isFree();
  EXPECT_EQ(SlavePhase::kParameters, wire.status().phase);
  EXPECT_EQ(1u, wire.status().counters.departures);
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
    EXPECT_EQ(1u, wire.status().counters.departures);
    wire.isFree();
  }
}

// A slave with another length than configured is named so, and tried again when its watchdog of 100 ms has run out, with
// 250 ms to spare.
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
  wire.startCycle();
  wire.cycleEnds();
  wire.advance(100ms);
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
