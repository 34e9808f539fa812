// What the bus says of a drive when the cycle begins, and when its parameters are asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "cycle/positioning_lift.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr DriveIndex kLift = CycleBench::kLift;

// A bus that has a code for it says so itself: the driver guesses nothing.
TEST(DriveChannel, ThatTellsAMissingRightIsBelievedInOtherReasons) {
  ScriptedTransport transport{3};
  transport.capabilities.tells_missing_right = true;
  CycleBench bench{CycleBench::config(), transport};
  bench.transport.inverters[kLift].local = true;
  bench.run(80);
  const Completion answer = bench.ask(test::writeRequest(kLift, 102, 1));
  EXPECT_THAT(answer.message.str(), HasSubstr("drive lift refuses P102"));
  EXPECT_THAT(answer.message.str(), Not(HasSubstr("P509")));
}

// P510 = 1: the setpoint would come from the terminals.
TEST(DriveChannel, WhoseTelegramsNameTheirSourceNeedsNoP510) {
  const auto enable = [](bool by_telegram) {
    ScriptedTransport transport{3};
    transport.sources_by_telegram = by_telegram;
    CycleBench bench{CycleBench::config(), transport};
    bench.transport.parameters[509] = 4;
    bench.transport.parameters[510] = 1;
    bench.run(80);
    return bench.ask(RequestKind::kEnable, kLift);
  };
  EXPECT_THAT(enable(false).message.str(), HasSubstr("P510"));
  const Completion answer = enable(true);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
}

// Asked before the first telegram, which takes its time: it waits for the drive to be read, as any other.
TEST(DriveChannel, EnablingMayBeAskedForBeforeTheFirstCycle) {
  CycleBench bench;
  bench.transport.exchange_time = std::chrono::seconds{1};
  const std::uint32_t enable = bench.submit(RequestKind::kEnable, kLift);
  bench.step();
  bench.transport.exchange_time = std::chrono::milliseconds{2};
  bench.run(150);
  ASSERT_EQ(1u, bench.completions.count(enable));
  EXPECT_TRUE(bench.completions[enable].success) << bench.completions[enable].message.c_str();
}

TEST(DriveChannel, IsNotUsedWhileTheDriveIsSilent) {
  CycleBench bench;
  bench.transport.hold_answers = true;
  bench.transport.inverters[kLift].silent = true;
  bench.run(30);
  EXPECT_FALSE(bench.transport.submitted.empty());
  for (const auto& asked : bench.transport.submitted) EXPECT_NE(kLift, asked.drive);
}

// A cycle lost with every answer would double the time until a drive may be enabled.
TEST(DriveChannel, AnAnswerIsFollowedByTheNextQuestionInTheSameCycle) {
  CycleBench bench;
  bench.transport.hold_answers = true;
  bench.run(3);
  for (int i = 0; i < 10; ++i) {
    const std::size_t waiting = bench.transport.submitted.size();
    ASSERT_GT(waiting, 0u);
    bench.transport.answerFirst();
    bench.step();
    EXPECT_EQ(waiting, bench.transport.submitted.size()) << i;
  }
}

// The low word would be read from a word the bus does not carry.
TEST(DriveChannel, ThatCarriesOneWordTellsNoPosition) {
  ScriptedTransport transport{1};
  transport.process_values = 1;
  PositioningLift lift{PositioningLift::config(), transport};
  lift.transport.parameters[545] = 0;
  lift.run(100);
  EXPECT_TRUE(lift.lift().online);
  EXPECT_FALSE(lift.lift().position);
  EXPECT_FALSE(lift.lift().joint_known);
}

// The words of a position of 32 bits of SK 700E, in the order that is configured.
TEST(DriveChannel, ThatSendsTheLowWordFirstTellsThePositionOfSk700e) {
  const auto positionAt = [](profile::FieldOrder order, std::int16_t last_word) {
    CycleConfig config = PositioningLift::config();
    config.drives[0].series = profile::Series::kSk700e;
    config.drives[0].position->order = order;
    PositioningLift lift{config};
    lift.transport.parameters = {{105, 500}, {543, 6}, {544, 1}, {545, 0}, {546, 3},
                                 {547, 1},   {548, 0}, {600, 1}, {610, 2}};
    lift.transport.inverters[0].third = last_word;
    lift.run(100);
    return lift.lift().position.value_or(-9.0);
  };
  EXPECT_NEAR(0.5, positionAt(profile::FieldOrder::kHighFirst, 500), 1e-9);
  EXPECT_NEAR(65.536, positionAt(profile::FieldOrder::kLowFirst, 1), 1e-9);
}

// An inverter that is switched off behind its module hears "no torque" with its first telegram, not words it ignores.
TEST(DriveChannel, AnInverterThatIsMissingIsSentNoTorque) {
  CycleBench bench;
  bench.run(80);
  bench.transport.missing[kLift] = true;
  bench.run(300);
  ASSERT_FALSE(bench.snapshot().drives[kLift].online);
  EXPECT_EQ(0x047E, bench.controlWord(kLift));
}

}  // namespace
}  // namespace nord_driver::cycle
