#include <gtest/gtest.h>

#include <cstring>

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

/// The slave is left alone for `pause`, then asked for its diagnosis with 6D.
void backsOff(NordWire& wire, Duration pause, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  testing::ScopedTrace trace(file, line, "backsOff");
  const Instant begin = wire.now;
  wire.startCycle();
  wire.cycleEnds();
  wire.now = begin + pause - 1ms;
  wire.startCycle();
  wire.cycleEnds();
  wire.now = begin + pause;
  wire.startCycle();
  EXPECT_FALSE(wire.master.cycleDone());
}

// Another ident number is another device: it gets no parameters. The pauses grow to 1.5 s, so that a start-up behind
// one is within 2 s, and the event comes once.
TEST(Faults, WrongIdentNumber) {
  NordWire wire;
  wire.isFound();
  wire.forgetEvents();
  const char* const kOther = "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16";
  wire.cycle(kDiag6D, kOther);
  const DpEvent event = wire.tells(DpEventKind::kWrongIdent);
  EXPECT_EQ(0x0BA8, event.ident);
  EXPECT_STRNE("", event.text);
  EXPECT_STREQ(event.text, wire.status().note);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  for (const Duration pause : {250ms, 500ms, 1000ms, 1500ms, 1500ms}) {
    backsOff(wire, pause);
    wire.sends(kDiag6D);
    EXPECT_STREQ(event.text, wire.status().note);
    wire.receives(kOther);
    wire.cycleEnds();
  }
  EXPECT_EQ(6u, wire.status().counters.refusals);
  wire.tellsNothing();
}

// Where any device will do, it gets the ident number it reports.
TEST(Faults, AnyIdentNumberWhenConfiguredSo) {
  SlaveConfig slave = nordModule(8);
  slave.expect_exact_ident = false;
  NordWire wire{quietBus(), slave};
  wire.isFound();
  wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");
  wire.cycle("68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 32 16", "E5");
}

TEST(Faults, RefusedParameters) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.forgetEvents();
  wire.cycle(kDiag5D, "68 0B 0B 68 81 88 08 3E 3C 42 05 00 FF 75 31 77 16");
  EXPECT_NE(nullptr, std::strstr(wire.tells(DpEventKind::kParameterFault).text, "Prm_Fault"));
  backsOff(wire, 250ms);
  wire.sends(kDiag6D);
  // The old fault stands in the first diagnosis still: that is no reason not to try again.
  wire.receives("68 0B 0B 68 81 88 08 3E 3C 42 05 00 FF 75 31 77 16");
  wire.cycleEnds();
  wire.takesParameters();
}

/// Behind Set_Prm, which it has acknowledged; the next diagnosis tells why.
void refusesChkCfg(NordWire& wire, const char* diagnosis) {
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.cycle(kChkCfg7D, kNotActivated);
  wire.forgetEvents();
  wire.cycle(kDiag5D, diagnosis);
}

// It acknowledges Set_Prm, waits for others, and answers Chk_Cfg with RS there. Not_Supported names SYNC and FREEZE.
TEST(Faults, RefusedParametersAreNamedWhereChkCfgIsRefused) {
  struct {
    const char* diagnosis;
    const char* word;
  } const kCases[] = {{"68 0B 0B 68 81 88 08 3E 3C 42 05 00 FF 75 31 77 16", "Prm_Fault"},
                      {"68 0B 0B 68 81 88 08 3E 3C 52 05 00 FF 75 31 87 16", "SYNC"}};
  for (const auto& example : kCases) {
    NordWire wire;
    refusesChkCfg(wire, example.diagnosis);
    EXPECT_NE(nullptr, std::strstr(wire.tells(DpEventKind::kParameterFault).text, example.word));
    EXPECT_NE(nullptr, std::strstr(wire.status().note, example.word));
    EXPECT_EQ(1u, wire.status().counters.refusals);
    backsOff(wire, 250ms);
  }
}

// No fault in its diagnosis: its watchdog ran out, or it was switched off and on, between Set_Prm and Chk_Cfg.
TEST(Faults, AChkCfgRefusedWithoutAFaultIsForgottenParameters) {
  NordWire wire;
  refusesChkCfg(wire, kWantsPrm);
  wire.tellsNothing();
  wire.advance(500ms);
  wire.cycle(kDiag7D, kWantsPrm);
  EXPECT_NE(nullptr, std::strstr(wire.tells(DpEventKind::kNotReady).text, "Prm_Req"));
  backsOff(wire, 250ms);
}

TEST(Faults, RefusedConfiguration) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.forgetEvents();
  wire.cycle(kDiag5D, "68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16");
  EXPECT_NE(nullptr, std::strstr(wire.tells(DpEventKind::kConfigurationFault).text, "Cfg_Fault"));
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  backsOff(wire, 250ms);
}

// The pause is short again after an exchange, and the same fault is told again.
TEST(Faults, AreForgottenAfterAnExchange) {
  NordWire wire;
  // The start-up after the first one asks what the configuration is (Get_Cfg), which turns the frame count.
  bool asked = false;
  const auto fault = [&] {
    wire.isFree();
    if (asked) {
      wire.cycle(kGetCfg5D, kHasPpo1);
      wire.cycle(kSetPrm7D, kShortAcknowledge);
      wire.cycle(kChkCfg5D, kShortAcknowledge);
      wire.cycle(kDiag7D, "68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16");
      return;
    }
    asked = true;
    wire.takesParameters();
    wire.takesConfiguration();
    wire.cycle(kDiag5D, "68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16");
  };
  wire.isFound();
  wire.tells(DpEventKind::kSlaveFound);
  fault();
  wire.tells(DpEventKind::kConfigurationFault);
  wire.advance(250ms);
  fault();
  wire.tellsNothing();
  wire.advance(500ms);
  wire.isFree();
  wire.cycle(kGetCfg5D, kHasPpo1);
  wire.cycle(kSetPrm7D, kShortAcknowledge);
  wire.cycle(kChkCfg5D, kShortAcknowledge);
  wire.cycle(kDiag7D, kReady);
  wire.tells(DpEventKind::kDataExchangeEntered);
  wire.cycle(kExchange5D, kInputs);
  wire.cycle(kExchange7D, kNotActivated);
  wire.tells(DpEventKind::kSlaveLost);
  asked = false;
  fault();
  wire.tells(DpEventKind::kConfigurationFault);
  backsOff(wire, 250ms);
}

// Another master owns the slave: it is left to it, and said so.
TEST(Faults, LockedByAnotherMaster) {
  NordWire wire;
  wire.isFound();
  wire.forgetEvents();
  wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 03 75 31 40 16");
  EXPECT_EQ(3, wire.tells(DpEventKind::kLockedByMaster).master);
  backsOff(wire, 250ms);
}

// A slave that still belongs to us (our process was restarted within its watchdog time) is parameterised anew.
TEST(Faults, OurOwnSlaveIsFree) {
  NordWire wire;
  wire.isFound();
  wire.cycle(kDiag6D, kReady);
  wire.takesParameters();
}

// A negative answer to a service of the start-up.
TEST(Faults, RefusedService) {
  NordWire wire;
  wire.isFound();
  wire.forgetEvents();
  wire.cycle(kDiag6D, kNotActivated);
  wire.tells(DpEventKind::kServiceRefused);
  backsOff(wire, 250ms);
  wire.sends(kDiag6D);
  wire.receives(kWantsPrm);
  wire.cycle(kSetPrm5D, kNotActivated);
  wire.tellsNothing();
  backsOff(wire, 500ms);
}

constexpr const char* kNotReady = "68 0B 0B 68 81 88 08 3E 3C 02 0C 00 01 75 31 40 16";
constexpr const char* kStatDiag = "68 0B 0B 68 81 88 08 3E 3C 00 0E 00 01 75 31 40 16";

/// Parameterised and configured; `set_prm` carries the factors of `watchdog`.
class AwaitReady : public NordWire {
 public:
  AwaitReady(Duration watchdog, const char* set_prm) : NordWire(quietBus(), module(watchdog)) {
    isFound();
    isFree();
    cycle(set_prm, kShortAcknowledge);
    takesConfiguration();
    forgetEvents();
  }
  /// One cycle of at least `period`; where it asks for the diagnosis, `answer()` is what comes.
  template <typename Answer>
  void cycleOf(Duration period, Answer&& answer) {
    const Instant start = now;
    startCycle();
    if (!master.cycleDone()) {
      sends(asked % 2 == 0 ? kDiag5D : kDiag7D);
      receives(answer());
      ++asked;
    }
    now = std::max(now, start + period);
  }

  int asked = 0;

 private:
  static SlaveConfig module(Duration watchdog) {
    SlaveConfig slave = nordModule(8);
    slave.watchdog = watchdog;
    return slave;
  }
};

// A slave that does not become ready gets its parameters anew after 5 s. Until then it is asked once per cycle for 1 s,
// then every 250 ms.
TEST(Faults, NeverReady) {
  AwaitReady wire{3s, "68 0C 0C 68 88 81 5D 3D 3E 88 96 02 0B 75 31 00 B2 16"};
  const Instant begin = wire.now;
  while (wire.status().phase == SlavePhase::kAwaitReady && wire.now < begin + 10s) {
    wire.cycleOf(50ms, [] { return kNotReady; });
  }
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_NEAR(5.0, toSeconds(wire.now - begin), 0.3);
  EXPECT_LT(wire.asked, 45);
  EXPECT_GT(wire.asked, 30);
  wire.tells(DpEventKind::kNotReady);
}

// A third of a watchdog of 100 ms is shorter than the cycle of 50 ms: asked in every one of them.
TEST(Faults, NeverReadyWithAShortWatchdog) {
  AwaitReady wire{100ms, kSetPrm5D};
  const Instant begin = wire.now;
  while (wire.status().phase == SlavePhase::kAwaitReady && wire.now < begin + 10s) {
    wire.cycleOf(50ms, [] { return kNotReady; });
  }
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  EXPECT_NEAR(5.0, toSeconds(wire.now - begin), 0.1);
  EXPECT_NEAR(100, wire.asked, 2);
  wire.tells(DpEventKind::kNotReady);
}

// It needs 2 s. Set_Prm has started its watchdog of 200 ms: where nobody asks it for as long, it wants its parameters
// again, and the inverter has tripped.
TEST(Faults, NoneOfASlaveThatTakesItsTimeToBecomeReady) {
  for (const char* waiting : {kNotReady, kStatDiag}) {
    SCOPED_TRACE(waiting);
    AwaitReady wire{200ms, "68 0C 0C 68 88 81 5D 3D 3E 88 14 01 0B 75 31 00 2F 16"};
    const Instant begin = wire.now;
    Instant heard = wire.now;
    bool ran_out = false;
    while (wire.status().phase == SlavePhase::kAwaitReady && wire.now < begin + 10s) {
      wire.cycleOf(20ms, [&] {
        ran_out = ran_out || wire.now - heard >= 200ms;
        heard = wire.now;
        return ran_out ? kWantsPrm : wire.now < begin + 2s ? waiting : kReady;
      });
    }
    EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
    EXPECT_LT(wire.asked, 80) << "rarely is not in every cycle";
    wire.tells(DpEventKind::kDataExchangeEntered);
    wire.tellsNothing();
  }
}

// Prm_Req that stays after Set_Prm: the slave lost its parameters; asked again soon, with a pause.
TEST(Faults, ForgetsItsParameters) {
  NordWire wire;
  wire.isFound();
  wire.isFree();
  wire.takesParameters();
  wire.takesConfiguration();
  wire.forgetEvents();
  wire.cycle(kDiag5D, kWantsPrm);
  wire.advance(600ms);
  wire.cycle(kDiag7D, kWantsPrm);
  wire.tells(DpEventKind::kNotReady);
  EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
}

// Another module at the address, or another master's, seen in data exchange: lost, and the reason is told.
TEST(Faults, InDataExchange) {
  struct {
    const char* diagnosis;
    DpEventKind kind;
  } const kCases[] = {{"68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 0B A8 4B 16", DpEventKind::kWrongIdent},
                      {"68 0B 0B 68 81 88 08 3E 3C 00 0C 00 03 75 31 40 16", DpEventKind::kLockedByMaster},
                      {"68 0B 0B 68 81 88 08 3E 3C 40 0C 00 01 75 31 7E 16", DpEventKind::kParameterFault},
                      {"68 0B 0B 68 81 88 08 3E 3C 04 0C 00 01 75 31 42 16", DpEventKind::kConfigurationFault}};
  for (const auto& example : kCases) {
    NordWire wire;
    wire.startsUp();
    wire.startCycle();
    wire.sends(kExchange7D);
    wire.receives(kInputsDh);
    wire.sends(kDiag5D);
    wire.receives(example.diagnosis);
    wire.cycleEnds();
    wire.tells(DpEventKind::kSlaveLost);
    wire.tells(example.kind);
    EXPECT_FALSE(wire.status().exchanged_this_cycle);
    EXPECT_EQ(SlavePhase::kBackOff, wire.status().phase);
  }
}

// A master at a slave's address answers FDL status with its station type: it is no slave.
TEST(Faults, AMasterAtASlavesAddress) {
  NordWire wire;
  wire.cycle(kFdlStatus8, "10 01 08 30 39 16");
  EXPECT_EQ(8, wire.tells(DpEventKind::kForeignMaster).master);
  EXPECT_EQ(SlavePhase::kSilent, wire.status().phase);
  wire.advance(250ms);
  wire.cycle(kFdlStatus8, "10 01 08 30 39 16");
  wire.tellsNothing();
}

// Our own request read back: the adapter echoes. It answers nothing, and the technician is told.
TEST(Faults, OwnEcho) {
  NordWire wire;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.arrives(kFdlStatus8);
  EXPECT_EQ(1, wire.tells(DpEventKind::kForeignMaster).master);
  wire.receives(kHere8);
  wire.cycleEnds();
  EXPECT_EQ(SlavePhase::kFirstDiagnosis, wire.status().phase);
}

}  // namespace
}  // namespace nord_driver::profibus
