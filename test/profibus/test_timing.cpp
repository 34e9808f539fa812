#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr BaudRate kRate{19'200};

// T_ID1 = 37 bit times between the last character on the line and a request, no more than needed.
TEST(Timing, WaitsTid1AfterAnAnswer) {
  NordWire wire;
  wire.isFound();
  wire.startCycle();
  EXPECT_TRUE(wire.master.pollTransmit(wire.now).empty());
  const Instant last = wire.now;
  EXPECT_EQ(last + kRate.bits(37), *wire.master.nextDeadline());
  EXPECT_TRUE(wire.master.pollTransmit(last + kRate.bits(37) - Duration{1}).empty());
  EXPECT_FALSE(wire.master.pollTransmit(last + kRate.bits(37)).empty());
}

// The pause counts from the line's last activity, not from the end of the cycle: after it, a request goes at once.
TEST(Timing, SendsAtOnceOnAQuietLine) {
  NordWire wire;
  wire.isFound();
  wire.advance(1s);
  wire.startCycle();
  EXPECT_EQ(kDiag6D, toHex(wire.master.pollTransmit(wire.now)));
}

// A pty has no rate: the answer may be there before our telegram would be over on a wire. The pause counts from its end
// still.
TEST(Timing, WaitsTid1AfterItsOwnTelegram) {
  NordWire wire;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.arrives(kHere8);
  wire.startCycle();
  EXPECT_EQ(wire.sentEnd() + kRate.bits(37), *wire.master.nextDeadline());
}

// A line that was just opened is listened to for T_ID1 first.
TEST(Timing, WaitsTid1AfterTheLineWasOpened) {
  NordWire wire;
  wire.startCycle();
  EXPECT_EQ(wire.now + kRate.bits(37), *wire.master.nextDeadline());
}

// Every byte on the line starts the pause again, noise included.
TEST(Timing, StartsThePauseAgainWithEveryByte) {
  NordWire wire;
  wire.startCycle();
  wire.advanceBits(30);
  wire.arrives("FF");
  wire.advanceBits(30);
  wire.arrives("00");
  EXPECT_EQ(wire.now + kRate.bits(37), *wire.master.nextDeadline());
  wire.sends(kFdlStatus8);
}

// The slot (T_SL = 100 bit times) begins at the end of our own telegram: 6 characters of 11 bits later.
TEST(Timing, TheSlotBeginsAtTheEndOfTheRequest) {
  NordWire wire;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  EXPECT_EQ(wire.now + kRate.characters(6) + kRate.bits(100), *wire.master.nextDeadline());
  wire.master.handleTimeout(*wire.master.nextDeadline() - Duration{1});
  EXPECT_FALSE(wire.master.cycleDone());
  wire.master.handleTimeout(*wire.master.nextDeadline());
  EXPECT_TRUE(wire.master.cycleDone());
}

// An adapter slower than the bus: a slot time in seconds replaces T_SL.
TEST(Timing, TheSlotTimeCanBeGivenInSeconds) {
  BusParameters bus = quietBus();
  bus.slot_time = 30ms;
  NordWire wire{bus};
  wire.startCycle();
  wire.sends(kFdlStatus8);
  EXPECT_EQ(wire.sentEnd() + 30ms, *wire.master.nextDeadline());
}

// An answer is longer than the slot: its bytes prolong it. Without its end the slot ends T_SL after the last byte.
TEST(Timing, BytesProlongTheSlot) {
  NordWire wire;
  wire.startsUp();
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives("68 0F 0F 68 01 08 08 00 00 00");
  EXPECT_EQ(wire.now + kRate.bits(100), *wire.master.nextDeadline());
  wire.staysSilent();
  EXPECT_EQ(10u, wire.master.counters().discarded_bytes);
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
}

// ... but noise does not hold the slot open for ever.
TEST(Timing, NoiseDoesNotHoldTheSlotOpen) {
  NordWire wire;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  const Instant sent = wire.sentEnd();
  while (!wire.master.cycleDone() && wire.now < sent + 1s) {
    wire.advanceBits(50);
    wire.arrives("FF");
    if (!wire.master.cycleDone() && wire.now >= *wire.master.nextDeadline()) wire.master.handleTimeout(wire.now);
  }
  EXPECT_LE(wire.now, sent + kRate.characters(255) + kRate.bits(2 * 100 + 50));
}

// After a broadcast: T_ID2 = 60 bit times from its end, because nobody answers it.
TEST(Timing, WaitsTid2AfterABroadcast) {
  BusParameters bus = quietBus();
  bus.operate_interval = 1s;
  NordWire wire{bus};
  wire.startCycle();
  wire.sends("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16");
  EXPECT_EQ(wire.sentEnd() + kRate.bits(60), *wire.master.nextDeadline());
  wire.sends(kFdlStatus8);
  EXPECT_EQ(kRate.bits(60), wire.idleBefore());
}

// At 45.45 kbit/s T_SET is 95 bit times, T_ID1 therefore 225, and the slot 640.
TEST(Timing, OfThe45kRate) {
  BusParameters bus = BusParameters::forBaudRate(BaudRate{45'450}, station(1));
  bus.operate_interval = Duration::zero();
  NordWire wire{bus};
  const Instant begin = wire.now;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  EXPECT_EQ(BaudRate{45'450}.bits(225), wire.now - begin);
  EXPECT_EQ(wire.sentEnd() + BaudRate{45'450}.bits(640), *wire.master.nextDeadline());
}

// A line that never falls silent ends the cycle instead of the driver: nothing was sent, the slave is not fresh, and
// the next cycle tries again.
TEST(Timing, ABusyLineEndsTheCycle) {
  NordWire wire;
  wire.startsUp();
  const Instant begin = wire.now;
  for (int cycle = 0; cycle < 2; ++cycle) {
    wire.startCycle();
    wire.neverFallsSilent();
  }
  EXPECT_LT(wire.now, begin + 500ms);
  wire.tells(DpEventKind::kLineBusy);
  wire.tellsNothing();  // once
  EXPECT_EQ(2u, wire.master.counters().busy);
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  wire.cycle(kExchange7D, kInputs);
}

// How many retries: as many as configured.
TEST(Timing, RepeatsAsOftenAsConfigured) {
  BusParameters bus = quietBus();
  bus.max_retries = 3;
  NordWire wire{bus};
  wire.startsUp();
  wire.startCycle();
  for (int i = 0; i < 4; ++i) {
    wire.sends(kExchange7D);
    wire.staysSilent();
  }
  wire.cycleEnds();
  EXPECT_EQ(3u, wire.status().counters.retries);
  EXPECT_EQ(4u, wire.status().counters.timeouts);
}

}  // namespace
}  // namespace nord_driver::profibus
