// Parameters of a bus module that several drives share, and who may write what decides motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/parameter_requests.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

constexpr int kRelay = 150, kModuleTimeout = 151;

Request write(DriveIndex drive, int number, std::int32_t raw = 1) {
  return test::writeRequest(drive, static_cast<std::uint16_t>(number), raw);
}

class ModuleParameters : public ::testing::Test, protected CycleBench {};

// The relay may be the brake of whichever drive turns, the first one, too.
TEST_F(ModuleParameters, TheRelayIsLeftAloneWhileTheFirstDriveIsEnabled) {
  run(80);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  ASSERT_TRUE(ask(RequestKind::kDisable, kLift).success);
  run(20);
  const Completion answer = ask(write(kLift, kRelay));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("disable drive left first"));
}

// A time-out of 5 ms, written for the drive that stands, and the others trip (E10.3).
TEST_F(ModuleParameters, AreLeftAloneWhileAnyDriveIsEnabled) {
  run(80);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  ASSERT_TRUE(ask(RequestKind::kDisable, kLift).success);
  run(20);
  for (const int number : {150, 151, 152, 153, 154, 160, 161, 162, 163, 164, 165, 166, 167, 168, 169}) {
    EXPECT_THAT(ask(write(kLift, number)).message.str(), HasSubstr("disable drive left first")) << number;
  }
  for (const int number : {149, 155, 159, 170}) EXPECT_FALSE(decidesMotion(write(kLift, number))) << number;
}

TEST_F(ModuleParameters, TheRelayIsWrittenWhileAllAreAtRest) {
  transport.parameters[kRelay] = 1;
  run(80);
  const Completion answer = ask(write(kLift, kRelay));
  EXPECT_TRUE(answer.success) << answer.message.c_str();
}

// Both were asked for in the same cycle: the write was looked at while all were at rest.
TEST_F(ModuleParameters, NoDriveIsEnabledInTheCycleTheRelayIsWrittenIn) {
  run(80);
  transport.hold_answers = true;
  submit(write(kLeft, kRelay));
  const std::uint32_t enable = submit(RequestKind::kEnable, kLift);
  for (int i = 0; i < 60; ++i) {
    step();
    ASSERT_EQ(0x047E, controlWord(kLift)) << i;
  }
  EXPECT_EQ(0u, completions.count(enable));
}

// Nobody has asked the drive: its answer is the driver's, in the fields as in the words.
TEST_F(ModuleParameters, AWriteThatIsRefusedHereIsToldApart) {
  run(80);
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  const Completion answer = ask(write(kLift, 105));
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(profile::ParameterOutcome::kRefused, answer.parameter.outcome);
  EXPECT_EQ(profile::ParameterReason::kDriver, answer.parameter.reason);
}

/// Behind a bus module whose own time-out counts.
class ModuleTimeout : public ::testing::Test, protected CycleBench {
 protected:
  ModuleTimeout() : CycleBench{CycleBench::config(), ofModule()} { transport.parameters[kModuleTimeout] = 50; }
  static ScriptedTransport ofModule() {
    ScriptedTransport transport{3};
    transport.timeout_owner = TimeoutOwner::kModule;
    return transport;
  }
  double timeoutOf(DriveIndex drive) { return snapshot().drives[drive].device.module_timeout.value_or(-9.0); }
  void SetUp() override {
    run(80);
    for (const DriveIndex i : {kLeft, kRight, kLift}) ASSERT_GT(timeoutOf(i), 0.0) << i;
  }
};

// What stops the wheels when this computer dies is that of all of them.
TEST_F(ModuleTimeout, WrittenByOneDriveItIsReadAgainByAll) {
  const double before = timeoutOf(kLeft);
  transport.parameters[kModuleTimeout] = 100;  // the scripted module stores nothing
  const Completion answer = ask(write(kRight, kModuleTimeout, 100));
  ASSERT_TRUE(answer.success) << answer.message.c_str();
  run(10);
  for (const DriveIndex i : {kLeft, kRight, kLift}) EXPECT_EQ(2.0 * before, timeoutOf(i)) << i;
}

// Read again, it costs every drive an access: only after a write.
TEST_F(ModuleTimeout, IsReadOnceWhereNobodyWritesIt) {
  transport.hold_answers = true;
  run(10);
  transport.submitted.clear();
  ask(write(kRight, 102));
  run(10);
  for (const auto& asked : transport.submitted) EXPECT_NE(kModuleTimeout, asked.request.number);
}

TEST(ModuleTimeoutOfAnInverter, IsNotAskedFor) {
  CycleBench bench;
  bench.transport.parameters[kModuleTimeout] = 50;
  bench.run(80);
  ASSERT_TRUE(bench.snapshot().drives[0].device.complete);
  EXPECT_FALSE(bench.snapshot().drives[0].device.module_timeout);
}

}  // namespace
}  // namespace nord_driver::cycle
