// P105 is what 100 % of a setpoint means: written, it must never be a step of the speed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class P105Writes : public ::testing::Test, protected CycleBench {
 protected:
  static Request write(DriveIndex drive) {
    Request request;
    request.kind = RequestKind::kWriteParameter;
    request.drive = drive;
    request.parameter.number = 105;
    request.parameter.shape = profile::ParameterShape::kPerSet;
    request.parameter.parameter_set = 1;
    request.parameter.action = profile::ParameterAction::kWriteRam;
    request.parameter.raw = 1000;
    return request;
  }
};

// The device is read beside the write: an answer about the old P105 is no leave to enable before the write has ended.
TEST_F(P105Writes, NothingIsEnabledOnTheOldOneMeanwhile) {
  run(30);
  transport.inverters[kLift].silent = true;
  run(10);
  transport.inverters[kLift].silent = false;
  transport.hold_answers = true;
  while (transport.submitted.empty()) step();
  Request request = write(kLift);
  request.id = 4711;
  request.patience = std::chrono::seconds{3};
  ports.submit(request);
  while (transport.submitted.size() < 2) step();
  transport.submitted.pop_back();  // the write's first question stays without an answer
  transport.hold_answers = false;
  transport.answerFirst();
  run(30);
  ASSERT_EQ(0u, completions.count(4711));
  ASSERT_TRUE(snapshot().drives[kLift].device.complete);
  EXPECT_FALSE(ask(RequestKind::kEnable, kLift).success);
}

// Disabled is not at rest: under local control the terminals may turn it, and the bus may have it back at any time.
TEST_F(P105Writes, AreRefusedWhileTheMotorTurns) {
  run(30);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  commandLift(40.0);
  run(20);
  transport.inverters[kLift].local = true;
  run(5);
  ASSERT_EQ(0x047E, controlWord(kLift));
  ASSERT_EQ(profile::DriveState::kOperationEnabled, snapshot().drives[kLift].state);
  const Completion answer = ask(write(kLift));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P105 decides what setpoints and actual values mean"));
}

}  // namespace
}  // namespace nord_driver::cycle
