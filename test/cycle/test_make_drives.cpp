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
