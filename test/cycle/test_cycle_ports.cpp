// What crosses the border of the cycle's thread arrives once, in order, and never blocks the cycle.
#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "cycle/cycle_ports.h"

namespace nord_driver::cycle {
namespace {

Completion completion(std::uint32_t id) {
  Completion completion;
  completion.id = id;
  return completion;
}

TEST(CyclePorts, NothingWasCommandedAtFirst) {
  CyclePorts ports{1};
  EXPECT_FALSE(ports.newestBaseCommand().given);
  EXPECT_FALSE(ports.newestDriveCommand(0).given);
  EXPECT_FALSE(ports.pollRequest().has_value());
  EXPECT_EQ(1u, ports.readSnapshot().drives.size());
}

// What nobody has published yet says nothing that could be taken for news.
TEST(CyclePorts, AFreshSnapshotSaysNothing) {
  CyclePorts ports{1};
  const CycleSnapshot& snapshot = ports.readSnapshot();
  EXPECT_EQ(Instant{}, snapshot.time) << "no cycle has ended";
  EXPECT_FALSE(snapshot.connected || snapshot.settled);
  EXPECT_TRUE(snapshot.bus_text.empty());
  const BaseSnapshot& base = snapshot.base;
  EXPECT_FALSE(base.known || base.enabled || base.stopped);
  EXPECT_TRUE(base.text.empty() && base.waits.empty());
  EXPECT_EQ(robot::Twist2d{}, base.velocity);
  EXPECT_EQ(robot::Twist2d{}, base.command);
  const DriveSnapshot& drive = snapshot.drives[0];
  EXPECT_EQ(profile::DriveState::kUnknown, drive.state);
  EXPECT_FALSE(drive.online || drive.saturated || drive.position || drive.position_reached ||
               drive.position_following || drive.position_at_limit || drive.homed);
  EXPECT_EQ(0, drive.parameter_set);
  EXPECT_EQ(0.0, drive.velocity_command);
  EXPECT_EQ(0.0, drive.velocity);
  EXPECT_EQ(0.0, drive.frequency);
  EXPECT_EQ(0, drive.fault_number);
  EXPECT_FALSE(drive.module_answers || drive.enabled || drive.stopped || drive.at_speed || drive.not_following);
  EXPECT_EQ(0, drive.module_inputs);
  EXPECT_EQ(0.0, drive.speed_deviation);
  EXPECT_EQ(0.0, drive.joint_position);
  EXPECT_TRUE(drive.joint_known)
      << "what turns without end is counted from where it stands; a lift is told by the cycle";
  EXPECT_FALSE(drive.position_target || drive.position_held_back || drive.switch_on_reason);
  EXPECT_EQ(0, drive.last_fault_number);
  EXPECT_FALSE(drive.fault_latched || drive.fault || drive.owes_eeprom_switch || drive.direction_contradiction);
  EXPECT_EQ(0u, drive.faults);
  EXPECT_EQ(0u, drive.eeprom_writes);
  EXPECT_EQ(TerminalFinding::kNone, drive.terminals);
  EXPECT_TRUE(drive.text.empty() && drive.terminals_text.empty() && drive.position_refused.empty());
  EXPECT_FALSE(drive.device.complete);
}

TEST(CyclePorts, OnlyTheNewestCommandCounts) {
  CyclePorts ports{2};
  ports.commandBase({{0.1, 0.0}, Instant{}, true});
  ports.commandBase({{0.2, 0.0}, Instant{}, true});
  ports.commandDrive(1, {3.0, Instant{}, true});
  EXPECT_DOUBLE_EQ(0.2, ports.newestBaseCommand().twist.linear_x);
  EXPECT_DOUBLE_EQ(3.0, ports.newestDriveCommand(1).velocity);
  EXPECT_FALSE(ports.newestDriveCommand(0).given);
}

// The one before goes on growing old: what is no number is no command at all.
TEST(CyclePorts, WhatIsNoNumberIsNoCommand) {
  CyclePorts ports{1};
  ASSERT_TRUE(ports.commandBase({{0.2, 0.1, 0.3}, Instant{}, true}));
  ASSERT_TRUE(ports.commandDrive(0, {3.0, Instant{}, true}));
  const Instant later{std::chrono::seconds{1}};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    EXPECT_FALSE(ports.commandBase({{bad, 0.0, 0.0}, later, true}));
    EXPECT_FALSE(ports.commandBase({{0.0, bad, 0.0}, later, true}));
    EXPECT_FALSE(ports.commandBase({{0.0, 0.0, bad}, later, true}));
    EXPECT_FALSE(ports.commandDrive(0, {bad, later, true}));
  }
  EXPECT_EQ((robot::Twist2d{0.2, 0.1, 0.3}), ports.newestBaseCommand().twist);
  EXPECT_EQ(Instant{}, ports.newestBaseCommand().received);
  EXPECT_DOUBLE_EQ(3.0, ports.newestDriveCommand(0).velocity);
  EXPECT_EQ(Instant{}, ports.newestDriveCommand(0).received);
}

TEST(CyclePorts, RequestsComeInOrderAndAFullQueueSaysSo) {
  CyclePorts ports{1};
  Request request;
  for (request.id = 1; request.id <= 32; ++request.id) ASSERT_TRUE(ports.submit(request));
  EXPECT_FALSE(ports.submit(request));
  for (std::uint32_t id = 1; id <= 32; ++id) EXPECT_EQ(id, ports.pollRequest()->id);
  EXPECT_FALSE(ports.pollRequest().has_value());
}

TEST(CyclePorts, CompletionsComeInOrderAndNobodysAreDropped) {
  CyclePorts ports{1};
  ports.complete(completion(1));
  ports.complete(completion(0));  // nobody waits for it
  ports.complete(completion(2));
  ports.publish(CycleSnapshot{1});
  EXPECT_EQ(1u, ports.waitCompletion(Duration::zero())->id);
  EXPECT_EQ(2u, ports.waitCompletion(Duration::zero())->id);
  EXPECT_FALSE(ports.waitCompletion(Duration::zero()).has_value());
}

// Who has been told that the pose is zero, and looks, must not see the old one.
TEST(CyclePorts, AnAnswerComesNotBeforeTheSnapshotThatShowsItsEffect) {
  CyclePorts ports{1};
  ports.complete(completion(1));
  EXPECT_FALSE(ports.waitCompletion(Duration::zero()).has_value());
  CycleSnapshot snapshot{1};
  snapshot.settled = true;
  ports.publish(snapshot);
  ports.complete(completion(2));
  EXPECT_EQ(1u, ports.waitCompletion(Duration::zero())->id);
  EXPECT_TRUE(ports.readSnapshot().settled);
  EXPECT_FALSE(ports.waitCompletion(Duration::zero()).has_value());
}

// More completions than fit are lost; the rest still comes, and waiting afterwards ends in time.
TEST(CyclePorts, AFullRingOfCompletionsKeepsTheOldest) {
  CyclePorts ports{1};
  for (std::uint32_t id = 1; id <= 70; ++id) ports.complete(completion(id));
  ports.publish(CycleSnapshot{1});
  for (std::uint32_t id = 1; id <= 64; ++id) EXPECT_EQ(id, ports.waitCompletion(Duration::zero())->id);
  EXPECT_FALSE(ports.waitCompletion(std::chrono::milliseconds{1}).has_value());
}

TEST(CyclePorts, ACompletionWakesTheOneWhoWaits) {
  CyclePorts ports{1};
  std::thread cycle([&] {
    ports.complete(completion(7));
    ports.publish(CycleSnapshot{1});
  });
  const auto answer = ports.waitCompletion(std::chrono::seconds{10});
  cycle.join();
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(7u, answer->id);
}

// What is no number, or goes too far at once, is no command at all: the one before stays.
TEST(CyclePorts, RefusesWhatIsNoCommand) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CyclePorts ports{1};
  const Instant now{std::chrono::hours{1}};
  ASSERT_TRUE(ports.commandPosition(0, 1.5));
  EXPECT_FALSE(ports.commandPosition(0, kNan));
  EXPECT_EQ(1.5, ports.newestPosition(0).target);
  for (const double increment : {kNan, 1.000001e6, -1.000001e6}) EXPECT_FALSE(ports.commandIncrement(0, increment));
  EXPECT_EQ(0.0, ports.newestPosition(0).increments);
  EXPECT_TRUE(ports.commandIncrement(0, 1e6));
  EXPECT_TRUE(ports.commandIncrement(0, -1e6));
  EXPECT_EQ(2u, ports.newestPosition(0).increased);
  ASSERT_TRUE(ports.commandSetpoint(0, 1, 7.0, now));
  EXPECT_FALSE(ports.commandSetpoint(0, 1, kNan, now + std::chrono::seconds{1}));
  EXPECT_EQ(7.0, ports.newestWords(0).setpoints[1].value);
  EXPECT_EQ(now, ports.newestWords(0).setpoints[1].received);
}

// When it was last other than zero, and when an output was last off, is told with every command after it.
TEST(CyclePorts, RemembersWhenSomethingWasToMove) {
  CyclePorts ports{1};
  const Instant first{std::chrono::hours{1}}, second{std::chrono::hours{2}};
  ports.commandSetpoint(0, 0, 0.0, first);
  EXPECT_FALSE(ports.newestWords(0).setpoints[0].moved);
  ports.commandSetpoint(0, 0, 2.0, first);
  ports.commandSetpoint(0, 0, 0.0, second);
  EXPECT_EQ(first, ports.newestWords(0).setpoints[0].moved);
  EXPECT_EQ(second, ports.newestWords(0).setpoints[0].received);
  ports.commandOutput(0, 0, false, first);
  ports.commandOutput(0, 0, true, second);
  const BitCommand& output = ports.newestWords(0).outputs[0];
  EXPECT_TRUE(output.given && output.on);
  EXPECT_EQ(first, output.off);
  EXPECT_EQ(second, output.received);
}

// So does a velocity: whoever wants to enable the drive is told of it.
TEST(CyclePorts, RemembersWhenADriveWasToTurn) {
  CyclePorts ports{2};
  const Instant first{std::chrono::hours{1}}, second{std::chrono::hours{2}};
  ports.commandDrive(0, {0.0, first, true});
  EXPECT_FALSE(ports.newestDriveCommand(0).moved);
  ports.commandDrive(0, {1.0, first, true});
  ports.commandDrive(0, {0.0, second, true});
  EXPECT_EQ(first, ports.newestDriveCommand(0).moved);
  EXPECT_EQ(second, ports.newestDriveCommand(0).received);
  ports.commandDrive(1, {0.0, second, true});
  EXPECT_FALSE(ports.newestDriveCommand(1).moved) << "the other one's";
}

TEST(CyclePorts, TheSizesOfTheBaseAreThoseGivenLast) {
  CyclePorts ports{1};
  EXPECT_FALSE(ports.newestBaseTuning().given);
  ports.tuneBase({1.25, 1.0, 1.0, true});
  ports.tuneBase({1.5, 0.9, 1.1, true});
  EXPECT_TRUE(ports.newestBaseTuning().given);
  EXPECT_EQ(1.5, ports.newestBaseTuning().wheel_separation_multiplier);
  EXPECT_EQ(0.9, ports.newestBaseTuning().left_wheel_radius_multiplier);
  EXPECT_EQ(1.1, ports.newestBaseTuning().right_wheel_radius_multiplier);
}

// Somebody whose time has run out still takes what is there.
TEST(CyclePorts, NoTimeLeftIsALookAtWhatIsThere) {
  CyclePorts ports{1};
  ports.complete(completion(7));
  ports.publish(CycleSnapshot{1});
  const auto answer = ports.waitCompletion(-std::chrono::seconds{10});
  ASSERT_TRUE(answer);
  EXPECT_EQ(7u, answer->id);
  EXPECT_FALSE(ports.waitCompletion(-std::chrono::seconds{10}));
}

// As old as its time-out it still counts; without one for ever, and one that was never given never.
TEST(Commands, GrowOldBehindTheirTimeOut) {
  const Instant now{std::chrono::hours{1}};
  const Duration timeout = std::chrono::milliseconds{500};
  JointCommand command;
  command.received = now;
  EXPECT_TRUE(isStale(command, timeout, now));
  EXPECT_TRUE(isStale(command, Duration::zero(), now));
  command.given = true;
  EXPECT_FALSE(isStale(command, timeout, now + timeout));
  EXPECT_TRUE(isStale(command, timeout, now + timeout + Duration{1}));
  EXPECT_FALSE(isStale(command, Duration::zero(), now + std::chrono::hours{1}));
}

}  // namespace
}  // namespace nord_driver::cycle
