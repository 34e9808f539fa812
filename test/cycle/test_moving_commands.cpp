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
    Request request;
    request.kind = kind;
    request.drive = drive;
    request.id = ++last_id;
    request.patience = std::chrono::seconds{3};
    ports.submit(request);
    for (int i = 0; i < 400 && completions.count(request.id) == 0; ++i) {
      commandBase(base);
      commandLift(lift);
      step();
    }
    return completions[request.id];
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
  Request request;
  request.kind = RequestKind::kEnable;
  request.drive = kLift;
  request.id = ++last_id;
  request.patience = std::chrono::seconds{3};
  ports.submit(request);
  for (int i = 0; i < 20; ++i) {
    commandBase(0.2);
    step();
  }
  ASSERT_EQ(0u, completions.count(request.id)) << completions[request.id].message.c_str();
  transport.hold_answers = false;
  while (!transport.submitted.empty()) transport.answerFirst();
  for (int i = 0; i < 80; ++i) {
    commandBase(0.2);
    step();
  }
  ASSERT_EQ(1u, completions.count(request.id));
  EXPECT_TRUE(completions[request.id].success) << completions[request.id].message.c_str();
}

}  // namespace
}  // namespace nord_driver::cycle
