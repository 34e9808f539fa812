// What the drives of a configuration are told, and what their transport is.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/make_drives.h"

namespace nord_driver::cycle {
namespace {

TEST(MakeDrives, TellsTheTransportTheTimesOfTheirStops) {
  CycleConfig config = CycleBench::config();
  config.shutdown_timeout = seconds(42.0);
  const CycleBench bench{config};
  EXPECT_EQ(seconds(42.0), bench.transport.told_shutdown_timeout);
  EXPECT_EQ(config.drives[0].drive.drive_timeout, bench.transport.told_drive_timeout);
}

/// What a drive may be silent for without being lost.
Duration driveTimeout(const CycleConfig& config, double worst_cycle) {
  ScriptedTransport transport{config.drives.size()};
  transport.worst_cycle = worst_cycle;
  EXPECT_EQ(config.drives.size(), makeDrives(config, transport, false).size());
  return transport.told_drive_timeout.value_or(Duration::zero());
}

// A cycle, and two with a station that does not answer; not shorter than configured, and as configured where it is.
TEST(MakeDrives, TwoCyclesWithASilentStationAreNoLoss) {
  CycleConfig config = CycleBench::config();
  for (DriveSetup& setup : config.drives) setup.drive.drive_timeout = seconds(0.05);
  EXPECT_EQ(seconds(0.05), driveTimeout(config, 0.02));
  EXPECT_EQ(seconds(0.09), driveTimeout(config, 0.04));
  config.cycle_rate = 50.0;
  EXPECT_EQ(seconds(0.1), driveTimeout(config, 0.04));
  config.drive_timeout_given = true;
  EXPECT_EQ(seconds(0.05), driveTimeout(config, 0.04));
  config.drives[2].drive.drive_timeout = seconds(0.03);
  EXPECT_EQ(seconds(0.03), driveTimeout(config, 0.04)) << "the shortest of all";
}

/// The first of two drives, of which `led` follows the other one.
drive::Drive firstOf(const ScriptedTransport& like, bool led = false) {
  CycleConfig config = CycleBench::config(50.0);
  config.drives.resize(2);
  for (DriveSetup& setup : config.drives) setup.drive.max_frequency.fill(Hertz{50.0});
  if (led) config.drives[0].leader = 1;
  ScriptedTransport transport{2};
  transport.parameter_sets = like.parameter_sets;
  transport.has_quick_stop = like.has_quick_stop;
  transport.forward_only = like.forward_only;
  return makeDrives(config, transport, false).front();
}

/// What it hears from now on is one status word; returns the control word it sends then.
Word exchange(drive::Drive& drive, Word status_word, Instant& now) {
  for (int i = 0; i < 3; ++i) {
    now += CycleBench::kCycle;
    drive.pollOutput(now);
    profile::ProcessInput input;
    input.status_word = status_word;
    drive.handleInput(input, true, now);
  }
  return drive.pollOutput(now).control_word;
}

constexpr Word kReady = 0x0B31, kSwitchedOn = 0x0B33, kRunning = 0x0B37;

// Its profile has no bits for parameter sets.
TEST(MakeDrives, TellHowManyParameterSetsCanBeCommanded) {
  ScriptedTransport transport{2};
  for (const bool one : {false, true}) {
    transport.parameter_sets = one ? 1 : 4;
    drive::Drive drive = firstOf(transport);
    Instant now{std::chrono::hours{1}};
    exchange(drive, kReady, now);
    drive.requestParameterSet(2, now);
    EXPECT_EQ(one ? drive::Refusal::kOnlySet1 : drive::Refusal::kNone, drive.report().set_switch.refusal);
  }
}

// Its profile has no OFF3: "ready to switch on" is where its stop ends, and nothing else would come.
TEST(MakeDrives, TellWhetherThereIsAQuickStop) {
  ScriptedTransport transport{2};
  for (const bool there_is : {true, false}) {
    transport.has_quick_stop = there_is;
    drive::Drive drive = firstOf(transport);
    Instant now{std::chrono::hours{1}};
    exchange(drive, kReady, now);
    drive.requestQuickStop(now);
    exchange(drive, kReady, now);
    EXPECT_EQ(there_is ? drive::Phase::kQuickStopping : drive::Phase::kIdle, drive.report().phase);
  }
}

// Its profile has "run forward" alone.
TEST(MakeDrives, TellWhetherTheyReverse) {
  ScriptedTransport transport{2};
  for (const bool reverses : {true, false}) {
    if (!reverses) transport.forward_only = {0};
    drive::Drive drive = firstOf(transport);
    Instant now{std::chrono::hours{1}};
    exchange(drive, kReady, now);
    drive.requestEnable(now);
    for (const Word word : {kReady, kSwitchedOn, kRunning}) exchange(drive, word, now);
    drive.setVelocity({-1.0});
    EXPECT_EQ(reverses, drive.pollOutput(now).setpoints[0] < 0);
  }
}

// Setpoint 0 of this bus would not bring it to rest: it hears its leader.
TEST(MakeDrives, TellThatADriveFollowsAnother) {
  for (const bool led : {false, true}) {
    drive::Drive drive = firstOf(ScriptedTransport{2}, led);
    Instant now{std::chrono::hours{1}};
    exchange(drive, kReady, now);
    drive.requestEnable(now);
    for (const Word word : {kReady, kSwitchedOn, kRunning}) exchange(drive, word, now);
    ASSERT_EQ(drive::Phase::kEnabled, drive.report().phase);
    drive.requestSetpointZero(now);
    EXPECT_EQ(led ? 0x047E : 0x047F, exchange(drive, kRunning, now));
  }
}

// Which drives share a bus module is known to whoever acknowledges one of them.
TEST(MakeDrives, TellWhichModuleTheyAreBehind) {
  ScriptedTransport transport{3};
  transport.shared_module = 1;
  CyclePorts ports{3};
  BusCycle cycle{CycleBench::config(), transport, ports, false};
  std::optional<Completion> answer;
  const auto run = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const Instant start = transport.time;
      cycle.runOnce();
      transport.sleepUntil(start + CycleBench::kCycle);
      if (const auto completion = ports.waitCompletion(Duration::zero())) answer = completion;
    }
  };
  run(10);
  transport.inverters[CycleBench::kRight].fault = transport.inverters[CycleBench::kLift].fault = true;
  run(5);
  Request request;
  request.id = 7;
  request.kind = RequestKind::kAcknowledge;
  request.drive = CycleBench::kLift;
  request.patience = std::chrono::seconds{3};
  ASSERT_TRUE(ports.submit(request));
  run(100);
  ASSERT_TRUE(answer);
  EXPECT_NE(std::string::npos, answer->message.str().find("drive right behind the same bus module"))
      << answer->message.str();
}

}  // namespace
}  // namespace nord_driver::cycle
