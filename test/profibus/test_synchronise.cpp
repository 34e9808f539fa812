#include <gtest/gtest.h>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

constexpr const char* kSync = "68 07 07 68 FF 81 46 3A 3E 20 01 5F 16";
constexpr const char* kUnsync = "68 07 07 68 FF 81 46 3A 3E 10 01 4F 16";

BusParameters syncBus() {
  BusParameters bus = quietBus();
  bus.sync_outputs = true;
  bus.sync_groups = 0x01;
  return bus;
}

SlaveConfig member() {
  SlaveConfig slave = nordModule(8);
  slave.group = 0x01;
  return slave;
}

class SyncWire : public NordWire {
 public:
  explicit SyncWire(const BusParameters& bus = syncBus(), const SlaveConfig& slave = member()) : NordWire(bus, slave) {}

  /// One cycle: what is exchanged first, Global_Control, and a step of the start-up.
  void step(const char* control, const char* request, const char* answer, const char* file = __builtin_FILE(),
            int line = __builtin_LINE()) {
    startCycle();
    sends(control, file, line);
    sends(request, file, line);
    receives(answer);
    cycleEnds(file, line);
  }
  void exchange(const char* request, const char* control, const char* file = __builtin_FILE(),
                int line = __builtin_LINE()) {
    startCycle();
    sends(request, file, line);
    receives(kInputs);
    sends(control, file, line);
    cycleEnds(file, line);
  }
  void startsUpInGroup() {
    step(kUnsync, kFdlStatus8, kHere8);
    step(kUnsync, kDiag6D, kWantsPrm);
    // Sync_Req and the group bits go with the parameters.
    step(kUnsync, "68 0C 0C 68 88 81 5D 3D 3E A8 0A 01 0B 75 31 01 46 16", kShortAcknowledge);
    step(kUnsync, kChkCfg7D, kShortAcknowledge);
    step(kUnsync, kDiag5D, kReady);
    forgetEvents();
  }
};

// Off means UNSYNC in every cycle; on means SYNC in every cycle, behind the exchanges (BU 2700 6.3: outputs wait for
// the next SYNC).
TEST(Synchronise, EveryCycleBehindTheExchanges) {
  SyncWire wire;
  wire.startsUpInGroup();
  wire.exchange(kExchange7D, kUnsync);
  EXPECT_FALSE(wire.master.isSynchronised());
  EXPECT_TRUE(wire.master.setSynchronised(true));
  wire.exchange(kExchange5D, kSync);
  wire.exchange(kExchange7D, kSync);
  EXPECT_TRUE(wire.master.setSynchronised(false));
  wire.exchange(kExchange5D, kUnsync);
  wire.exchange(kExchange7D, kUnsync);
}

// A slave of the group that misses its exchange ends it in the same cycle: stop words must reach the others at once.
TEST(Synchronise, EndsWithALoss) {
  SyncWire wire;
  wire.startsUpInGroup();
  wire.exchange(kExchange7D, kUnsync);
  ASSERT_TRUE(wire.master.setSynchronised(true));
  wire.startCycle();
  wire.sends(kExchange5D);
  wire.staysSilent();
  wire.sends(kExchange5D);
  wire.staysSilent();
  wire.sends(kUnsync);
  EXPECT_FALSE(wire.master.isSynchronised());
  wire.tells(DpEventKind::kSlaveLost);
  wire.tells(DpEventKind::kSyncReleased);
  EXPECT_FALSE(wire.master.setSynchronised(true)) << "the group is not complete";
}

TEST(Synchronise, NotWithAnIncompleteGroup) {
  SyncWire wire;
  EXPECT_FALSE(wire.master.setSynchronised(true));
}

// Off by default: nothing of it is ever sent, and it cannot be switched on.
TEST(Synchronise, IsOffByDefault) {
  NordWire wire{quietBus(), member()};
  wire.isFound();
  wire.isFree();
  wire.cycle("68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 01 26 16", kShortAcknowledge);
  wire.takesConfiguration();
  wire.cycle(kDiag5D, kReady);
  wire.cycle(kExchange7D, kInputs);
  EXPECT_FALSE(wire.master.setSynchronised(true));
  EXPECT_FALSE(wire.master.isSynchronised());
  wire.cycle(kExchange5D, kInputs);
}

// FREEZE goes with SYNC, UNFREEZE with UNSYNC. A slave of another group is not told Sync_Req, and does not end it.
TEST(Synchronise, FreezeAndGroups) {
  BusParameters bus = syncBus();
  bus.freeze_inputs = true;
  SlaveConfig other = nordModule(8);
  other.group = 0x02;
  SyncWire wire{bus, other};
  constexpr const char* kUnboth = "68 07 07 68 FF 81 46 3A 3E 14 01 53 16";
  wire.step(kUnboth, kFdlStatus8, kHere8);
  wire.step(kUnboth, kDiag6D, kWantsPrm);
  wire.step(kUnboth, "68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 02 27 16", kShortAcknowledge);
  ASSERT_TRUE(wire.master.setSynchronised(true));
  wire.step("68 07 07 68 FF 81 46 3A 3E 28 01 67 16", kChkCfg7D, kShortAcknowledge);
}

// Inputs alone: UNFREEZE, and Freeze_Req without Sync_Req.
TEST(Synchronise, FreezeAlone) {
  BusParameters bus = syncBus();
  bus.sync_outputs = false;
  bus.freeze_inputs = true;
  SyncWire wire{bus};
  constexpr const char* kUnfreeze = "68 07 07 68 FF 81 46 3A 3E 04 01 43 16";
  wire.step(kUnfreeze, kFdlStatus8, kHere8);
  wire.step(kUnfreeze, kDiag6D, kWantsPrm);
  wire.step(kUnfreeze, "68 0C 0C 68 88 81 5D 3D 3E 98 0A 01 0B 75 31 01 36 16", kShortAcknowledge);
}

// What was sent before it is not known to have come: the members act on what they hear next.
TEST(Synchronise, EndsOnALineThatNeverFallsSilent) {
  SyncWire wire;
  wire.startsUpInGroup();
  wire.exchange(kExchange7D, kUnsync);
  ASSERT_TRUE(wire.master.setSynchronised(true));
  wire.startCycle();
  wire.neverFallsSilent();
  EXPECT_TRUE(wire.master.cycleDone());
  EXPECT_FALSE(wire.master.isSynchronised());
}

TEST(Synchronise, EndsWithANewLink) {
  SyncWire wire;
  wire.startsUpInGroup();
  wire.exchange(kExchange7D, kUnsync);
  ASSERT_TRUE(wire.master.setSynchronised(true));
  wire.restart();
  EXPECT_FALSE(wire.master.isSynchronised());
}

}  // namespace
}  // namespace nord_driver::profibus
