// Drives that get under local control, or are turned by their terminals, while nobody here has enabled them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kLocal =
    "warning: drive left is under local control (status bit 9 = 0, status word 0931): its terminals may turn it "
    "whatever is sent";

class Terminals : public ::testing::Test, protected CycleBench {
 protected:
  void SetUp() override {
    run(100);
    ASSERT_THAT(events(), IsEmpty());
  }
};

TEST_F(Terminals, LocalControlWhileIdleIsToldWhenItBegins) {
  transport.inverters[kLeft].local = true;
  step();
  EXPECT_THAT(events(), ElementsAre(kLocal));
  run(500);
  EXPECT_THAT(events(), IsEmpty()) << "once";
  transport.inverters[kLeft].local = false;
  step();
  EXPECT_THAT(events(), ElementsAre("info: drive left: the bus has control of it again"));
}

// A loss tells what it has to tell by itself; what comes back under local control is told again.
TEST_F(Terminals, WhatIsFoundUnderLocalControlIsTold) {
  transport.inverters[kLeft].silent = true;
  run(20);
  transport.inverters[kLeft].local = true;
  EXPECT_THAT(events(), IsEmpty());
  transport.inverters[kLeft].silent = false;
  step();
  EXPECT_THAT(events(), ElementsAre(kLocal));
  EXPECT_EQ(TerminalFinding::kLocalControl, snapshot().drives[kLeft].terminals);
  EXPECT_EQ(kLocal, "warning: " + snapshot().drives[kLeft].terminals_text.str());
  EXPECT_EQ(TerminalFinding::kNone, snapshot().drives[kRight].terminals);
}

TEST_F(Terminals, ADriveThatIsEnabledPastTheDriverIsToldWhenItStartsTurning) {
  transport.inverters[kLeft].terminals = true;
  step();
  EXPECT_THAT(events(), ElementsAre("warning: drive left turns although nothing here has enabled it (status word 0B37, "
                                    "operation enabled, 3.1 Hz): by its terminals, or by bus I/O bits (P480)"));
  run(300);
  EXPECT_THAT(events(), IsEmpty());
}

// Under local control no word is carried out, a stop neither: it does not end what was found.
TEST_F(Terminals, AStopDoesNotGiveControlBack) {
  transport.inverters[kLeft].local = true;
  run(200);
  EXPECT_THAT(events(), ElementsAre(kLocal));
  Request stop;
  stop.kind = RequestKind::kQuickStop;
  stop.patience = std::chrono::seconds{1};
  ports.submit(stop);
  run(200);
  EXPECT_THAT(events(), IsEmpty());
  EXPECT_EQ(TerminalFinding::kLocalControl, snapshot().drives[kLeft].terminals);
  transport.inverters[kLeft].terminals = true;
  run(200);
  EXPECT_EQ(TerminalFinding::kTurned, snapshot().drives[kLeft].terminals);
}

TEST_F(Terminals, TurningUnderLocalControlIsToldBesidesIt) {
  transport.inverters[kLeft].local = true;
  run(10);
  transport.inverters[kLeft].terminals = true;
  step();
  EXPECT_THAT(events(), ElementsAre(kLocal,
                                    "warning: drive left turns although nothing here has enabled it (status word 0937, "
                                    "operation enabled, 3.1 Hz): by its terminals, or by bus I/O bits (P480)"));
}

// A loose contact must not fill the log.
TEST_F(Terminals, AFlickeringBitIsToldOnceASecondAtMost) {
  for (int i = 0; i < 300; ++i) {
    transport.inverters[kLeft].local = i % 2 == 0;
    step();
  }
  const std::size_t told = events().size();  // in 3 s
  EXPECT_GE(told, 3u);
  EXPECT_LE(told, 4u);
}

// An emergency stop that was pressed while nothing runs, or before this driver was started.
TEST_F(Terminals, ADriveThatItsTerminalsHoldWhileIdleIsTold) {
  constexpr const char* kHeld =
      "warning: drive left is held in \"switch-on disabled\" (status word 0B60, bit 4 = 0: OFF2 or safe stop (STO) at "
      "its "
      "terminals, or no mains)";
  transport.inverters[kLeft].taken = 0x0002;
  run(49);
  EXPECT_THAT(events(), IsEmpty());
  run(3);
  EXPECT_THAT(events(), ElementsAre(kHeld));
  EXPECT_EQ(TerminalFinding::kHeld, snapshot().drives[kLeft].terminals);
  EXPECT_EQ(kHeld, "warning: " + snapshot().drives[kLeft].terminals_text.str());
  EXPECT_EQ(TerminalFinding::kNone, snapshot().drives[kRight].terminals);
  run(500);
  EXPECT_THAT(events(), IsEmpty()) << "once";
  transport.inverters[kLeft].taken = 0;
  step();
  EXPECT_THAT(events(), ElementsAre("info: drive left is not held at its terminals any more"));
}

// Who tries to enable it in vain has not released it, nor has a fault.
TEST_F(Terminals, ADriveThatIsHeldIsSoUntilItIsReleased) {
  transport.inverters[kLeft].taken = 0x0004;
  run(60);
  ASSERT_EQ(1u, events().size());
  const auto answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(TerminalFinding::kHeld, snapshot().drives[kLeft].terminals);
  transport.inverters[kLeft].fault = true;
  run(30);
  EXPECT_EQ(TerminalFinding::kHeld, snapshot().drives[kLeft].terminals);
  for (const std::string& event : events()) EXPECT_THAT(event, Not(HasSubstr("held")));
  transport.inverters[kLeft].taken = 0;
  run(120);
  EXPECT_EQ(TerminalFinding::kNone, snapshot().drives[kLeft].terminals);
}

TEST_F(Terminals, AQuickStopAtTheTerminalsIsToldAsOne) {
  transport.inverters[kLeft].taken = 0x0004;
  run(60);
  EXPECT_THAT(events(),
              ElementsAre("warning: drive left is held in \"switch-on disabled\" (status word 0B50, bit 5 = 0: "
                          "OFF3 (quick stop, emergency stop) at its terminals)"));
}

// Without control no word is evaluated, and bits 4 and 5 say nothing of what would be with it.
TEST_F(Terminals, LocalControlIsToldInPlaceOfAHold) {
  transport.inverters[kLeft].taken = 0x0002;
  transport.inverters[kLeft].local = true;
  run(200);
  EXPECT_EQ(TerminalFinding::kLocalControl, snapshot().drives[kLeft].terminals);
  events();
  transport.inverters[kLeft].local = false;
  run(150);
  EXPECT_EQ(TerminalFinding::kHeld, snapshot().drives[kLeft].terminals);
}

// What the driver itself commands is not told: the way up, driving, and the ramp down.
TEST_F(Terminals, NothingIsToldOfMotionThatWasAskedFor) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  events();
  for (int i = 0; i < 50; ++i) {
    commandBase(1.0);
    commandLift(20.0);
    step();
  }
  ASSERT_TRUE(ask(RequestKind::kQuickStop).success);
  run(100);
  transport.inverters[kRight].silent = true;
  run(20);
  transport.inverters[kRight].silent = false;
  run(100);
  EXPECT_THAT(events(), IsEmpty());
}

TEST_F(Terminals, EnabledDrivesAreNamedInTheLog) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  EXPECT_THAT(events(), ElementsAre("info: the base is enabled", "info: drive lift is enabled"));
  ASSERT_TRUE(ask(RequestKind::kDisable).success);
  run(100);
  EXPECT_THAT(events(), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::cycle
