// Acknowledging a fault.
#include <gtest/gtest.h>

#include <vector>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

// An edge with bit 7 held low and high for its time each, dropped when the fault bit falls (BU 2700 6.4.1 bit 7).
TEST_F(DriveTest, AcknowledgesWithOneEdge) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(0x047E, cycle(0x0B38)) << i;
  EXPECT_EQ(0x04FE, cycle(0x0B38));
  EXPECT_EQ(0x04FE, cycle(0x0B70));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_FALSE(report().fault_latched);
  EXPECT_EQ(RequestState::kDone, report().acknowledge.state);
  EXPECT_EQ(Refusal::kNone, report().refusal);
  drive_.requestEnable(now_);
  EXPECT_EQ(Refusal::kNone, report().refusal);
}

// While the cause stands the bit goes down again all the same, and the answer is no.
TEST_F(DriveTest, NeverLeavesTheAcknowledgeBitStanding) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  int high = 0;
  for (int i = 0; i < 30; ++i) high += (cycle(0x0B38) & 0x0080) != 0 ? 1 : 0;
  EXPECT_EQ(3, high);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(Refusal::kCauseStands, report().refusal);
  EXPECT_EQ(RequestState::kRefused, report().acknowledge.state);
  EXPECT_EQ(Refusal::kCauseStands, report().acknowledge.refusal);
  EXPECT_TRUE(report().fault_latched);
}

TEST_F(DriveTest, AcknowledgesAVanishedFaultWithoutABit) {
  start();
  cycle(0x0B38);
  cycle(0x0B31);
  drive_.requestAcknowledge(now_);
  EXPECT_FALSE(report().fault_latched);
  EXPECT_EQ(RequestState::kDone, report().acknowledge.state);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(0x047E, cycle(0x0B31)) << i;
}

// Asked for all drives of a base, a healthy one that still runs down must not answer "no" for the others.
TEST_F(DriveTest, HasNothingToAcknowledgeWithoutAFaultAndRunsOn) {
  run();
  drive_.requestAcknowledge(now_);
  EXPECT_EQ(RequestState::kDone, report().acknowledge.state);
  EXPECT_EQ(Phase::kEnabled, report().phase);
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
}

// However slow the cycle, the inverter sees the bit low, high, and low again: two answers to each.
TEST_F(DriveTest, GivesAnEdgeInCyclesLongerThanItsTimes) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  for (const int word : {0x047E, 0x047E, 0x04FE, 0x04FE, 0x047E, 0x047E}) {
    EXPECT_EQ(RequestState::kRunning, report().acknowledge.state);
    now_ += seconds(0.2);
    EXPECT_EQ(word, cycle(0x0B38));
  }
  EXPECT_EQ(Refusal::kCauseStands, report().acknowledge.refusal);
}

// A gateway that answers in every fourth cycle, longer than the time of a level: none comes and goes between two answers, and
// the fault that the edge took away is seen to be gone. The first answer may be of an exchange from before the level.
TEST_F(DriveTest, HoldsEachLevelUntilASlowBusHasCarriedIt) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  std::vector<Word> words;
  const auto answered = [&](Word status_word) {
    for (int i = 0; i < 3; ++i) words.push_back(silence());
    words.push_back(cycle(status_word));
  };
  for (int i = 0; i < 5; ++i) answered(0x0B38);
  EXPECT_EQ(RequestState::kRunning, report().acknowledge.state) << "what the edge did is not told yet";
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(i / 8 == 1 ? 0x04FE : 0x047E, words[i]) << i;
  answered(0x0B31);
  EXPECT_EQ(RequestState::kDone, report().acknowledge.state);
  EXPECT_FALSE(report().fault_latched);
}

// Once it was answered the bit does not wait for more answers to fall: cycles without one count as well.
TEST_F(DriveTest, DropsTheAcknowledgeBitWithoutAFurtherAnswer) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 5; ++i) cycle(0x0B38);
  EXPECT_EQ(0x04FE, silence());
  EXPECT_EQ(0x047E, silence());
}

// One that answers no more while the bit is high is lost, and the bit falls with it.
TEST_F(DriveTest, DropsTheAcknowledgeBitOfADriveThatFallsSilent) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 3; ++i) cycle(0x0B38);
  ASSERT_EQ(0x04FE, silence());
  fallSilent();
  EXPECT_EQ(0x047E, silence());
  EXPECT_EQ(Refusal::kOffline, report().acknowledge.refusal);
}

TEST_F(DriveTest, EndsTheAcknowledgingOfASilentDrive) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  EXPECT_EQ(RequestState::kRunning, report().acknowledge.state);
  fallSilent();
  EXPECT_EQ(RequestState::kRefused, report().acknowledge.state);
  EXPECT_EQ(Refusal::kOffline, report().acknowledge.refusal);
  EXPECT_EQ(StopCause::kNone, report().stop_cause) << "it was not driven";
  EXPECT_EQ(0x047E, silence());
  drive_.requestAcknowledge(now_);
  EXPECT_EQ(Refusal::kOffline, report().acknowledge.refusal);
}

// A stop comes first: the edge is given up, and asked for again by whoever wants it.
TEST_F(DriveTest, GivesUpTheAcknowledgingForAStop) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 4; ++i) cycle(0x0B38);
  drive_.requestQuickStop(now_);
  EXPECT_EQ(0x047B, cycle(0x0B38));
  EXPECT_EQ(Refusal::kRequestStopped, report().acknowledge.refusal);
}

}  // namespace
}  // namespace nord_driver::drive
