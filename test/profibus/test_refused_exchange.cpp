// A slave that answers every exchange and refuses it, or answers what is no answer, or reports a fault: its watchdog may
// be fed by the requests, while no stop word is taken. It is lost as a silent one is, and left alone until its watchdog
// has run out.
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

// A watchdog of 3 s (150 x 2 x 10 ms): the pause before the start-up is as long.
class LongWatchdog : public NordWire {
 public:
  LongWatchdog() : NordWire(quietBus(), module()) {
    isFound();
    isFree();
    cycle("68 0C 0C 68 88 81 5D 3D 3E 88 96 02 0B 75 31 00 B2 16", kShortAcknowledge);
    takesConfiguration();
    cycle(kDiag5D, kReady);
    forgetEvents();
  }
  /// One exchange, its repetition included.
  void answersOtherwise(const char* exchange, const char* answer) {
    startCycle();
    for (int i = 0; i < 2; ++i) {
      sends(exchange);
      receives(answer);
      staysSilent();
    }
    cycleEnds();
  }
  void isDiagnosed(const char* diagnosis) {
    startCycle();
    sends(kExchange7D);
    receives(kInputsDh);
    sends(kDiag5D);
    receives(diagnosis);
    cycleEnds();
  }
  void isLeftToItsWatchdog() {
    const Instant asked = now;
    EXPECT_EQ(SlavePhase::kBackOff, status().phase);
    while (now < asked + 3s) {
      startCycle();
      cycleEnds();
      advance(50ms);
    }
    advance(1s);
    isFree();
  }

 private:
  static SlaveConfig module() {
    SlaveConfig slave = nordModule(8);
    slave.watchdog = 3s;
    return slave;
  }
};

TEST(Refusals, ALongWatchdogIsWaitedFor) {
  LongWatchdog wire;
  refuses(wire, kExchange7D, kRr, kDiag5D);
  refuses(wire, kExchange7D, kRr, kDiag5D);  // without a limit, the second is the last
  wire.isLeftToItsWatchdog();
}

// Its PPO type was changed in operation (a telegram of another length, with its checksum), or E5 comes again and again:
// the stop words go out for as long as to a silent one.
TEST(OtherAnswers, ThatLastAreALossAndTheWatchdogIsWaitedFor) {
  for (const char* answer : {"68 07 07 68 01 08 08 0B 31 00 00 4D 16", "E5"}) {
    SCOPED_TRACE(answer);
    LongWatchdog wire;
    wire.master.setSilenceLimit(0, 90ms);
    wire.cycle(kExchange7D, kInputs);
    const Instant taken = wire.now;
    wire.answersOtherwise(kExchange5D, answer);
    for (int i = 0; wire.status().phase == SlavePhase::kDataExchange; ++i) {
      ASSERT_LT(i, 20) << "the exchange goes on for ever";
      wire.tellsNothing();
      wire.answersOtherwise(kExchange6D, answer);
    }
    EXPECT_GE(wire.now - taken, 90ms);
    EXPECT_LE(wire.now - taken, 160ms);
    EXPECT_EQ(LossCause::kWrongAnswers, wire.tells(DpEventKind::kSlaveLost).cause);
    EXPECT_NE(std::string::npos, std::string{wire.tells(DpEventKind::kConfigurationFault).text}.find("another length"));
    wire.isLeftToItsWatchdog();
  }
}

TEST(OtherAnswers, ThatPassAreNone) {
  LongWatchdog wire;
  wire.master.setSilenceLimit(0, 90ms);
  wire.cycle(kExchange7D, kInputs);
  wire.answersOtherwise(kExchange5D, "68 07 07 68 01 08 08 0B 31 00 00 4D 16");
  EXPECT_FALSE(wire.status().exchanged_this_cycle);
  EXPECT_NE(std::string::npos, std::string{wire.status().note}.find("another length"));
  wire.cycle(kExchange6D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_STREQ("", wire.status().note);
  wire.tellsNothing();
}

// Cfg_Fault, Prm_Fault, another ident number; owner 1, no Prm_Req: it exchanges data with us still.
TEST(FaultsInExchange, OfASlaveThatIsOursStillLeaveItToItsWatchdog) {
  for (const char* diagnosis :
       {"68 0B 0B 68 81 88 08 3E 3C 04 0C 00 01 75 31 42 16", "68 0B 0B 68 81 88 08 3E 3C 40 0C 00 01 75 31 7E 16",
        "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 0B A8 4B 16"}) {
    SCOPED_TRACE(diagnosis);
    LongWatchdog wire;
    wire.isDiagnosed(diagnosis);
    wire.tells(DpEventKind::kSlaveLost);
    wire.isLeftToItsWatchdog();
  }
}

// Cfg_Fault with Prm_Req, with no owner, or with both: it has left data exchange, and no watchdog runs.
TEST(FaultsInExchange, OfASlaveThatLeftNeedNoWatchdog) {
  for (const char* diagnosis :
       {"68 0B 0B 68 81 88 08 3E 3C 06 05 00 01 75 31 3D 16", "68 0B 0B 68 81 88 08 3E 3C 04 0C 00 FF 75 31 40 16",
        "68 0B 0B 68 81 88 08 3E 3C 06 05 00 FF 75 31 3B 16"}) {
    SCOPED_TRACE(diagnosis);
    LongWatchdog wire;
    wire.isDiagnosed(diagnosis);
    wire.tells(DpEventKind::kSlaveLost);
    wire.tells(DpEventKind::kConfigurationFault);
    wire.advance(250ms);
    wire.isFree();
  }
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
