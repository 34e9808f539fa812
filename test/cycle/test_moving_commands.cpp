// Which commands stand against enabling which drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace nord_driver::cycle
