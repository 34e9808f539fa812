// P560 is 1 again when the node has ended, whatever was being written.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "node/eeprom_switch_end.h"

namespace nord_driver::node {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class EepromSwitchEnd : public ::testing::Test {
 protected:
  EepromSwitchEnd() {
    for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.online = true;
  }
  std::vector<DriveIndex> settle() {
    return settleEepromSwitches({[this] { return writes_; },
                                 [this]() -> const cycle::CycleSnapshot& { return snapshot_; },
                                 [this](const cycle::Request& request) {
                                   asked_.push_back(request);
                                   on_access_(request.drive);
                                   return cycle::Completion{};
                                 },
                                 [this] { return now_; },
                                 [this](Duration time) {
                                   now_ += time;
                                   on_sleep_();
                                 }});
  }

  cycle::CycleSnapshot snapshot_{3};
  std::size_t writes_ = 0;
  const Instant begin_{seconds{100}};
  Instant now_ = begin_;
  std::vector<cycle::Request> asked_;
  std::function<void(DriveIndex)> on_access_ = [](DriveIndex) {};
  std::function<void()> on_sleep_ = [] {};
};

TEST_F(EepromSwitchEnd, TakesNoTimeWhereNothingWasWritten) {
  EXPECT_TRUE(settle().empty());
  EXPECT_EQ(begin_, now_);
  EXPECT_TRUE(asked_.empty());
}

// It has not even begun to switch P560 off; then it does, and puts it back itself.
TEST_F(EepromSwitchEnd, LetsAWriteComeToItsEnd) {
  writes_ = 1;
  on_sleep_ = [this] {
    snapshot_.drives[1].owes_eeprom_switch = now_ < begin_ + milliseconds{200};
    if (now_ >= begin_ + milliseconds{300}) writes_ = 0;
  };
  EXPECT_TRUE(settle().empty());
  EXPECT_GE(now_, begin_ + milliseconds{300});
  EXPECT_TRUE(asked_.empty());
}

TEST_F(EepromSwitchEnd, AsksEachDriveThatOwesItUntilItIsPutBack) {
  snapshot_.drives[0].owes_eeprom_switch = snapshot_.drives[2].owes_eeprom_switch = true;
  int accesses = 0;
  on_access_ = [&](DriveIndex drive) { snapshot_.drives[drive].owes_eeprom_switch = ++accesses % 2 != 0; };
  EXPECT_TRUE(settle().empty());
  ASSERT_EQ(4u, asked_.size()) << "each at the second try";
  EXPECT_EQ(0u, asked_[0].drive);
  EXPECT_EQ(2u, asked_[2].drive);
  for (const cycle::Request& request : asked_) {
    EXPECT_EQ(cycle::RequestKind::kReadParameter, request.kind);
    EXPECT_EQ(560, request.parameter.number);
    EXPECT_GT(request.patience, Duration::zero());
    EXPECT_LE(request.patience, kPutBackPatience);
  }
}

TEST_F(EepromSwitchEnd, NamesTheDrivesWhereItDoesNotSucceedAndEndsInTime) {
  writes_ = 1;
  snapshot_.drives[1].owes_eeprom_switch = true;
  on_access_ = [this](DriveIndex) { now_ += milliseconds{100}; };
  EXPECT_EQ(std::vector<DriveIndex>{1}, settle());
  EXPECT_LE(now_ - begin_, kWritesPatience + kPutBackPatience + milliseconds{200});
}

TEST_F(EepromSwitchEnd, DoesNotWaitForADriveThatIsSilent) {
  snapshot_.drives[2].owes_eeprom_switch = true;
  snapshot_.drives[2].online = false;
  EXPECT_EQ(std::vector<DriveIndex>{2}, settle());
  EXPECT_EQ(begin_, now_);
  EXPECT_TRUE(asked_.empty());
}

}  // namespace
}  // namespace nord_driver::node
