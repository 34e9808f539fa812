#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "system/what_stops_what.h"

namespace nord_driver::test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

namespace {

constexpr std::int16_t kHalfSetpoint = 0x2000;
constexpr Word kIdle = 0x047E, kRun = 0x047F, kOff3 = 0x047B;
constexpr int kBound = 2;          // bus cycles, of every row
constexpr int kShowLimit = 20;     // bus cycles until a simulated cause shows on the bus
constexpr double kRamp = 10431.0;  // of 16384 a second: 0.5 m/s2, where 100 % are 0.7854 m/s
constexpr double kSlow = 5.0;      // rad/s at the motor: OFF1 takes the torque no earlier

bool tellsToRun(const WireWords& words) {
  return words.sent && (words.control & 0x000F) == 0x000F;
}

}  // namespace

// --- what happens

void WhatStopsWhat::SetUp() {
  rig_ = std::get<StopBus>(GetParam()).make();
  ASSERT_TRUE(robot().bringUpAndEnable());
  robot().drive(kHalfSpeed, 0.0, seconds{3});
  robot().command(kHalfSpeed);
  last_command_ = now();
  rig_->step();
  ASSERT_EQ(kHalfSetpoint, rig_->wire(kLeft).setpoint) << words();
  ASSERT_EQ(-kHalfSetpoint, rig_->wire(kRight).setpoint) << words();
}

void WhatStopsWhat::submit(cycle::RequestKind kind) {
  cycle::Request request;
  request.kind = kind;
  request.patience = seconds{20};
  robot().ports().submit(request);
}

void WhatStopsWhat::standStill() {
  rig_->passWithoutTheDriver(rig_->driveSideTimeout() + robot().config().period());
}

void WhatStopsWhat::step() {
  if (no_numbers_) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
    for (const double value : {kNan, kInf, -kInf}) robot().command(value, 0.0);
    robot().command(0.0, kNan);
  } else if (row().commands_go_on) {
    robot().command(kHalfSpeed);
    last_command_ = now();
  }
  rig_->step();
}

Instant WhatStopsWhat::knownAt() {
  const cycle::CycleConfig& config = robot().config();
  const Duration drive_timeout = config.drives[kRight].drive.drive_timeout;
  switch (row().known) {
    case Known::kCommandAge:
      return last_command_ + config.cmd_vel_timeout;
    case Known::kRampTooLong:
      return begun_ + config.shutdown_timeout;
    case Known::kZeros:
      return zeros_since_ + drive_timeout;
    case Known::kSilence:
      return std::min(rig_->wire(kRight).status_at + rig_->silenceCounts() + drive_timeout, rig_->noticesSilenceAt());
    default:
      return begun_;
  }
}

void WhatStopsWhat::waitUntilItShows() {
  for (int i = 0; i < kShowLimit; ++i) {
    step();
    const auto status = rig_->wire(kRight).fresh_status;
    if (row().known == Known::kNodeState ? rig_->sawUnaskedState() : status && row().status_says(*status)) return;
  }
  FAIL() << "the cause does not show on the bus within " << kShowLimit << " cycles";
}

void WhatStopsWhat::waitUntilKnown() {
  if (row().known == Known::kAtOnce) return;
  if (row().known == Known::kOnTheWire || row().known == Known::kNodeState) return waitUntilItShows();
  if (row().known == Known::kZeros) {
    ASSERT_NO_FATAL_FAILURE(waitUntilItShows());
    zeros_since_ = rig_->wire(kRight).status_at;
  }
  const Instant give_up = now() + seconds{15};
  while (now() <= knownAt()) {
    step();
    ASSERT_LT(now(), give_up) << "the cause never becomes known";
    ASSERT_FALSE(reacted()) << "before its time, " << toSeconds(now() - begun_) << " s after the cause: " << words();
  }
}

// --- what is seen

std::string WhatStopsWhat::words() {
  std::string text;
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    const WireWords& words = rig_->wire(i);
    text += (i == kLeft ? "left " : ", right ") + toHexWord(words.control) + " " + std::to_string(words.setpoint) +
            (words.sent ? "" : " (nothing sent)");
  }
  return text + "; the base says \"" + robot().snapshot().base.text.str() + "\"";
}

bool WhatStopsWhat::reacted() {
  const WireWords &left = rig_->wire(kLeft), &right = rig_->wire(kRight);
  const auto is = [](const WireWords& words, Word control) {
    return words.sent && words.control == control && words.setpoint == 0;
  };
  switch (row().reaction) {
    case Reaction::kRamp:
      return left.control == kRun && right.control == kRun && left.setpoint < kHalfSetpoint &&
             right.setpoint > -kHalfSetpoint;
    case Reaction::kQuickStop:
      return is(left, kOff3) && is(right, kOff3);
    case Reaction::kOneStops:
      return is(left, kRun) && is(right, kIdle);
    case Reaction::kOneIsGone:
      return is(left, kRun) && !tellsToRun(right);
    case Reaction::kAllAreGone:
      return !tellsToRun(left) && !tellsToRun(right);
    case Reaction::kNoBus:
      return !left.sent && !right.sent;
  }
  return false;
}

bool WhatStopsWhat::standsStill() {
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    if (std::abs(rig_->unit(i).shaftSpeed()) >= 0.1) return false;
  }
  return true;
}

bool WhatStopsWhat::allOnline() {
  const auto& drives = robot().snapshot().drives;
  return std::all_of(drives.begin(), drives.end(), [](const auto& drive) { return drive.online; });
}

// Nothing speeds up, nobody is enabled again, and OFF1 takes no torque from a wheel that is on its ramp.
void WhatStopsWhat::expectOneCycleDown() {
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) before_[i] = rig_->wire(i);
  step();
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    const WireWords& words = rig_->wire(i);
    ASSERT_FALSE(tellsToRun(words) && !tellsToRun(before_[i])) << "enabled again: " << this->words();
    ASSERT_LE(std::abs(words.setpoint), std::abs(before_[i].setpoint)) << "speeds up: " << this->words();
    const bool ramps = row().reaction == Reaction::kRamp || (row().reaction == Reaction::kOneStops && i == kLeft);
    if (!ramps) continue;
    if (words.control != kRun && before_[i].control == kRun) {
      ASSERT_EQ(kIdle, words.control) << this->words();
      ASSERT_LE(std::abs(rig_->unit(i).shaftSpeed()), kSlow) << "OFF1 on the ramp: " << this->words();
    }
    if (row().reaction == Reaction::kRamp) {
      const double step =
          kRamp * toSeconds(robot().config().period()) + rig_->setpointStep();  // two setpoints are rounded
      ASSERT_LE(std::abs(before_[i].setpoint - words.setpoint), step) << this->words();
      ASSERT_EQ(rig_->wire(kLeft).setpoint, -rig_->wire(kRight).setpoint) << "the path bends: " << this->words();
    }
  }
}

void WhatStopsWhat::expectDown() {
  const Instant give_up = now() + seconds{30};  // who coasts, coasts long
  const bool stays_enabled = row().after == After::kEnabled;
  while (!standsStill() || !(stays_enabled || robot().snapshot().settled)) {
    ASSERT_NO_FATAL_FAILURE(expectOneCycleDown());
    ASSERT_LT(now(), give_up) << "it does not come to rest: " << words();
  }
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    if (!rig_->wire(i).sent) continue;
    EXPECT_EQ(0, rig_->wire(i).setpoint) << words();
    EXPECT_EQ(stays_enabled, tellsToRun(rig_->wire(i))) << words();
  }
}

// Nothing can be sent: watchdog or guarding switch the inverters off, and the wheels coast.
void WhatStopsWhat::expectDriveSideStop() {
  // The last word may have left a cycle before the cause.
  const Instant trip_by = begun_ + rig_->driveSideTimeout() + robot().config().period();
  while (now() < trip_by) {
    step();
    ASSERT_TRUE(reacted()) << words();
  }
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    if (row().after == After::kFaultLatched) {
      EXPECT_NE(0, rig_->unit(i).inverter().faultNumber()) << "drive " << i << " has no time-out of its own";
    } else {
      EXPECT_NE(sim::InverterState::kOperationEnabled, rig_->unit(i).inverter().state()) << "drive " << i;
    }
    EXPECT_EQ(0.0, rig_->unit(i).inverter().frequency()) << "drive " << i;
    EXPECT_GT(std::abs(rig_->unit(i).shaftSpeed()), kSlow) << "it coasts, drive " << i;
  }
}

void WhatStopsWhat::expectNothingMoves(Duration span) {
  for (const Instant end = now() + span; now() < end;) {
    step();
    ASSERT_FALSE(robot().snapshot().base.enabled);
    for (DriveIndex i = 0; i < StopRig::kDrives; ++i) ASSERT_FALSE(tellsToRun(rig_->wire(i))) << words();
  }
  ASSERT_TRUE(standsStill());
}

void WhatStopsWhat::expectMovesAgain() {
  const Instant end = now() + seconds{1};
  while (now() < end) {
    robot().command(kHalfSpeed);
    rig_->step();
  }
  EXPECT_GT(rig_->wire(kLeft).setpoint, kHalfSetpoint / 2) << words();
}

// Whoever commands commands in vain, while the cause stands and when it is gone.
void WhatStopsWhat::expectOnlyEnableMoves() {
  if (row().after == After::kEnabled) {
    EXPECT_TRUE(robot().snapshot().base.enabled) << words();
    return expectMovesAgain();
  }
  ASSERT_NO_FATAL_FAILURE(expectNothingMoves(seconds{1}));
  if (row().end_cause != nullptr) row().end_cause(*this);
  const Instant back_by = now() + seconds{3};
  while (!allOnline() && now() < back_by) step();
  ASSERT_TRUE(allOnline()) << "not back within 3 s";
  ASSERT_NO_FATAL_FAILURE(expectNothingMoves(seconds{2}));
  const char* const named = row().known == Known::kSilence ? StopRig::silenceIsNamed() : row().named;
  EXPECT_THAT(robot().snapshot().base.text.str(), HasSubstr(named));
  EXPECT_EQ(row().after != After::kDisabled && row().named[0] != '\0', robot().snapshot().base.stopped);

  ASSERT_TRUE(robot().bringUp()) << "its parameters are not read again";
  robot().run(milliseconds{600});  // the last command is too old by then
  cycle::Completion answer = robot().ask(cycle::RequestKind::kEnable);
  if (row().after == After::kEnded) {
    EXPECT_STREQ("the node is ending", answer.message.c_str());
    return;
  }
  if (row().after == After::kFaultLatched) {
    EXPECT_FALSE(answer.success) << "enabled over a fault that nobody has acknowledged";
    answer = robot().ask(cycle::RequestKind::kAcknowledge);
    EXPECT_TRUE(answer.success) << answer.message.c_str();
    answer = robot().ask(cycle::RequestKind::kEnable);
  }
  ASSERT_STREQ("enabled", answer.message.c_str());
  expectMovesAgain();
}

TEST_P(WhatStopsWhat, WithinItsBoundAndForGood) {
  begun_ = now();
  row().cause(*this);
  ASSERT_NO_FATAL_FAILURE(waitUntilKnown());
  if (row().reaction == Reaction::kNoBus) {
    ASSERT_NO_FATAL_FAILURE(expectDriveSideStop());
  } else {
    for (int i = 0; i < kBound; ++i) step();
    ASSERT_TRUE(reacted()) << kBound << " cycles after the cause: " << words();
  }
  ASSERT_NO_FATAL_FAILURE(expectDown());
  ASSERT_NO_FATAL_FAILURE(expectOnlyEnableMoves());
  EXPECT_EQ("no rule broken", rig_->referee());
}

}  // namespace nord_driver::test
