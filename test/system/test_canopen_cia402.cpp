// The profile CiA 402 over CANopen: NORD's words as those of the velocity mode, and what these have no place for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/position_setup.h"
#include "cycle/signal_setup.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

CanRobot::Options cia402() {
  CanRobot::Options options;
  options.drives = {{"profile", std::string{"cia402"}}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::CanDriveConfig>().cia402 = true;
  };
  return options;
}

// 6040h and 6042h in rpm: 25 Hz with two pole pairs are 750 rpm, EE 02.
TEST(CanopenCia402, VelocityMode) {
  CanRobot robot{cia402()};
  std::vector<std::string> frames;
  robot.bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
    if (frame.id == 0x203) frames.push_back(toHex(frame.bytes()));
  });
  EXPECT_EQ("CANopen node 3, CiA 402", robot.transport().identity(0).address);
  expectDrives(robot);
  EXPECT_EQ("7E 00 00 00", frames.front()) << "nothing is sent before there is something to say";
  EXPECT_THAT(frames, ::testing::Contains("7F 00 EE 02"));
}

// A driver that died left E10.0 in drives that still roll: the next one cannot tell their speed before it knows P105.
TEST(CanopenCia402, IsNotAcknowledgedAtStartWhileItRolls) {
  CanRobot::Options options = cia402();
  CanRobot died{options};
  ASSERT_TRUE(died.bringUpAndEnable());
  died.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  died.bus().run(milliseconds{400});
  ASSERT_EQ(100, died.unit(0).inverter().faultNumber());
  options.beside = &died.bus();
  options.node = {{"acknowledge_at_start", std::string{"bus_timeouts"}}};
  CanRobot next{options};
  ASSERT_TRUE(next.runUntil([&] { return next.online(0); }));
  ASSERT_GT(std::abs(died.unit(0).shaftSpeed()), 20.0) << "it must not have come to rest too early for this test";
  ASSERT_TRUE(next.snapshot().drives[0].fault_latched);
  ASSERT_TRUE(next.runUntil([&] { return !next.snapshot().drives[0].fault_latched; }));
  EXPECT_LT(std::abs(died.unit(0).shaftSpeed()), 2.0) << "1 % of P105 are 1.6 rad/s";
}

// The shares the drive layer commands are of the P105 it has read: told as rpm by another one, they are another speed.
TEST(CanopenCia402, IsNotScaledByAReadOfTheUser) {
  CanRobot robot{cia402()};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  ASSERT_NEAR(25.0, robot.unit(0).inverter().frequency(), 0.1);
  for (const unsigned set : {0u, 2u}) robot.unit(0).parameters().preset(105, set, 0, 1000);  // by its keypad
  std::vector<std::string> frames;
  robot.bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
    if (frame.id == 0x203) frames.push_back(toHex(frame.bytes()));
  });
  const auto readWhileDriving = [&](std::uint8_t set) {
    cycle::Request request;
    request.id = 4711u + set;
    request.patience = std::chrono::seconds{3};
    request.kind = cycle::RequestKind::kReadParameter;
    request.drive = 0;
    request.parameter.number = 105;
    request.parameter.shape = profile::ParameterShape::kPerSet;
    request.parameter.parameter_set = set;
    robot.ports().submit(request);
    robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{1});
    ASSERT_EQ(1000, robot.completions().back().parameter.raw);
  };
  readWhileDriving(3);
  readWhileDriving(1);
  ASSERT_FALSE(frames.empty());
  EXPECT_THAT(frames, ::testing::Each("7F 00 EE 02"));
}

// With P551 on only set 1 counts (BU 0060 p. 57), and 6040h and 6041h have no bits for another one.
TEST(CanopenCia402, HasParameterSet1Only) {
  CanRobot robot{cia402()};
  ASSERT_TRUE(robot.bringUp());
  const auto select = [&](std::uint8_t set) {
    cycle::Request request;
    request.kind = cycle::RequestKind::kSelectParameterSet;
    request.drive = 0;
    request.parameter_set = set;
    return robot.ask(request);
  };
  const Instant asked = robot.transport().now();
  const cycle::Completion answer = select(2);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left: its drive profile has parameter set 1 only"));
  EXPECT_LE(robot.transport().now() - asked, milliseconds{20}) << "nothing was tried";
  const cycle::Completion first = select(1);
  EXPECT_TRUE(first.success) << first.message.c_str();
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
}

// Nor are bits 8 and 9 of NORD's control word, 10 and 13 of its status word, in them.
TEST(CanopenCia402, RefusesSignalsThatItsWordsDoNotCarry) {
  CanRobot robot{cia402()};
  const auto refusal = [&](const char* source) {
    const MapSettings drive{"~drives/left/", {{"signals/lamp/source", std::string{source}}}};
    try {
      cycle::checkSignalsCarried(drive, cycle::readSignals(drive, profile::Series::kSk5xxe),
                                 robot.transport().identity(0));
    } catch (const ConfigError& error) {
      return std::string{error.what()};
    }
    return std::string{"taken"};
  };
  for (const char* source : {"control_bit_8", "control_bit_9", "status_bit_10", "status_bit_13"}) {
    EXPECT_THAT(refusal(source), HasSubstr(std::string{"~drives/left/signals/lamp/source: \""} + source)) << source;
  }
}

// 6042h is rpm: 16 bits of position would be a speed there, without an end.
TEST(CanopenCia402, RefusesToPosition) {
  CanRobot::Options options = cia402();
  options.base = false;
  options.drives.insert({{"mode", std::string{"position"}}, {"position/bits", 16}});
  CanRobot robot{options};
  const cycle::DriveSetup& left = robot.config().drives[0];
  try {
    cycle::checkPositionCarried(MapSettings{"~drives/left/", options.drives}, *left.position, left.series,
                                robot.transport().identity(0));
    FAIL() << "taken";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("~drives/left/mode: \"position\" is not valid"));
  }
}

// P551 off: the objects are not there, and the node says so at its start.
TEST(CanopenCia402, WithoutP551IsNamed) {
  CanRobot::Options options = cia402();
  options.simulate = nullptr;
  CanRobot robot{options};
  robot.run(std::chrono::seconds{3});
  EXPECT_FALSE(robot.online(0));
  EXPECT_THAT(robot.text(0), HasSubstr("profile cia402 needs P551 = 1"));
}

}  // namespace
}  // namespace nord_driver::test
