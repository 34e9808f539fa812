// What is told of a drive and of a group before anything was heard of them: nothing that somebody could take for news.
#include <gtest/gtest.h>

#include "drive/drive_group.h"

namespace nord_driver::drive {
namespace {

TEST(FreshReport, OfADriveSaysNothing) {
  const Drive drive{DriveConfig{}};
  const DriveReport& report = drive.report();
  EXPECT_EQ(Phase::kOffline, report.phase);
  EXPECT_EQ(profile::DriveState::kUnknown, report.state);
  EXPECT_FALSE(report.online || report.scaled || report.saturated || report.command_invalid ||
               report.direction_contradiction || report.fault_latched);
  EXPECT_EQ(0, report.status_word);
  EXPECT_EQ(0, report.parameter_set);
  EXPECT_EQ(0, report.commanded_set);
  EXPECT_EQ(0, report.speed);
  EXPECT_EQ(0.0, report.frequency.value);
  EXPECT_EQ(0.0, report.velocity.value);
  EXPECT_EQ(0.0, report.velocity_command.value);
  EXPECT_EQ(0.0, report.minimum_frequency.value);
  EXPECT_EQ(StopCause::kNone, report.stop_cause);
  EXPECT_EQ(0, report.stop_status_word);
  EXPECT_EQ(Refusal::kNone, report.refusal);
  EXPECT_FALSE(report.unexpected_function || report.unexpected_source || report.switch_on_reason);
  for (const RequestReport& request :
       {report.acknowledge, report.set_switch, report.homing, report.teaching, report.resetting}) {
    EXPECT_EQ(RequestState::kNone, request.state);
    EXPECT_EQ(Refusal::kNone, request.refusal);
    EXPECT_EQ(0u, request.token);
  }
}

TEST(FreshReport, OfAPositionSaysNothing) {
  DriveConfig config;
  config.position = PositionConfig{};
  const PositionReport report = Drive{config}.report().position;
  EXPECT_FALSE(report.position || report.target);
  EXPECT_FALSE(report.reached || report.following || report.at_limit || report.homed || report.homing || report.reset ||
               report.held_back || report.teach.teach_in || report.teach.quit);
  EXPECT_EQ(0, report.element);
  EXPECT_EQ(TargetRefusal::kNone, report.refused);
  EXPECT_EQ(0.0, report.refused_target);
}

TEST(FreshReport, OfAGroupSaysNothing) {
  Drive drive{DriveConfig{}};
  const DriveGroup group{{&drive}};
  EXPECT_EQ(GroupPhase::kDisabled, group.report().phase);
  EXPECT_EQ(StopCause::kNone, group.report().stop_cause);
  EXPECT_EQ(0u, group.report().stop_member);
  EXPECT_TRUE(group.report().refusal.accepted());
  EXPECT_EQ(0u, group.report().refusal.member);
  EXPECT_FALSE(group.commandAllowed() || group.wantsZeroRamp());
  EXPECT_TRUE(group.settled());
}

TEST(FreshReport, OfWhatAWordShouldBeNamesNoParameter) {
  const UnexpectedFunction function;
  EXPECT_EQ(0, function.number);
  EXPECT_EQ(0, function.found);
  EXPECT_EQ(0, function.expected);
  EXPECT_EQ(1, function.index) << "elements are counted from 1";
  EXPECT_FALSE(function.is_array);
  EXPECT_EQ(nullptr, function.wanted);
  const UnexpectedSource source;
  EXPECT_EQ(0, source.number);
  EXPECT_EQ(0, source.found);
  EXPECT_FALSE(source.is_array || source.should_follow || source.elsewhere);
}

// Who reads no configuration has the bounds of doc/parameters.md: 50 ms of silence, 10 s for OFF1.
TEST(FreshReport, ADriveThatIsToldNothingElseHasTheDocumentedBounds) {
  DriveConfig config;
  config.max_frequency[0] = Hertz{50.0};
  Drive drive{config};
  Instant now{};
  const auto cycle = [&](Word status, bool fresh = true) {
    const Word word = drive.pollOutput(now).control_word;
    now += seconds(0.01);
    profile::ProcessInput input;
    input.status_word = status;
    drive.handleInput(input, fresh, now);
    return word;
  };
  cycle(0x0B31);
  cycle(0x0B31);
  drive.requestEnable(now);
  const Instant asked = now;
  while (drive.report().phase == Phase::kEnabling) cycle(0x0B31);
  EXPECT_EQ(seconds(2.0), now - asked) << "enable_timeout";
  cycle(0x0B31);
  drive.requestEnable(now);
  cycle(0x0B31);
  cycle(0x0B37);
  ASSERT_EQ(Phase::kEnabled, drive.report().phase);
  drive.requestShutdown(now);
  const Instant stopped = now;
  while (drive.report().phase == Phase::kStopping) cycle(0x0B37);
  EXPECT_EQ(Phase::kQuickStopping, drive.report().phase);
  EXPECT_EQ(seconds(10.0), now - stopped) << "shutdown_timeout";
  cycle(0x0B50);
  const Instant heard = now;
  while (drive.report().online) cycle(0, false);
  EXPECT_EQ(seconds(0.06), now - heard) << "the first cycle after drive_timeout";
}

// The way down of a group: 1 s for standstill at setpoint 0, and 10 s for all of it.
TEST(FreshReport, AGroupThatIsToldNothingElseHasTheDocumentedBounds) {
  DriveConfig config;
  config.max_frequency[0] = Hertz{50.0};
  config.shutdown_timeout = seconds(60.0);  // the group's own bound comes first
  Drive drive{config};
  DriveGroup group{{&drive}};
  Instant now{};
  const auto cycle = [&](Word status, std::int16_t speed) {
    drive.pollOutput(now);
    now += seconds(0.01);
    profile::ProcessInput input;
    input.status_word = status;
    input.actual_values[0] = speed;
    drive.handleInput(input, true, now);
    group.update(now);
  };
  cycle(0x0B31, 0);
  cycle(0x0B31, 0);
  ASSERT_TRUE(group.requestEnable(now).accepted());
  cycle(0x0B31, 0);
  cycle(0x0B37, 0);
  ASSERT_TRUE(group.commandAllowed());
  group.requestDisable(now);
  const Instant asked = now;
  cycle(0x0B37, 165);
  group.setpointIsZero(true);
  cycle(0x0B37, 165);
  const Instant zero = now;
  while (group.report().phase == GroupPhase::kRampingDown) cycle(0x0B37, 165);
  EXPECT_EQ(seconds(1.0), now - zero) << "standstill_timeout, above near standstill by one";
  while (group.report().phase == GroupPhase::kStopping) cycle(0x0B37, 165);
  EXPECT_EQ(GroupPhase::kQuickStopping, group.report().phase);
  EXPECT_EQ(seconds(10.0), now - asked) << "shutdown_timeout";
}

}  // namespace
}  // namespace nord_driver::drive
