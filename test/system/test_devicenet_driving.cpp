// The whole way of a command over DeviceNet: from a twist to the frames of BU 0280 4.2.4, and back to odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/can_trace.h"
#include "system/devicenet_robot.h"
#include "system/four_inverters.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::Contains;
using ::testing::HasSubstr;

/// What goes over the bus under one of the given identifiers, each frame once until it changes.
class Changes {
 public:
  Changes(DevicenetRobot& robot, std::vector<std::uint32_t> ids) : ids_(std::move(ids)) {
    robot.bus().setTap([this](const CanFrame& frame, sim::SimulatedDnBus::Sender, Instant) {
      if (std::find(ids_.begin(), ids_.end(), frame.id) == ids_.end() || frame.remote) return;
      const std::string text = candumpText(frame);
      if (last_[frame.id] != text) seen.push_back(text);
      last_[frame.id] = text;
    });
  }
  std::vector<std::string> seen;

 private:
  std::vector<std::uint32_t> ids_;
  std::map<std::uint32_t, std::string> last_;
};

DevicenetRobot::Options withoutSlip(DevicenetRobot::Options options = {}) {
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.motor.slip = 0.001;
  };
  return options;
}

// 50 % of P105: setpoint 2000h, low byte first; 7E 04 idle, 7F 04 run; 31 0B and 37 0B back.
TEST(DevicenetDriving, ATwistBecomesTheManualsFrames) {
  DevicenetRobot robot{withoutSlip()};
  Changes left{robot, {0x42D, 0x3C5}};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(left.seen, Contains("42D#007E040000"));
  EXPECT_EQ("3C5#00310B0000", left.seen.back());
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_THAT(left.seen, Contains("42D#007F040020"));
  EXPECT_EQ("3C5#00370B0020", left.seen.back());
  // The right motor is mounted the other way round.
  EXPECT_EQ(-0x2000, robot.setpoint(1));
  const cycle::CycleSnapshot& seen = robot.snapshot();
  EXPECT_DOUBLE_EQ(25.0, seen.drives[0].frequency);
  EXPECT_NEAR(kHalfSpeed, seen.base.velocity.linear_x, 1e-9);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  const double way = robot.unit(0).wheelAngle() * 0.1;
  EXPECT_GT(way, 1.0);
  EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01);
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

// Every way of exchange and every assembly that can drive.
class DevicenetKinds : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(DevicenetKinds, Drive) {
  DevicenetRobot::Options options;
  options.assembly = GetParam().second;
  options.drives = {{"io", std::string{GetParam().first}}};
  if (options.assembly == 102) options.node = {{"cycle_rate", 50.0}};
  DevicenetRobot robot{withoutSlip(options)};
  ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_NEAR(kHalfSpeed, robot.snapshot().base.velocity.linear_x, 2e-3);
  EXPECT_GT(robot.unit(0).wheelAngle(), 10.0);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(seconds{2});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

INSTANTIATE_TEST_SUITE_P(All, DevicenetKinds,
                         ::testing::Values(std::make_pair("poll", 100), std::make_pair("poll", 101),
                                           std::make_pair("poll", 102), std::make_pair("poll", 120),
                                           std::make_pair("poll", 21), std::make_pair("cos", 100),
                                           std::make_pair("cyclic", 101), std::make_pair("strobe", 100),
                                           std::make_pair("strobe", 101), std::make_pair("strobe", 21)),
                         [](const auto& test) {
                           return std::string{test.param.first} + std::to_string(test.param.second);
                         });

// Two cycles to the word that stops, whatever the packet rate.
TEST(DevicenetCyclic, AStopDoesNotWaitForThePacketRate) {
  DevicenetRobot::Options options;
  options.drives = {{"io", std::string{"cyclic"}}};
  options.bus = {{"expected_packet_rate", 1.0}};
  DevicenetRobot robot{withoutSlip(options)};
  ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
  robot.drive(kHalfSpeed, 0.0, seconds{6});
  const double before = std::abs(robot.unit(0).inverter().frequency());
  ASSERT_GT(before, 10.0);
  cycle::Request request;
  request.kind = cycle::RequestKind::kQuickStop;
  robot.ports().submit(request);
  for (int i = 0; i < 4; ++i) robot.step();
  EXPECT_LT(std::abs(robot.unit(0).inverter().frequency()), before);
}

// The AC drive profile has no OFF3 and no parameter sets: what is asked for ends all the same, or is refused in words.
TEST(DevicenetAcDrive, AQuickStopIsARampThatEnds) {
  for (const int assembly : {20, 21}) {
    DevicenetRobot::Options options;
    options.assembly = assembly;
    DevicenetRobot robot{withoutSlip(options)};
    ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
    EXPECT_FALSE(robot.transport().identity(0).has_quick_stop);
    for (const bool turning : {true, false}) {
      if (turning && assembly == 21) robot.drive(kHalfSpeed, 0.0, seconds{3});
      cycle::Request request;
      request.kind = cycle::RequestKind::kQuickStop;
      request.patience = seconds{10};
      const cycle::Completion stopped = robot.ask(request);
      EXPECT_TRUE(stopped.success) << stopped.message.c_str();
      EXPECT_TRUE(robot.standsStill());
      robot.run(milliseconds{600});
      const cycle::Completion enabled = robot.ask(cycle::RequestKind::kEnable);
      EXPECT_TRUE(enabled.success) << assembly << ": " << enabled.message.c_str();
    }
    ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
    cycle::Request set;
    set.kind = cycle::RequestKind::kSelectParameterSet;
    set.drive = 0;
    set.parameter_set = 2;
    EXPECT_THAT(robot.ask(set).message.str(), HasSubstr("parameter set 1 only"));
  }
}

/// `p104` in steps of 0.1 Hz.
DevicenetRobot::Options withoutReverse(bool base, int p104 = 50) {
  DevicenetRobot::Options options;
  options.assembly = 20;
  options.base = base;
  options.drives = {{"allow_minimum_frequency", true}};
  options.simulate = [p104](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.parameters = {{104, 0, 0, p104}};
  };
  return options;
}

// Assembly 20 has "run forward" alone, and with P104 > 0 the motor would turn by it at 0 rpm.
TEST(DevicenetAcDrive, ADriveWithoutReverseRestsWhereReverseIsCommanded) {
  DevicenetRobot robot{withoutReverse(false)};
  ASSERT_TRUE(robot.bringUp());
  for (const DriveIndex drive : {0, 1}) ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable, drive).success);
  const auto drive = [&robot](double velocity, Duration span) {
    const Instant end = robot.transport().now() + span;
    while (robot.transport().now() < end) {
      for (const DriveIndex i : {0, 1}) robot.ports().commandDrive(i, {velocity, robot.transport().now(), true});
      robot.step();
    }
  };
  for (const bool right : {true, false}) {
    const DriveIndex turns = right ? 0 : 1, rests = right ? 1 : 0;  // the second one is inverted
    drive(right ? 4.0 : -4.0, seconds{4});
    EXPECT_GT(robot.unit(turns).inverter().frequency(), 20.0);
    EXPECT_FALSE(robot.snapshot().drives[turns].saturated);
    EXPECT_EQ(0.0, robot.unit(rests).inverter().frequency());
    const cycle::DriveSnapshot& resting = robot.snapshot().drives[rests];
    EXPECT_TRUE(resting.enabled) << resting.text.c_str();
    EXPECT_TRUE(resting.saturated);
    EXPECT_EQ(0.0, resting.velocity_command);
    EXPECT_EQ(0x047E, robot.controlWord(rests));
  }
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

// The right wheel is mounted the other way round, so that a base of these two never has both of them forward.
TEST(DevicenetAcDrive, ABaseWithAWheelThatCannotReverseRestsAsAWhole) {
  for (const int p104 : {50, 0}) {
    DevicenetRobot robot{withoutReverse(true, p104)};
    ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
    for (const double linear : {kHalfSpeed, -kHalfSpeed}) {
      robot.drive(linear, 0.0, seconds{3});
      for (const DriveIndex wheel : {0, 1}) {
        EXPECT_EQ(0.0, robot.unit(wheel).inverter().frequency()) << linear << " m/s, P104 " << p104;
        EXPECT_TRUE(robot.snapshot().drives[wheel].saturated) << linear << " m/s, P104 " << p104;
      }
      EXPECT_TRUE(robot.snapshot().base.enabled) << robot.snapshot().base.text.c_str();
      EXPECT_EQ(0.0, robot.snapshot().base.pose.heading) << "it has not turned about one wheel";
    }
    robot.drive(0.0, -1.5, seconds{3});  // both motors forward
    for (const DriveIndex wheel : {0, 1}) EXPECT_GT(robot.unit(wheel).inverter().frequency(), 20.0);
    robot.drive(0.0, 1.5, seconds{6});
    for (const DriveIndex wheel : {0, 1}) EXPECT_EQ(0.0, robot.unit(wheel).inverter().frequency());
    EXPECT_EQ("no rule broken", robot.bus().referee().report());
  }
}

// Both wheels forward: such a base goes on ahead and in curves; a curve whose inner wheel would go backwards brings it to rest.
TEST(DevicenetAcDrive, ABaseThatOnlyGoesForwardRestsInATurnOnTheSpot) {
  DevicenetRobot::Options options = withoutReverse(true, 0);
  options.each = {{}, {{"inverted", false}}};
  const auto simulate = options.simulate;
  options.simulate = [simulate](sim::SimConfig& config) {
    simulate(config);
    config.drives[1].inverted = false;
  };
  DevicenetRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
  robot.drive(kHalfSpeed, 0.5, seconds{3});
  for (const DriveIndex wheel : {0, 1}) EXPECT_GT(robot.unit(wheel).inverter().frequency(), 10.0);
  for (const robot::Twist2d& twist : {robot::Twist2d{0.0, 1.5}, robot::Twist2d{0.1, -1.5}, robot::Twist2d{-0.2, 0.0}}) {
    robot.drive(twist.linear_x, twist.angular_z, seconds{6});
    for (const DriveIndex wheel : {0, 1}) {
      EXPECT_EQ(0.0, robot.unit(wheel).inverter().frequency()) << twist.linear_x << " m/s, wheel " << wheel;
      EXPECT_TRUE(robot.snapshot().drives[wheel].saturated);
    }
    robot.drive(kHalfSpeed, 0.0, seconds{3});
    for (const DriveIndex wheel : {0, 1}) EXPECT_GT(robot.unit(wheel).inverter().frequency(), 10.0);
  }
}

/// One module, four inverters in 33 bytes.
class DevicenetFourInverters : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(robot_.bringUp()) << robot_.text(0) << " / " << robot_.busText(); }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.bus().referee().report()); }
  static DevicenetRobot::Options options() {
    DevicenetRobot::Options options;
    options.assembly = 102;
    options.gateway_inverters = 4;
    options.node = {{"cycle_rate", 50.0}};
    return options;
  }

  DevicenetRobot robot_{options()};
};

// P151 is shared, sets are each one's own.
TEST_F(DevicenetFourInverters, ShareAModule) {
  expectMonitoringKnown(robot_);
  expectSharedTimeout(robot_, robot_.module(0));
  expectSetsOfTheirOwn(robot_);
}

TEST_F(DevicenetFourInverters, OneThatIsOffIsNamedAlone) {
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kEnable).success);
  robot_.unit(2).setInverterPower(false);
  ASSERT_TRUE(robot_.runUntil([&] { return !robot_.online(2); }, seconds{3}));
  EXPECT_TRUE(robot_.online(0) && robot_.online(1) && robot_.online(3));
  EXPECT_THAT(robot_.text(2), HasSubstr("the inverter behind it does not"));
  robot_.unit(2).setInverterPower(true);
  EXPECT_TRUE(robot_.runUntil([&] { return robot_.online(2); }, seconds{5}));
}

TEST_F(DevicenetFourInverters, AllOffAreNoTimeoutOfTheirModule) {
  expectAllOffAreNoTimeout(robot_, robot_.module(0));
}

// Nobody asks the module any more: E10.2 in all four. It stays in its time-out until all are acknowledged.
TEST_F(DevicenetFourInverters, AreAcknowledgedTogetherAfterATimeout) {
  robot_.run(seconds{1});  // disabled: the end of an enable would acknowledge by itself
  robot_.bus().run(milliseconds{800});
  for (DriveIndex drive = 0; drive < 4; ++drive) {
    EXPECT_EQ(102, robot_.unit(drive).inverter().faultNumber()) << drive;
  }
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{5}));
  robot_.run(seconds{1});
  expectAcknowledgedTogether(robot_, robot_.module(0));
}

// Explicit messages have no order that spares the EEPROM: P560 is set to 0 for the write, and put back.
TEST(DevicenetParameterAccess, ARamWriteGoesByP560) {
  for (const char* objects : {"numbered", "index_object"}) {
    DevicenetRobot::Options options;
    options.drives = {{"parameter_objects", std::string{objects}}};
    DevicenetRobot robot{options};
    ASSERT_TRUE(robot.bringUp()) << objects;
    cycle::Request request;
    request.kind = cycle::RequestKind::kWriteParameter;
    request.drive = 0;
    request.parameter.number = 102;
    request.parameter.shape = profile::ParameterShape::kPerSet;
    request.parameter.action = profile::ParameterAction::kWriteRam;
    request.parameter.raw = 150;
    const auto answer = robot.ask(request);
    EXPECT_TRUE(answer.success) << answer.message.c_str();
    EXPECT_EQ(150, robot.unit(0).parameters().value(102, 0)) << objects;
    EXPECT_EQ(1, robot.unit(0).parameters().value(560, 0)) << objects;
  }
}

/// At that address words of change of state and cyclic are taken by connection object 4, not by 2.
sim::DnModuleSettings withObjectFourAlone(int address) {
  sim::DnModuleSettings settings;
  settings.mac = static_cast<std::uint8_t>(address);
  settings.cos_instance_4_alone = true;
  return settings;
}

// The computer dies: DeviceNet's own time-out stops the drives, E10.2, and the wheel coasts, by whichever connection object
// the module takes the words.
TEST(DevicenetStops, WhenTheComputerDies) {
  for (const auto& [io, alone] :
       {std::make_pair("poll", false), std::make_pair("cos", false), std::make_pair("cos", true),
        std::make_pair("cyclic", false), std::make_pair("cyclic", true), std::make_pair("strobe", false)}) {
    DevicenetRobot::Options options;
    options.drives = {{"io", std::string{io}}};
    options.simulate = [only_four = alone](sim::SimConfig& config) {
      if (!only_four) return;
      for (const sim::DriveConfig& drive : config.drives) {
        config.bus.as<sim::DnBusConfig>().modules.push_back(withObjectFourAlone(drive.address));
      }
    };
    DevicenetRobot robot{options};
    ASSERT_TRUE(robot.bringUpAndEnable()) << io << alone;
    robot.drive(kHalfSpeed, 0.0, seconds{3});
    EXPECT_EQ("no rule broken", robot.bus().referee().report()) << io << alone;
    robot.bus().run(milliseconds{200});
    EXPECT_EQ(102, robot.unit(0).parameters().value(700, 0, 0)) << "E10.2 in steps of 0.1, " << io << alone;
    robot.bus().run(seconds{10});
    EXPECT_TRUE(robot.standsStill()) << io << alone;
  }
}

// After a clean exit the modules are released, and no inverter has tripped by it.
TEST(DevicenetStops, ACleanExitReleases) {
  DevicenetRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{2});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(seconds{2});
  robot.transport().close();
  EXPECT_FALSE(robot.module(0).inDataExchange());
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

// A module that loses its supply and comes back is connected again; nothing moves until it is enabled.
TEST(DevicenetStops, AModuleThatWasWithoutSupplyComesBack) {
  DevicenetRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{2});
  robot.module(1).setPowered(false);
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_FALSE(robot.online(1));
  robot.module(1).setPowered(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(1); }, seconds{6})) << robot.text(1);
  robot.drive(kHalfSpeed, 0.0, seconds{20});  // it coasts, and coasts long
  EXPECT_TRUE(robot.standsStill());
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

}  // namespace
}  // namespace nord_driver::test
