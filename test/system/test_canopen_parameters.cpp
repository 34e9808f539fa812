// Parameters by SDO beside the process data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr std::uint16_t kAccelerationTime = 102;

cycle::Request access(std::uint16_t number, std::int32_t raw, profile::ParameterAction action) {
  cycle::Request request;
  request.kind = action == profile::ParameterAction::kRead ? cycle::RequestKind::kReadParameter
                                                           : cycle::RequestKind::kWriteParameter;
  request.drive = 0;
  request.parameter.number = number;
  request.parameter.shape = profile::ParameterShape::kPerSet;
  request.parameter.action = action;
  request.parameter.raw = raw;
  return request;
}

// BU 0060 p. 61: P102 of set 1 = 1.03 s goes out as 2B 66 20 01 67 00 00 00.
TEST(CanopenParameterAccess, AWriteIsTheManualsFrame) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUp());
  std::vector<std::string> frames;
  robot.bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
    if (frame.id == 0x603) frames.push_back(toHex(frame.bytes()));
  });
  const auto answer = robot.ask(access(kAccelerationTime, 103, profile::ParameterAction::kWritePersistent));
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(103, answer.parameter.raw);
  EXPECT_THAT(frames, ::testing::Contains("2B 66 20 01 67 00 00 00"));
  EXPECT_EQ(103, robot.unit(0).parameters().value(kAccelerationTime, 0));
}

// SDO cannot spare the EEPROM: P560 is set to 0 for the write, and put back.
TEST(CanopenParameterAccess, ARamWriteGoesByP560) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const auto answer = robot.ask(access(kAccelerationTime, 150, profile::ParameterAction::kWriteRam));
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P560 was set to 0 for the write and put back to 1"));
  EXPECT_EQ(150, robot.unit(0).parameters().value(kAccelerationTime, 0));
  EXPECT_EQ(1, robot.unit(0).parameters().value(560, 0));
}

// The thread was held up between reading the socket and looking at the clock: what came meanwhile waits in the socket,
// and no time-out may be seen ahead of it.
TEST(CanopenParameterAccess, AnAnswerInTheSocketIsNoTimeOut) {
  CanRobot::Options options;
  options.drives = {{"sdo_timeout", 0.05}};
  options.node = {{"drive_timeout", 0.5}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.node(0).setAnswerDelay(milliseconds{40});
  cycle::Request request = access(kAccelerationTime, 0, profile::ParameterAction::kRead);
  request.id = 77;
  request.patience = std::chrono::seconds{3};
  ASSERT_TRUE(robot.ports().submit(request));
  robot.run(milliseconds{20});
  const std::uint64_t before = robot.transport().counters().value(bus_counter::kTimeouts);
  robot.link().holdUp(milliseconds{100});
  robot.run(milliseconds{500});
  ASSERT_FALSE(robot.completions().empty());
  const cycle::Completion& answer = robot.completions().back();
  EXPECT_EQ(77u, answer.id);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(before, robot.transport().counters().value(bus_counter::kTimeouts));
}

TEST(CanopenParameterAccess, AnAbortIsToldInWords) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const auto limits = robot.ask(access(kAccelerationTime, -5, profile::ParameterAction::kWritePersistent));
  EXPECT_FALSE(limits.success);
  EXPECT_THAT(limits.message.c_str(),
              HasSubstr("drive left refuses P102: SDO abort 0609 0032h, the value is below the lower limit"));
  const auto unknown = robot.ask(access(999, 0, profile::ParameterAction::kRead));
  EXPECT_FALSE(unknown.success);
  EXPECT_THAT(unknown.message.c_str(),
              HasSubstr("drive left refuses P999: SDO abort 0602 0000h, the inverter has no parameter of this number"));
}

// Answers that take a quarter of a second: the cycle goes on, and the answer comes when it comes.
TEST(CanopenParameterAccess, ASlowServerDelaysNoCycle) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.node(0).setAnswerDelay(milliseconds{250});
  cycle::Request request = access(kAccelerationTime, 0, profile::ParameterAction::kRead);
  request.id = 4711;
  request.patience = std::chrono::seconds{3};
  robot.ports().submit(request);
  Duration longest{};
  for (int i = 0; i < 40; ++i) {
    robot.command(0.2);
    const Instant start = robot.transport().now();
    robot.step();
    longest = std::max(longest, robot.exchangeTime());
    EXPECT_EQ(milliseconds{10}, robot.transport().now() - start);
  }
  EXPECT_LE(longest, milliseconds{3});
  EXPECT_TRUE(robot.snapshot().base.enabled);
  EXPECT_EQ(200, robot.ask(access(kAccelerationTime, 0, profile::ParameterAction::kRead)).parameter.raw);
}

// A server that never answers: a time-out in words, the drive stays.
TEST(CanopenParameterAccess, ASilentServerIsATimeOut) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.node(0).setAnswerDelay(std::chrono::seconds{30});
  const auto answer = robot.ask(access(kAccelerationTime, 0, profile::ParameterAction::kRead));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left gave no answer for P102"));
  EXPECT_TRUE(robot.online(0));
  EXPECT_TRUE(robot.snapshot().base.enabled);
}

}  // namespace
}  // namespace nord_driver::test
