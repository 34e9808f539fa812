#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr const char* kOperate = "68 07 07 68 FF 81 46 3A 3E 00 00 3E 16";

class TwoModules : public Wire {
 public:
  explicit TwoModules(const BusParameters& bus = quietBus()) : Wire(bus, {nordModule(8), nordModule(9)}) {
    master.setOutputs(0, standby());
    master.setOutputs(1, standby());
  }

  void asks(const char* request, const char* answer, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    sends(request, file, line);
    receives(answer);
  }

  void startUp() {
    startCycle();
    asks(kFdlStatus8, kHere8);
    cycleEnds();
    startCycle();
    asks(kDiag6D, kWantsPrm);
    asks(kFdlStatus9, kHere9);
    cycleEnds();
    startCycle();
    asks(kSetPrm5D, "E5");
    asks(kDiag9of6D, kWantsPrm9);
    cycleEnds();
    startCycle();
    asks(kChkCfg7D, "E5");
    asks(kSetPrm9, "E5");
    cycleEnds();
    startCycle();
    asks(kDiag5D, kReady);
    asks(kChkCfg9, "E5");
    cycleEnds();
    startCycle();
    asks(kExchange7D, kInputs);
    asks(kDiag9of5D, kReady9);
    cycleEnds();
    forgetEvents();
  }
};

// Exchanges come first, then a step for each slave in its start-up, then one look for a silent slave; never more than
// one request per slave, a diagnosis that was announced aside.
TEST(Cycle, ServesTwoSlavesInOrder) {
  TwoModules wire;
  wire.startUp();
  wire.startCycle();
  wire.asks(kExchange5D, kInputsDh);
  wire.asks(kExchange9of7D, kInputs9);
  wire.asks(kDiag7D, kReady);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status(0).exchanged_this_cycle);
  EXPECT_TRUE(wire.status(1).exchanged_this_cycle);
}

// A lost slave costs one slot every 250 ms, after the exchange of the others; the others lose nothing.
TEST(Cycle, ALostSlaveCostsLittle) {
  TwoModules wire;
  wire.startUp();
  wire.startCycle();
  wire.sends(kExchange5D);
  wire.staysSilent();
  wire.sends(kExchange5D);
  wire.staysSilent();
  wire.asks(kExchange9of7D, kInputs9);
  wire.cycleEnds();
  EXPECT_EQ(0u, wire.tells(DpEventKind::kSlaveLost).slave);
  EXPECT_FALSE(wire.status(0).exchanged_this_cycle);
  EXPECT_TRUE(wire.status(1).exchanged_this_cycle);

  int probes = 0;
  const Instant lost = wire.now;
  for (int i = 0; i < 100; ++i) {
    const Instant begin = wire.now;
    wire.startCycle();
    wire.asks(i % 2 == 0 ? kExchange9of5D : kExchange9of7D, kInputs9);
    EXPECT_TRUE(wire.status(1).exchanged_this_cycle);
    if (!wire.master.cycleDone()) {
      wire.sends(kFdlStatus8);
      wire.staysSilent();
      ++probes;
    }
    wire.cycleEnds();
    wire.now = std::max(wire.now, begin + 20ms);
  }
  const double intervals = toSeconds(wire.now - lost) / 0.25;
  EXPECT_LE(probes, intervals + 1);
  EXPECT_GE(probes, intervals - 2);
  EXPECT_EQ(1u, wire.status(0).counters.losses);
  EXPECT_EQ(0u, wire.status(1).counters.losses);

  // Back: found and started up beside the exchange of the other.
  wire.advance(250ms);
  wire.startCycle();
  wire.asks(kExchange9of5D, kInputs9);
  wire.asks(kFdlStatus8, kHere8);
  wire.cycleEnds();
  wire.startCycle();
  wire.asks(kExchange9of7D, kInputs9);
  wire.asks(kDiag6D, kWantsPrm);
  wire.cycleEnds();
}

// However many slaves are silent, and however long a slot is (a USB adapter needs 20 ms), they take a tenth of the
// time.
TEST(Cycle, SilentSlavesShareATenthOfTheTime) {
  BusParameters bus = quietBus();
  bus.slot_time = 20ms;
  TwoModules wire{bus};
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.staysSilent();
  wire.cycleEnds();
  wire.advance(179ms);
  wire.startCycle();
  wire.cycleEnds();
  wire.advance(1ms);
  wire.startCycle();
  wire.sends(kFdlStatus9);
}

// Two silent slaves take turns, one per cycle.
TEST(Cycle, OneProbePerCycle) {
  TwoModules wire;
  for (int i = 0; i < 3; ++i) {
    wire.startCycle();
    wire.sends(kFdlStatus8);
    wire.staysSilent();
    wire.cycleEnds();
    wire.advance(50ms);
    wire.startCycle();
    wire.sends(kFdlStatus9);
    wire.staysSilent();
    wire.cycleEnds();
    wire.advance(50ms);
    wire.startCycle();  // both intervals run
    wire.cycleEnds();
    wire.advance(250ms);
  }
}

// Global_Control Operate goes first of all, and again every second.
TEST(Cycle, RepeatsOperate) {
  BusParameters bus = quietBus();
  bus.operate_interval = 1s;
  TwoModules wire{bus};
  wire.startCycle();
  wire.sends(kOperate);
  wire.sends(kFdlStatus8);
  wire.staysSilent();
  wire.cycleEnds();
  wire.advance(500ms);
  wire.startCycle();
  wire.sends(kFdlStatus9);
  wire.staysSilent();
  wire.cycleEnds();
  wire.advance(500ms);
  wire.startCycle();
  wire.sends(kOperate);
  wire.sends(kFdlStatus8);
  wire.staysSilent();
  wire.restart();
  wire.startCycle();
  wire.sends(kOperate);
}

// A cycle that only broadcasts ends with the sending.
TEST(Cycle, ThatOnlyBroadcasts) {
  BusParameters bus = quietBus();
  bus.operate_interval = 100ms;
  NordWire wire{bus};
  wire.startCycle();
  wire.sends(kOperate);
  wire.sends(kFdlStatus8);
  wire.staysSilent();
  wire.advance(100ms);
  wire.startCycle();
  wire.sends(kOperate);
  wire.cycleEnds();
}

TEST(Cycle, IsNotBegunTwice) {
  NordWire wire;
  wire.startsUp();
  const auto cycles = wire.master.counters().cycles;
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.startCycle();
  wire.receives(kInputs);
  wire.cycleEnds();
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(cycles + 1, wire.master.counters().cycles);
}

TEST(Cycle, WithoutSlaves) {
  Wire wire{quietBus(), {}};
  wire.startCycle();
  wire.cycleEnds();
  EXPECT_EQ(0u, wire.master.slaveCount());
}

// "Exchanged" is a statement about the current cycle only.
TEST(Cycle, FreshnessEndsWithTheCycle) {
  NordWire wire;
  wire.startsUp();
  wire.cycle(kExchange7D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  wire.startCycle();
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
}

}  // namespace
}  // namespace nord_driver::profibus
