// What comes next after a stop: the drive that is missing before the one with a fault, and ~enable always last.
#include <gtest/gtest.h>

#include "node/recovery_hint.h"

namespace nord_driver::node {
namespace {

const std::vector<std::string> kNames{"left", "right"};

class RecoveryHint : public ::testing::Test {
 protected:
  RecoveryHint() {
    snapshot.connected = true;
    for (auto& drive : snapshot.drives) drive.online = true;
  }
  cycle::CycleSnapshot snapshot{2};
};

TEST_F(RecoveryHint, IsEnableWhenNothingStandsInTheWay) {
  EXPECT_EQ("~enable", recoveryHint(snapshot, kNames));
}

TEST_F(RecoveryHint, LeadsOverTheFaultThoughItsNumberIsNotReadOrItIsGoneInTheInverter) {
  snapshot.drives[1].fault_number = 21;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable",
            recoveryHint(snapshot, kNames));
  snapshot.drives[1].fault_number = 0;
  snapshot.drives[1].fault_latched = true;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable",
            recoveryHint(snapshot, kNames));
}

TEST_F(RecoveryHint, BeginsWithWhatIsMissing) {
  snapshot.drives[0].fault_latched = true;
  snapshot.drives[1].online = false;
  EXPECT_EQ("bring drive right back (see \"drive right\"), then ~enable", recoveryHint(snapshot, kNames));
  snapshot.connected = false;
  EXPECT_EQ("bring the bus back (see \"bus\"), then ~enable", recoveryHint(snapshot, kNames));
}

// Both refuse ~enable, or let it fail, as long as they stand.
TEST_F(RecoveryHint, LeadsOverLocalControl) {
  snapshot.drives[1].input.status_word = 0x0931;
  EXPECT_EQ("give the bus control of drive right again (status bit 9: remote control input, P509), then ~enable",
            recoveryHint(snapshot, kNames));
  snapshot.drives[1].fault_latched = true;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable",
            recoveryHint(snapshot, kNames));
}

TEST_F(RecoveryHint, LeadsOverAStopAtTheTerminals) {
  using drive::StopCause;
  const struct {
    Word word;
    StopCause cause;
    cycle::TerminalFinding finding;
    const char* expected;
  } cases[] = {
      {0x0B60, StopCause::kOff2, cycle::TerminalFinding::kNone, "OFF2"},
      {0x0B60, StopCause::kNone, cycle::TerminalFinding::kHeld, "OFF2"},
      {0x0B50, StopCause::kOff3, cycle::TerminalFinding::kNone, "OFF3"},
      {0x0B17, StopCause::kOff3, cycle::TerminalFinding::kNone, "OFF3"},
      {0x0B50, StopCause::kNone, cycle::TerminalFinding::kHeld, "OFF3"},
      {0x0B50, StopCause::kQuickStop, cycle::TerminalFinding::kNone, ""},  // our own, for a cycle or two
      {0x0B31, StopCause::kOff2, cycle::TerminalFinding::kNone, ""},       // released meanwhile
  };
  for (const auto& stop : cases) {
    SCOPED_TRACE(stop.word);
    snapshot.drives[0].input.status_word = stop.word;
    snapshot.drives[0].stop_cause = stop.cause;
    snapshot.drives[0].terminals = stop.finding;
    const std::string what = stop.expected;
    EXPECT_EQ(what.empty() ? "~enable" : "release " + what + " at the terminals of drive left, then ~enable",
              recoveryHint(snapshot, kNames));
  }
}

}  // namespace
}  // namespace nord_driver::node
