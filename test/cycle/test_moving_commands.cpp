// Which commands stand against enabling which drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/command_watch.h"
#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MovingCommands : public ::testing::Test, protected CycleBench {
 protected:
  void SetUp() override { run(80); }
  Completion askUnder(RequestKind kind, DriveIndex drive, double base, double lift) {
    const std::uint32_t id = submit(kind, drive);
    for (int i = 0; i < 400 && completions.count(id) == 0; ++i) {
      commandBase(base);
      commandLift(lift);
      step();
    }
    return completions[id];
  }
};

// The base drives; the lift has no command.
TEST_F(MovingCommands, OneDriveIsNotRefusedForTheBase) {
  const Completion lift = askUnder(RequestKind::kEnable, kLift, 0.2, 0.0);
  EXPECT_TRUE(lift.success) << lift.message.c_str();
}

TEST_F(MovingCommands, OneDriveIsRefusedForItsOwn) {
  EXPECT_THAT(askUnder(RequestKind::kEnable, kLift, 0.2, 3.0).message.c_str(),
              HasSubstr("the newest command of drive lift is not zero"));
}

TEST_F(MovingCommands, AllAreRefusedForAny) {
  EXPECT_THAT(askUnder(RequestKind::kEnable, kAllDrives, 0.2, 0.0).message.c_str(),
              HasSubstr("the newest cmd_vel is not zero"));
  EXPECT_THAT(askUnder(RequestKind::kEnable, kAllDrives, 0.0, 3.0).message.c_str(),
              HasSubstr("the newest command of drive lift is not zero"));
}

// Waiting for the parameters, it looks at its own commands, too.
TEST_F(MovingCommands, WhatWaitsIsNotRefusedForTheBase) {
  transport.inverters[kLift].silent = true;
  run(20);
  transport.hold_answers = true;
  transport.inverters[kLift].silent = false;
  run(5);
  const std::uint32_t request = submit(RequestKind::kEnable, kLift);
  for (int i = 0; i < 20; ++i) {
    commandBase(0.2);
    step();
  }
  ASSERT_EQ(0u, completions.count(request)) << completions[request].message.c_str();
  transport.answerAll();
  for (int i = 0; i < 80; ++i) {
    commandBase(0.2);
    step();
  }
  ASSERT_EQ(1u, completions.count(request));
  EXPECT_TRUE(completions[request].success) << completions[request].message.c_str();
}

/// What stands against a base and a drive "lift" with the further setpoint "boost", by the commands that come.
class MovingCommandsTold : public ::testing::Test {
 protected:
  /// `timeout`: of each command; 0: they never grow old.
  std::string told(Duration timeout) {
    CommandWatch watch{ports_, timeout, true, {"lift"}, {false}};
    SetpointSetup boost;
    boost.name = "boost";
    boost.timeout = timeout;
    boost.moves = true;
    watch.watch(0, 0, boost);
    return watch.movingOf({0}, true, now_).str();
  }

  static constexpr Duration kTimeout = std::chrono::milliseconds{500};
  CyclePorts ports_{1};
  Instant now_{std::chrono::hours{1}};
};

TEST_F(MovingCommandsTold, SidewaysIsNamedWhereABaseGoesSideways) {
  ports_.commandBase({{0.0, 0.0, -0.25}, now_, true});
  EXPECT_EQ(
      "the newest cmd_vel is not zero (0.000 m/s, -0.250 m/s to the left, 0.000 rad/s, 0.00 s old): send zero first, "
      "or "
      "wait until it is older than cmd_vel_timeout",
      told(kTimeout));
  ports_.commandBase({{0.25, 0.5}, now_, true});
  EXPECT_EQ(
      "the newest cmd_vel is not zero (0.250 m/s, 0.500 rad/s, 0.00 s old): send zero first, or wait until it is older "
      "than cmd_vel_timeout",
      told(kTimeout));
}

// Nobody is to wait for what never comes.
TEST_F(MovingCommandsTold, ACommandThatNeverGrowsOldIsNotToBeWaitedFor) {
  const auto expectToldAs = [this](const char* what, const char* timeout) {
    const std::string way_out = std::string{", or wait until it is older than "} + timeout;
    EXPECT_THAT(told(kTimeout), AllOf(HasSubstr(what), HasSubstr("send zero first" + way_out)));
    EXPECT_THAT(told(Duration::zero()), AllOf(HasSubstr(what), HasSubstr("send zero first"), Not(HasSubstr("wait"))));
  };
  ports_.commandSetpoint(0, 0, 5.0, now_);
  expectToldAs("the newest setpoint boost of drive lift is not zero (5.000) and can turn its motor", "its timeout");
  ports_.commandDrive(0, {3.0, now_, true});
  expectToldAs("the newest command of drive lift is not zero (3.000 rad/s)", "cmd_vel_timeout");
  ports_.commandBase({{0.25, 0.0, 0.25}, now_, true});
  expectToldAs("the newest cmd_vel is not zero (0.250 m/s, 0.250 m/s to the left,", "cmd_vel_timeout");
}

}  // namespace
}  // namespace nord_driver::cycle
