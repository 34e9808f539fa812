#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

// The outputs set last are sent, cut or filled with zeros to the configured length; before the first call they are
// zeros.
TEST(Exchange, SendsTheOutputsSetLast) {
  NordWire wire;
  wire.startsUp();
  wire.master.setOutputs(0, fromHex("00 00 00 00 00 00 00 00  04 7F 20 00"));
  wire.cycle("68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7F 20 00 29 16",
             "68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 37 20 00 73 16");
  EXPECT_EQ("00 00 00 00 00 00 00 00 0B 37 20 00", toHex(wire.master.inputs(0)));
  wire.master.setOutputs(0, fromHex("15 E4 00 00 00 00 00 00 04 7E 00 00 FF FF"));
  wire.cycle("68 0F 0F 68 08 01 5D 15 E4 00 00 00 00 00 00 04 7E 00 00 E1 16", kInputs);
  wire.master.setOutputs(0, fromHex("15 E4"));
  wire.cycle("68 0F 0F 68 08 01 7D 15 E4 00 00 00 00 00 00 00 00 00 00 7F 16", kInputs);
}

// A retry repeats the very same bytes, with the same FCB; the answer to it completes the exchange.
TEST(Exchange, RepeatsTheSameBytes) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.staysSilent();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(1u, wire.master.counters().retries);
  EXPECT_EQ(1u, wire.master.counters().timeouts);
  EXPECT_EQ(1u, wire.status().counters.retries);
  wire.cycle(kExchange5D, kInputs);  // the count went on by one
}

// New outputs do not slip into a retry: a slave would take the repeated FCB for a repetition and drop them.
TEST(Exchange, KeepsNewOutputsOutOfARetry) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.master.setOutputs(0, fromHex("00 00 00 00 00 00 00 00  04 7F 20 00"));
  wire.staysSilent();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.cycle("68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7F 20 00 09 16", kInputs);
}

// DH announces a diagnosis: one Slave_Diag after the exchanges of the cycle, with the slave's own frame count.
TEST(Exchange, FetchesTheDiagnosisThatDhAnnounces) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  // Ext_Diag with a device block 02 04: the link to the inverter is broken (BU 0020 8.2).
  wire.receives("68 0D 0D 68 81 88 08 3E 3C 08 0C 00 01 75 31 02 04 4C 16");
  wire.cycleEnds();
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_TRUE(wire.status().diagnosis.extended());
  EXPECT_TRUE(wire.status().diagnosis.watchdogOn());
  EXPECT_EQ("02 04", toHex(wire.status().diagnosis.extendedBytes()));
  wire.cycle(kExchange7D, kInputs);  // and no second one
}

// A slave that says DH every time is asked once per cycle, not for ever.
TEST(Exchange, AsksForOneDiagnosisPerCycle) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
}

// Stat_Diag: outputs go on, because a stop must reach the drive, but the inputs do not count until it has gone.
TEST(Exchange, DoesNotTrustInputsWhileStatDiagStands) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputsDh);
  wire.sends(kDiag5D);
  wire.receives("68 0B 0B 68 81 88 08 3E 3C 00 0E 00 01 75 31 40 16");
  wire.cycleEnds();
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_STRNE("", wire.status().note);
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 FF FF FF FF 0D 16");
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_EQ("00 00 00 00 00 00 00 00 0B 31 00 00", toHex(wire.master.inputs(0)));
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_STREQ("", wire.status().note);
}

// RR, UE or NR instead of data: no exchange, no retry; the diagnosis is asked for the reason.
TEST(Exchange, AsksWhyWhenAnAnswerCarriesNoData) {
  for (const char* refusal : {"10 01 08 02 0B 16", "10 01 08 01 0A 16", "10 01 08 09 12 16"}) {
    NordWire wire;
    wire.startsUp();
    wire.startCycle();
    wire.sends(kExchange7D);
    wire.receives(refusal);
    wire.sends(kDiag5D);
    wire.receives(kReady);
    wire.cycleEnds();
    EXPECT_FALSE(wire.status().exchanged_this_cycle);
    EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
    wire.cycle(kExchange7D, kInputs);
  }
}

// RDL: the slave has data to give, but did not take ours.
TEST(Exchange, DoesNotCountOutputsThatWereNotTaken) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("68 0F 0F 68 01 08 0C 00 00 00 00 00 00 00 00 0B 31 00 00 51 16");
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
}

// SC is legal where a slave has nothing to say; from a slave with inputs it is an error, and the exchange is repeated.
TEST(Exchange, CountsAShortAcknowledgeThatIsNone) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("E5");
  EXPECT_EQ(1u, wire.master.counters().unexpected);
  EXPECT_EQ(1u, wire.status().counters.unexpected);
  EXPECT_FALSE(wire.master.cycleDone());
  wire.staysSilent();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// Only the station asked, to us, with the right access points, length and function, answers the request.
TEST(Exchange, IgnoresEverythingThatIsNotTheAnswer) {
  const char* const kNoAnswers[] = {
      "68 0F 0F 68 01 09 08 00 00 00 00 00 00 00 00 0B 31 00 00 4E 16",        // from station 9
      "68 0F 0F 68 02 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4E 16",        // to master 2
      "68 0E 0E 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 4D 16",           // 11 bytes
      "68 10 10 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 00 4D 16",     // 13 bytes
      "68 11 11 68 81 88 08 3E 3C 00 00 00 00 00 00 00 00 0B 31 00 00 C7 16",  // from access point 60
      "68 0F 0F 68 01 08 07 00 00 00 00 00 00 00 00 0B 31 00 00 4C 16",        // a function that answers nothing
      "68 0F 0F 68 01 08 28 00 00 00 00 00 00 00 00 0B 31 00 00 6D 16",        // from a master
      "10 01 08 00 09 16",                                                     // OK, where data are due
      "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 75 31 3E 16",                    // a diagnosis
  };
  for (const char* telegram : kNoAnswers) {
    NordWire wire;
    wire.startsUp();
    wire.startCycle();
    wire.sends(kExchange7D);
    wire.receives(telegram);
    EXPECT_FALSE(wire.master.cycleDone()) << telegram;
    EXPECT_EQ(1u, wire.master.counters().unexpected) << telegram;
    wire.receives(kInputs);  // the slot is still open
    wire.cycleEnds();
    EXPECT_TRUE(wire.status().exchanged_this_cycle) << telegram;
  }
}

// An answer with access points has both of them turned round.
TEST(Exchange, IgnoresADiagnosisOfAnotherAccessPoint) {
  for (const char* telegram : {"68 0B 0B 68 81 88 08 3E 3D 02 05 00 FF 75 31 38 16",   // to 62, from 61
                               "68 0B 0B 68 81 88 08 3D 3C 02 05 00 FF 75 31 36 16"})  // to 61, from 60
  {
    NordWire wire;
    wire.isFound();
    wire.startCycle();
    wire.sends(kDiag6D);
    wire.receives(telegram);
    EXPECT_FALSE(wire.master.cycleDone()) << telegram;
    EXPECT_EQ(1u, wire.master.counters().unexpected) << telegram;
    wire.receives(kWantsPrm);
    wire.cycleEnds();
  }
}

// Set_Prm and Chk_Cfg are answered by SC (or by OK without data), never with data.
TEST(Exchange, TakesNoDataForAnAcknowledge) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.startCycle();
  wire.sends(kSetPrm5D);
  wire.receives("68 05 05 68 81 88 08 3E 3D 8C 16");
  EXPECT_EQ(1u, wire.master.counters().unexpected);
  wire.staysSilent();
  wire.sends(kSetPrm5D);
  wire.receives("10 01 08 00 09 16");
  wire.cycleEnds();
  EXPECT_EQ(SlavePhase::kConfiguration, wire.status().phase);
}

// FDL status and Slave_Diag cannot be answered by SC: anybody's stray E5 would bring a slave to life.
TEST(Exchange, AShortAcknowledgeFindsNoSlave) {
  NordWire wire;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.receives("E5");
  wire.staysSilent();
  wire.cycleEnds();
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  EXPECT_EQ(1u, wire.master.counters().unexpected);
}

// What comes after the slot has ended, or twice, answers nothing.
TEST(Exchange, IgnoresLateAndDoubledAnswers) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.staysSilent();
  wire.arrives(kInputs);
  EXPECT_EQ(1u, wire.master.counters().unexpected);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.sends(kExchange7D);  // the referee sees that the pause was kept after the late answer
  wire.receives(std::string{kInputs} + kInputs);
  EXPECT_EQ(2u, wire.master.counters().unexpected);
  EXPECT_EQ(1u, wire.status().counters.exchanges);
  wire.arrives(kInputs);  // between cycles
  EXPECT_EQ(3u, wire.master.counters().unexpected);
  wire.cycleEnds();
  wire.cycle(kExchange5D, kInputs);
}

// An answer in pieces, with the gaps an adapter makes, is one answer.
TEST(Exchange, TakesAnAnswerInPieces) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("68 0F 0F 68 01 08");
  wire.advance(4ms);
  wire.arrives("08 00 00 00 00 00 00 00");
  wire.advance(4ms);
  wire.arrives("00 0B 31 00 00 4D 16");
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

TEST(Exchange, FindsTheAnswerBehindNoise) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(std::string{"E7 A7 DA 00 "} + kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(4u, wire.master.counters().discarded_bytes);
}

// What is left of noise from before the request does not swallow its answer.
TEST(Exchange, ForgetsNoiseFromBeforeTheRequest) {
  NordWire wire;
  wire.startsUp();
  wire.arrives("68 F9 F9 68 01 08");
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(6u, wire.master.counters().discarded_bytes);
}

TEST(Exchange, RepeatsAfterAChecksumError) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 01 4D 16");
  EXPECT_EQ(1u, wire.master.counters().checksum_errors);
  wire.staysSilent();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

}  // namespace
}  // namespace nord_driver::profibus
