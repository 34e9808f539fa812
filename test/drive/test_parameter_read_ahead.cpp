// What is read ahead of its turn while the read before it is under way, and what is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "drive/fake_parameters.h"
#include "drive/parameter_session.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterRequest;
using ::testing::ElementsAre;

ParameterRequest read(std::uint16_t number) {
  ParameterRequest request;
  request.number = number;
  return request;
}
ParameterRequest writeRam(std::uint16_t number, std::int32_t raw) {
  ParameterRequest request = read(number);
  request.action = ParameterAction::kWriteRam;
  request.raw = raw;
  return request;
}

class ReadAheadTest : public ::testing::Test {
 protected:
  FakeParameters inverter_;
  ParameterSession session_;
};

// The way to the inverter has the next question before the answer to this one.
TEST_F(ReadAheadTest, ReadsAheadByTheOtherLane) {
  inverter_.ram[103] = 250;
  const std::vector<std::uint16_t> numbers{102, 103, 105};
  for (const std::uint16_t number : numbers) ASSERT_TRUE(session_.submit(read(number)));
  unsigned lane = 0;
  auto running = session_.pollRequest(lane);
  for (const std::uint16_t number : numbers) {
    ASSERT_TRUE(running.has_value());
    EXPECT_EQ(number, running->number);
    EXPECT_FALSE(session_.pollRequest(lane).has_value());
    const auto ahead = session_.pollRequest(1 - lane);
    EXPECT_EQ(number != 105, ahead.has_value());
    EXPECT_FALSE(session_.pollRequest(1 - lane).has_value()) << "the lane is not free";
    session_.handleResult(inverter_.carryOut(*running), lane);
    const auto result = session_.pollResult();
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(inverter_.ram[number], result->raw);
    running = ahead;
    lane = 1 - lane;
  }
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P103?", "P105?"));
  EXPECT_FALSE(session_.pollRequest(0).has_value() || session_.pollRequest(1).has_value());
}

// A bus module answers past its inverter.
TEST_F(ReadAheadTest, KeepsTheOrderWhenTheReadAheadIsAnsweredFirst) {
  ASSERT_TRUE(session_.submit(read(102)));
  ASSERT_TRUE(session_.submit(read(105)));
  const auto first = session_.pollRequest(0), second = session_.pollRequest(1);
  ASSERT_TRUE(first && second);
  session_.handleResult(inverter_.carryOut(*second), 1);
  EXPECT_FALSE(session_.pollResult().has_value());
  session_.handleResult(inverter_.carryOut(*first), 0);
  EXPECT_EQ(inverter_.ram[102], session_.pollResult().value().raw);
  EXPECT_EQ(inverter_.ram[105], session_.pollResult().value().raw);
  EXPECT_FALSE(session_.pollResult().has_value());
}

TEST_F(ReadAheadTest, ReadsNothingAheadOfAWriteOrBehindOne) {
  inverter_.ram[103] = 250;
  ASSERT_TRUE(session_.submit(read(102)));
  ASSERT_TRUE(session_.submit(writeRam(103, 300)));
  ASSERT_TRUE(session_.submit(read(103)));
  const auto first = session_.pollRequest(0);
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(session_.pollRequest(1).has_value()) << "a write waits";
  session_.handleResult(inverter_.carryOut(*first), 0);
  for (int i = 0; i < 3; ++i) {
    const auto step = session_.pollRequest(0);
    ASSERT_TRUE(step.has_value());
    EXPECT_FALSE(session_.pollRequest(1).has_value()) << "a write is under way";
    session_.handleResult(inverter_.carryOut(*step), 0);
  }
  session_.handleResult(inverter_.carryOut(session_.pollRequest(0).value()), 0);
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P103?", "P103~300", "P103?", "P103?"));
}

TEST_F(ReadAheadTest, ALossEndsWhatWasReadAhead) {
  ASSERT_TRUE(session_.submit(read(102)));
  ASSERT_TRUE(session_.submit(read(105)));
  const auto first = session_.pollRequest(0), second = session_.pollRequest(1);
  ASSERT_TRUE(first && second);
  session_.handleOffline();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(ParameterOutcome::kOffline, session_.pollResult().value().outcome);
  session_.handleResult(inverter_.carryOut(*second), 1);
  session_.handleResult(inverter_.carryOut(*first), 0);
  EXPECT_FALSE(session_.pollResult().has_value());
  ASSERT_TRUE(session_.submit(read(105)));
  session_.handleResult(inverter_.carryOut(session_.pollRequest().value()));
  EXPECT_EQ(500, session_.pollResult().value().raw) << "and nothing hangs";
}

// All drives behind a module share that channel.
TEST_F(ReadAheadTest, LeavesTheChannelOfAModuleToItsTurn) {
  ASSERT_TRUE(session_.submit(read(102)));
  ASSERT_TRUE(session_.submit(read(151)));
  ASSERT_TRUE(session_.pollRequest(0).has_value());
  EXPECT_FALSE(session_.pollRequest(1).has_value());
}

// As many as there are lanes, in the order they were asked for.
TEST_F(ReadAheadTest, FillsEveryLane) {
  for (unsigned i = 0; i <= ParameterSession::kLanes; ++i) ASSERT_TRUE(session_.submit(read(i % 2 == 0 ? 102 : 105)));
  std::vector<ParameterRequest> out;
  for (unsigned lane = 0; lane < ParameterSession::kLanes; ++lane) {
    const auto request = session_.pollRequest(lane);
    ASSERT_TRUE(request.has_value()) << lane;
    out.push_back(*request);
  }
  // The last of them first: nothing is told before its turn.
  for (unsigned lane = ParameterSession::kLanes; lane-- > 0;) {
    EXPECT_FALSE(session_.pollResult().has_value());
    session_.handleResult(inverter_.carryOut(out[lane]), lane);
  }
  for (unsigned i = 0; i < ParameterSession::kLanes; ++i) {
    EXPECT_EQ(i % 2 == 0 ? 200 : 500, session_.pollResult().value().raw) << i;
  }
  EXPECT_TRUE(session_.pollRequest(0).has_value());
}

}  // namespace
}  // namespace nord_driver::drive
