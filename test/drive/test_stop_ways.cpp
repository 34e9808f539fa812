// The choice of how a group of drives stops, for each case that has one: the words that go out.
#include <gtest/gtest.h>

#include "drive/drive_group.h"
#include "drive/fake_inverter.h"

namespace nord_driver::drive {
namespace {

/// Two enabled drives at half speed.
class Group {
 public:
  explicit Group(const StopWays& ways) : group_{{&drives_[0], &drives_[1]}, config(ways)} {
    cycles(4);
    EXPECT_TRUE(group_.requestEnable(now_).accepted());
    cycles(20);
    velocity_ = 78.5;
    fresh_ = true;
    cycles(20);
    EXPECT_GT(inverters_[0].frequency(), 0x1F00);
  }

  void cycle() {
    now_ += seconds(0.01);
    group_.commandIsFresh(fresh_, now_);
    if (!group_.commandAllowed() && velocity_ > 0.0) velocity_ = group_.wantsZeroRamp() ? velocity_ - 7.85 : 0.0;
    if (!fresh_ && group_.commandAllowed()) velocity_ = 0.0;
    group_.setpointIsZero(velocity_ <= 0.0);
    for (std::size_t i = 0; i < 2; ++i) {
      drives_[i].setVelocity(RadPerSec{velocity_});
      words_[i] = drives_[i].pollOutput(now_);
      drives_[i].handleInput(inverters_[i].exchange(words_[i]), true, now_);
    }
    group_.update(now_);
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  Word word(std::size_t drive) const { return words_[drive].control_word; }
  std::int16_t setpoint(std::size_t drive) const { return words_[drive].setpoints[0]; }

  static GroupConfig config(const StopWays& ways) {
    GroupConfig config;
    config.ways = ways;
    return config;
  }
  static DriveConfig driveConfig() {
    DriveConfig config;
    config.max_frequency[0] = Hertz{50.0};
    return config;
  }

  Drive drives_[2]{Drive{driveConfig()}, Drive{driveConfig()}};
  FakeInverter inverters_[2];
  DriveGroup group_;
  profile::ProcessOutput words_[2];
  Instant now_{std::chrono::hours{1}};
  double velocity_ = 0.0;
  bool fresh_ = false;
};

StopWays commandTimeout(StopWay way) {
  StopWays ways;
  ways.command_timeout = way;
  return ways;
}

TEST(CommandTooOld, HoldsSetpointZeroByDefault) {
  Group group{StopWays{}};
  group.fresh_ = false;
  group.cycles(30);
  EXPECT_EQ(0x047F, group.word(0));
  EXPECT_EQ(0, group.setpoint(0));
  EXPECT_EQ(GroupPhase::kEnabled, group.group_.report().phase);
  EXPECT_EQ(StopCause::kNone, group.group_.report().stop_cause);
}

TEST(CommandTooOld, MayRampDownAndThenDisable) {
  Group group{commandTimeout(StopWay::kOff1)};
  group.fresh_ = false;
  group.cycle();
  EXPECT_EQ(0x047F, group.word(0)) << "the ramp first";
  EXPECT_GT(group.setpoint(0), 0);
  group.cycles(40);
  EXPECT_EQ(0x047E, group.word(0));
  EXPECT_EQ(0x047E, group.word(1));
  EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  EXPECT_EQ(StopCause::kCommandTimeout, group.group_.report().stop_cause);
  EXPECT_EQ(0u, group.group_.report().stop_member);
  group.fresh_ = true;
  group.cycles(10);
  EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase) << "a new command enables nothing";
}

TEST(CommandTooOld, MayQuickStopOrCoastAtOnce) {
  Group quick{commandTimeout(StopWay::kQuickStop)};
  quick.fresh_ = false;
  quick.cycle();
  EXPECT_EQ(0x047B, quick.word(0));
  EXPECT_EQ(0x047B, quick.word(1));
  EXPECT_EQ(StopCause::kCommandTimeout, quick.group_.report().stop_cause);
  Group coast{commandTimeout(StopWay::kCoast)};
  coast.fresh_ = false;
  coast.cycle();
  EXPECT_EQ(0x047D, coast.word(0));
  EXPECT_EQ(0x047D, coast.word(1));
  coast.cycles(40);
  EXPECT_EQ(0x047E, coast.word(0));
  EXPECT_EQ(GroupPhase::kDisabled, coast.group_.report().phase);
}

// Between "enabled" and the first command there is none that could be too old.
TEST(CommandTooOld, CountsFromTheFirstCommandOn) {
  Group group{commandTimeout(StopWay::kQuickStop)};
  group.fresh_ = false;
  group.cycles(40);
  ASSERT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  ASSERT_TRUE(group.group_.requestEnable(group.now_).accepted());
  group.cycles(40);
  EXPECT_EQ(GroupPhase::kEnabled, group.group_.report().phase);
  EXPECT_EQ(0x047F, group.word(0));
}

TEST(Disable, MayQuickStopOrCoast) {
  StopWays ways;
  ways.disable = StopWay::kQuickStop;
  Group quick{ways};
  quick.group_.requestDisable(quick.now_);
  quick.cycle();
  EXPECT_EQ(0x047B, quick.word(0));
  EXPECT_EQ(0x047B, quick.word(1));
  EXPECT_EQ(StopCause::kNone, quick.group_.report().stop_cause) << "it was asked for";
  ways.disable = StopWay::kCoast;
  Group coast{ways};
  coast.group_.requestDisable(coast.now_);
  coast.cycle();
  EXPECT_EQ(0x047D, coast.word(0));
  EXPECT_EQ(0x047D, coast.word(1));
  EXPECT_EQ(StopCause::kNone, coast.group_.report().stop_cause) << "likewise";
}

/// The word of the way that disabling is to be.
constexpr Word wordOf(StopWay way) {
  return way == StopWay::kQuickStop ? 0x047B : 0x047D;
}

// Whoever asks for it does not want what is left of a ramp.
TEST(Disable, QuickStopsOrCoastsWhatIsRampedDownAlready) {
  for (const StopWay way : {StopWay::kQuickStop, StopWay::kCoast}) {
    StopWays ways = commandTimeout(StopWay::kOff1);
    ways.disable = way;
    Group group{ways};
    group.fresh_ = false;
    group.cycles(2);
    ASSERT_EQ(GroupPhase::kRampingDown, group.group_.report().phase);
    group.group_.requestDisable(group.now_);
    group.cycle();
    EXPECT_EQ(wordOf(way), group.word(0));
    EXPECT_EQ(wordOf(way), group.word(1));
    EXPECT_EQ(StopCause::kCommandTimeout, group.group_.report().stop_cause) << "the first cause stays";
    EXPECT_EQ(StopCause::kNone, group.drives_[0].report().stop_cause) << "it was asked for";
    group.cycles(40);
    EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  }
}

TEST(Disable, QuickStopsOrCoastsWhatHaltsForAnother) {
  for (const StopWay way : {StopWay::kQuickStop, StopWay::kCoast}) {
    StopWays ways;
    ways.disable = way;
    Group group{ways};
    group.inverters_[0].fault = true;
    group.cycles(2);
    ASSERT_EQ(GroupPhase::kHalting, group.group_.report().phase);
    group.group_.requestDisable(group.now_);
    group.cycle();
    EXPECT_EQ(wordOf(way), group.word(1));
    EXPECT_EQ(StopCause::kFault, group.group_.report().stop_cause);
    group.cycles(40);
    EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  }
}

// A drive has stopped, and the other one is on the ramp of OFF1.
TEST(Disable, QuickStopsOrCoastsWhatIsOnTheRampOfOff1) {
  for (const StopWay way : {StopWay::kQuickStop, StopWay::kCoast}) {
    StopWays ways;
    ways.drive_stopped = StopWay::kOff1;
    ways.disable = way;
    Group group{ways};
    group.inverters_[0].fault = true;
    group.cycles(2);
    ASSERT_EQ(GroupPhase::kStopping, group.group_.report().phase);
    ASSERT_EQ(0x047E, group.word(1));
    group.group_.requestDisable(group.now_);
    group.cycle();
    EXPECT_EQ(wordOf(way), group.word(1));
    group.cycles(40);
    EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  }
}

// A quick stop brakes: it is not taken away by a call that would let the machine roll.
TEST(Disable, DoesNotCoastWhatStopsQuicklyAlready) {
  StopWays ways;
  ways.drive_stopped = StopWay::kQuickStop;
  ways.disable = StopWay::kCoast;
  Group group{ways};
  group.inverters_[0].fault = true;
  group.cycles(2);
  ASSERT_EQ(0x047B, group.word(1));
  group.group_.requestDisable(group.now_);
  group.cycle();
  EXPECT_EQ(0x047B, group.word(1));
  group.cycles(40);
  EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
}

// Under local control an inverter follows no word: one that stands so is not waited for.
TEST(Disable, LeavesWhoStandsAlone) {
  for (const StopWay way : {StopWay::kQuickStop, StopWay::kCoast}) {
    StopWays ways;
    ways.disable = way;
    Group group{ways};
    group.inverters_[0].local = true;
    group.cycles(2);
    ASSERT_EQ(GroupPhase::kHalting, group.group_.report().phase);
    group.group_.requestDisable(group.now_);
    group.cycle();
    EXPECT_EQ(wordOf(way), group.word(1));
    group.cycles(40);
    EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
  }
}

// A ramp goes on as it is, and what halts gets OFF1.
TEST(Disable, ByARampLeavesTheWayDownWhatItIs) {
  StopWays ways = commandTimeout(StopWay::kOff1);
  Group ramps{ways};
  ramps.fresh_ = false;
  ramps.cycles(2);
  ramps.group_.requestDisable(ramps.now_);
  ramps.cycle();
  EXPECT_EQ(0x047F, ramps.word(0));
  EXPECT_EQ(GroupPhase::kRampingDown, ramps.group_.report().phase);
  Group halts{ways};
  halts.inverters_[0].fault = true;
  halts.cycles(2);
  halts.group_.requestDisable(halts.now_);
  halts.cycle();
  EXPECT_EQ(0x047E, halts.word(1));
}

struct Case {
  StopWay way;
  Word word;
};

class DriveStopped : public ::testing::TestWithParam<Case> {};

// The drive with the fault gets the idle word whatever the others do.
TEST_P(DriveStopped, BringsTheOthersToRestAsChosen) {
  StopWays ways;
  ways.drive_stopped = GetParam().way;
  Group group{ways};
  group.inverters_[1].fault = true;
  group.cycles(2);
  EXPECT_EQ(GetParam().word, group.word(0));
  EXPECT_EQ(0, group.setpoint(0));
  EXPECT_EQ(0x047E, group.word(1));
  EXPECT_EQ(StopCause::kFault, group.group_.report().stop_cause);
  for (int i = 0; i < 100; ++i) {
    group.cycle();
    ASSERT_EQ(0, group.setpoint(0));
    ASSERT_EQ(0x047E, group.word(1));
  }
  EXPECT_EQ(0x047E, group.word(0));
  EXPECT_EQ(GroupPhase::kDisabled, group.group_.report().phase);
}

INSTANTIATE_TEST_SUITE_P(EveryWay, DriveStopped,
                         ::testing::Values(Case{StopWay::kSetpointZero, 0x047F}, Case{StopWay::kOff1, 0x047E},
                                           Case{StopWay::kQuickStop, 0x047B}, Case{StopWay::kCoast, 0x047D}));

}  // namespace
}  // namespace nord_driver::drive
