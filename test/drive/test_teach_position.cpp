// A drive that positions is taught: disabled and at standstill only, and nothing of it is left in what enables it.
#include <gtest/gtest.h>

#include "drive/drive.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = seconds(0.01);
constexpr Word kReady = 0x0B31;

/// SK 53xE, as in test_position_drive.cpp: frequency, low word, high word.
class TeachPosition : public ::testing::Test {
 protected:
  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 1.0;
    result.max_frequency[0] = Hertz{50.0};
    result.position = PositionConfig{};
    return result;
  }
  TeachPosition() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  }
  void cycle(Word status_word = kReady, std::int16_t frequency = 0) {
    send();
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values = {frequency, 12'345, 0};
    drive_.handleInput(input, true, now_);
  }
  void send() {
    sent_ = drive_.pollOutput(now_).control_word;
    sent_bits_ = report().position.teach;
    now_ += kCycle;
  }
  void start() {
    for (int i = 0; i < 6; ++i) cycle();
    ASSERT_TRUE(report().position.position);
  }
  void teach() { drive_.requestTeaching(now_, 7); }
  void expectRefused(Refusal refusal) {
    EXPECT_EQ(RequestState::kRefused, report().teaching.state);
    EXPECT_EQ(refusal, report().teaching.refusal) << toString(report().teaching.refusal);
    send();
    EXPECT_FALSE(sent_bits_.teach_in || sent_bits_.quit);
  }
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  Word sent_ = 0;
  TeachBits sent_bits_;
  Instant now_{};
};

TEST_F(TeachPosition, EndsWithItsBitsLowAndNeverEnables) {
  start();
  teach();
  EXPECT_EQ(Refusal::kBusy, drive_.enableRefusal()) << "with teach-in it would follow frequencies";
  int quits = 0;
  for (int i = 0; i < 100 && report().teaching.state == RequestState::kRunning; ++i) {
    cycle();
    EXPECT_EQ(0x047E, sent_);
    EXPECT_TRUE(sent_bits_.teach_in || !sent_bits_.quit);
    quits += sent_bits_.quit ? 1 : 0;
  }
  EXPECT_EQ(RequestState::kDone, report().teaching.state);
  EXPECT_EQ(7u, report().teaching.token);
  EXPECT_GE(quits, 10) << "100 ms";
  send();
  EXPECT_FALSE(sent_bits_.teach_in || sent_bits_.quit);
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
}

TEST_F(TeachPosition, IsEndedByWhateverComesBetween) {
  const auto halfWay = [this] {
    start();
    teach();
    for (int i = 0; i < 15; ++i) cycle();
    ASSERT_TRUE(sent_bits_.quit);
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
    send();
    drive_.handleInput({}, false, now_);
  }
  expectRefused(Refusal::kOffline);
}

// It answers too seldom for its answers to say anything.
TEST_F(TeachPosition, EndsWithItsTimeOut) {
  DriveConfig slow = config();
  slow.drive_timeout = seconds(10.0);
  drive_ = Drive{slow};
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  start();
  teach();
  for (int i = 0; i < 199; ++i) {
    send();
    drive_.handleInput({}, false, now_);
  }
  EXPECT_TRUE(sent_bits_.teach_in);
  for (int i = 0; i < 2; ++i) send();
  expectRefused(Refusal::kTeachTimeout);
}

}  // namespace
}  // namespace nord_driver::drive
