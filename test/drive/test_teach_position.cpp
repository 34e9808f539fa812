// A drive that positions is taught: disabled and at standstill only, and nothing of it is left in what enables it.
#include <gtest/gtest.h>

#include "drive/axis_at_rest.h"

namespace nord_driver::drive {
namespace {

class TeachPosition : public AxisAtRest {
 protected:
  void teach() { drive_.requestTeaching(now_, 7); }
  void expectRefused(Refusal refusal) {
    EXPECT_EQ(RequestState::kRefused, report().teaching.state);
    EXPECT_EQ(refusal, report().teaching.refusal) << toString(report().teaching.refusal);
    send();
    EXPECT_FALSE(sent_axis_.teach.teach_in || sent_axis_.teach.quit);
  }
};

TEST_F(TeachPosition, EndsWithItsBitsLowAndNeverEnables) {
  start();
  teach();
  EXPECT_EQ(Refusal::kBusy, drive_.enableRefusal()) << "with teach-in it would follow frequencies";
  int quits = 0;
  for (int i = 0; i < 100 && report().teaching.state == RequestState::kRunning; ++i) {
    cycle();
    EXPECT_EQ(0x047E, sent_);
    EXPECT_TRUE(sent_axis_.teach.teach_in || !sent_axis_.teach.quit);
    quits += sent_axis_.teach.quit ? 1 : 0;
  }
  EXPECT_EQ(RequestState::kDone, report().teaching.state);
  EXPECT_EQ(7u, report().teaching.token);
  EXPECT_GE(quits, 10) << "100 ms";
  send();
  EXPECT_FALSE(sent_axis_.teach.teach_in || sent_axis_.teach.quit);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(TeachPosition, IsRefused) {
  teach();
  expectRefused(Refusal::kOffline);
  cycle();
  teach();
  expectRefused(Refusal::kPositionUnknown);
  start();
  cycle(kReady, 400);
  teach();
  expectRefused(Refusal::kTeachTurning);
  cycle(0x0931);
  cycle(0x0131);
  teach();
  expectRefused(Refusal::kLocalControl);
  cycle();
  drive_.requestEnable(now_);
  teach();
  expectRefused(Refusal::kTeachNotDisabled);
  cycle();
  cycle(0x0B37);
  ASSERT_EQ(Phase::kEnabled, report().phase);
  teach();
  expectRefused(Refusal::kTeachNotDisabled);
  drive_.requestHoming(now_);
  teach();
  expectRefused(Refusal::kTeachNotDisabled);
  cycle(0x0B38);
  cycle(0x0B38);
  teach();
  expectRefused(Refusal::kFault);
  drive_.requestAcknowledge(now_);
  teach();
  expectRefused(Refusal::kBusy);
}

TEST_F(TeachPosition, IsRefusedWhileTheParameterSetIsSwitched) {
  start();
  drive_.requestParameterSet(2, now_);
  ASSERT_EQ(Phase::kSwitchingSet, report().phase);
  teach();
  expectRefused(Refusal::kBusy);
}

TEST_F(TeachPosition, IsEndedByWhateverComesBetween) {
  const auto halfWay = [this] {
    start();
    teach();
    for (int i = 0; i < 15; ++i) cycle();
    ASSERT_TRUE(sent_axis_.teach.quit);
  };
  halfWay();
  drive_.requestQuickStop(now_);
  expectRefused(Refusal::kTeachStopped);
  EXPECT_EQ(0x047B, sent_);
  for (int i = 0; i < 3; ++i) cycle(0x0B50);
  halfWay();
  cycle(0x0931);
  expectRefused(Refusal::kLocalControl);
  halfWay();
  cycle(kReady, 400);
  expectRefused(Refusal::kTeachTurning);
  halfWay();
  cycle(0x0B38);
  expectRefused(Refusal::kFault);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 60; ++i) cycle();
  halfWay();
  for (int i = 0; i < 10; ++i) {
    silence();
  }
  expectRefused(Refusal::kOffline);
}

// It answers too seldom for its answers to say anything.
TEST_F(TeachPosition, EndsWithItsTimeOut) {
  DriveConfig slow = config();
  slow.drive_timeout = seconds(10.0);
  drive_ = Drive{slow};
  setWords();
  start();
  teach();
  for (int i = 0; i < 199; ++i) {
    silence();
  }
  EXPECT_TRUE(sent_axis_.teach.teach_in);
  for (int i = 0; i < 2; ++i) send();
  expectRefused(Refusal::kTeachTimeout);
}

}  // namespace
}  // namespace nord_driver::drive
