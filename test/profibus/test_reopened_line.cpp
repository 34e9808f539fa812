// The line is opened anew while a slave may be in data exchange with us still: the drive behind it hears the next word
// first, and is not parameterised anew, which would start its watchdog again and stop nothing (BU 2700 7.1.1).
#include <gtest/gtest.h>

#include <string>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

// The adapter was gone for a moment. The watchdog of 100 ms runs from the last request on.
TEST(ReopenedLine, ASlaveWhoseWatchdogRunsHearsTheNextWordFirst) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.restart();  // gone
  EXPECT_EQ(LossCause::kLinkRestarted, wire.tells(DpEventKind::kSlaveLost).cause);
  wire.advance(50ms);
  wire.restart();  // there again
  wire.tellsNothing();
  wire.isFound();
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.isGoneOnWith();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(1u, wire.status().counters.losses);
}

// Gone while the request was under way: the slave may have heard it.
TEST(ReopenedLine, TheRequestUnderWayMayHaveBeenHeard) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.advance(80ms);
  wire.startCycle();
  wire.sends(kExchange5D);
  wire.restart();
  wire.advance(60ms);
  wire.restart();
  wire.isFound();
  wire.isGoneOnWith();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// What is asked first of all may be heard, too, without an answer that comes to us.
TEST(ReopenedLine, TheFirstWordStartsTheWatchdogAnew) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.restart();
  wire.advance(50ms);
  wire.restart();
  wire.isFound();
  wire.startCycle();
  wire.sends(kExchange6D);
  const Instant sent = wire.now;
  wire.restart();
  wire.advance(60ms);
  wire.restart();
  wire.isFound();
  wire.startCycle();
  wire.sends(kExchange6D);
  wire.receives(kInputs);
  EXPECT_LT(wire.now - sent, 110ms);
  wire.sends(kDiag5D);
  wire.receives(kReady);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// Found again, and the first word is not answered, but may have been heard: its watchdog began anew. Where it cannot be
// gone on with any more, Set_Prm waits until that has run out.
TEST(ReopenedLine, AnUnansweredFirstWordPutsSetPrmOff) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.restart();
  wire.advance(30ms);
  wire.isFound();
  wire.startCycle();
  for (int i = 0; i < 2; ++i) {
    wire.sends(kExchange6D);
    wire.staysSilent();
  }
  wire.cycleEnds();
  const Instant heard = wire.now;
  wire.advance(50ms);
  wire.isFound();  // more than 100 ms after the exchange
  EXPECT_LT(wire.now - heard, 100ms);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  EXPECT_NE(std::string::npos, std::string{wire.status().note}.find("watchdog"));
  wire.advance(250ms);
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
}

// Switched off and on, or taken by another master meanwhile.
TEST(ReopenedLine, ASlaveThatLeftSaysSo) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.restart();
  wire.isFound();
  wire.forgetEvents();
  wire.cycle(kExchange6D, kNotActivated);
  wire.tellsNothing();
  wire.isFree();
  wire.takesParameters();
  EXPECT_EQ(1u, wire.status().counters.losses);
}

TEST(ReopenedLine, AfterTheWatchdogASlaveStartsAnew) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  wire.restart();
  wire.advance(120ms);
  wire.restart();
  wire.isFound();
  wire.isFree();
}

// A slave that never was in data exchange has no word to go on with.
TEST(ReopenedLine, InAStartUpThereIsNothingToGoOnWith) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.restart();
  wire.isFound();
  wire.isFree();
}

}  // namespace
}  // namespace nord_driver::profibus
