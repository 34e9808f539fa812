// The other ways an inverter sits on CAN: gateway, three values, SYNC, its own port, the system bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

// BU 0260: one node, PDO n and SDO server n for inverter n.
TEST(CanopenKinds, FourInvertersBehindAGateway) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  EXPECT_EQ("CANopen node 10, inverter 3", robot.transport().identity(2).address);
  EXPECT_EQ(TimeoutOwner::kModule, robot.transport().identity(2).timeout_owner);
  EXPECT_EQ(robot.transport().identity(0).shared_module, robot.transport().identity(2).shared_module);
  expectDrives(robot);
  // Parameters of inverter 2 are inverter 2's.
  EXPECT_TRUE(robot.ask(writeRequest(1, 103, 321, profile::ParameterAction::kWritePersistent)).success);
  EXPECT_EQ(321, robot.unit(1).parameters().value(103, 0));
  EXPECT_NE(321, robot.unit(0).parameters().value(103, 0));
}

// One inverter of four is off: that one is offline and named, the others go on.
TEST(CanopenKinds, AGatewayWithOneInverterMissing) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  robot.unit(2).setInverterPower(false);
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{1});
  EXPECT_FALSE(robot.online(2));
  EXPECT_TRUE(robot.snapshot().drives[2].module_answers);
  EXPECT_FALSE(robot.text(2).empty());
  for (const DriveIndex other : {0u, 1u, 3u}) EXPECT_TRUE(robot.online(other)) << other;
  robot.unit(2).setInverterPower(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(2); }, std::chrono::seconds{2}));
}

// Its cable is cut: the module reports the inverter missing by an emergency.
TEST(CanopenKinds, AGatewayThatLosesItsLinkToAnInverter) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.unit(2).setInverterLink(false);
  EXPECT_TRUE(robot.runUntil([&] { return !robot.online(2); }, std::chrono::seconds{1}));
  for (const DriveIndex other : {0u, 1u, 3u}) EXPECT_TRUE(robot.online(other)) << other;
}

/// EMCY 5000h of the third inverter, which goes on sending good status words.
CanFrame emergencyOfTheThird() {
  return dataFrame(0x08A, ByteView{FixedBytes<8>{0x00, 0x50, 1, 2, 0, 0, 0, 0}});
}

// BU 0260 p. 78: byte 3 of an emergency is the inverter, from 0. 5000h says that the module has lost it, whatever the
// module goes on sending for it.
TEST(CanopenKinds, AGatewaysEmergencyEndsTheInverterItNames) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.bus().inject(emergencyOfTheThird());
  robot.run(milliseconds{300});
  EXPECT_FALSE(robot.online(2));
  EXPECT_THAT(robot.text(2), HasSubstr("EMCY 5000h (E10.8, communication between bus module and inverter)"));
  for (const DriveIndex other : {0u, 1u, 3u}) EXPECT_TRUE(robot.online(other)) << other;
  robot.bus().inject(dataFrame(0x08A, ByteView{FixedBytes<8>{0x00, 0x00, 0, 2, 0, 0, 0, 0}}));
  robot.run(milliseconds{300});
  EXPECT_TRUE(robot.online(2));
}

// The emergency that takes it back may be lost: good status words that come for longer than it could be late count.
TEST(CanopenKinds, AnInverterWhoseEmergencyIsNeverTakenBackComesBack) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.bus().inject(emergencyOfTheThird());
  robot.run(milliseconds{300});
  EXPECT_FALSE(robot.online(2));
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(2); }, std::chrono::seconds{2}));
  robot.run(std::chrono::seconds{3});
  EXPECT_TRUE(robot.online(2));
  EXPECT_EQ("", robot.busText()) << "nothing is reported any more";
}

// What a module has said before it was without power says nothing of its inverters.
TEST(CanopenKinds, AGatewayThatWasWithoutPowerBeginsAnew) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  options.drives = {{"event_time", 0.5}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.bus().inject(emergencyOfTheThird());
  robot.run(milliseconds{50});
  robot.node(0).setPowered(false);
  robot.run(milliseconds{50});
  EXPECT_FALSE(robot.online(2));
  const std::uint64_t boot_ups = robot.node(0).counters().boot_ups;
  robot.node(0).setPowered(true);
  ASSERT_TRUE(robot.runUntil([&] { return robot.node(0).counters().boot_ups > boot_ups; }, std::chrono::seconds{1}));
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(2); }, milliseconds{600})) << robot.text(2);
}

// What it reported before it was switched off and on is over, also where nobody heard it say so.
TEST(CanopenKinds, ANodeThatWasWithoutPowerHasNoEmergency) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUp());
  robot.bus().inject(dataFrame(0x083, ByteView{FixedBytes<8>{0x10, 0x32, 1, 0, 0, 0, 0, 0}}));
  robot.run(milliseconds{50});
  ASSERT_THAT(robot.busText(), HasSubstr("EMCY 3210h"));
  robot.node(0).setPowered(false);
  robot.run(milliseconds{500});
  robot.node(0).setPowered(true);
  ASSERT_TRUE(robot.runUntil([&] { return robot.online(0); }, std::chrono::seconds{6}));
  robot.run(milliseconds{50});
  EXPECT_THAT(robot.busText(), ::testing::Not(HasSubstr("EMCY")));
}

TEST(CanopenKinds, AGatewayIsWaitedForWithAnInverterMissingFromTheStart) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  CanRobot robot{options};
  robot.unit(3).setInverterPower(false);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(0) && robot.online(1) && robot.online(2); }));
  EXPECT_FALSE(robot.online(3));
  robot.unit(3).setInverterPower(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(3); }, std::chrono::seconds{2}));
}

TEST(CanopenKinds, ThreeValuesComeByPdoTwo) {
  CanRobot::Options options;
  options.drives = {{"process_values", 3}};
  CanRobot robot{options};
  expectDrives(robot);
  EXPECT_EQ(3, robot.transport().identity(0).process_values);
  EXPECT_FALSE(robot.node(0).communication().tpdos[0].enabled());
  EXPECT_TRUE(robot.node(0).communication().tpdos[1].enabled());
}

TEST(CanopenKinds, SynchronousExchange) {
  CanRobot::Options options;
  options.bus = {{"sync", true}};
  CanRobot robot{options};
  expectDrives(robot);
  EXPECT_LT(robot.exchangeTime(), milliseconds{5});
}

// A read that brings nothing is a system call: one before the cycle's setpoints are sent, so that no answer is taken
// for a new one, one after each answer that comes alone (two here), one when the pause begins.
TEST(CanopenKinds, ACycleReadsNoOftenerThanItMust) {
  CanRobot::Options options;
  options.bus = {{"sync", true}};
  options.drives = {{"error_control", std::string{"none"}}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  const std::size_t before = robot.link().emptyReads();
  const std::uint64_t cycles = robot.snapshot().counters.value(bus_counter::kCycles);
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{1});
  const std::uint64_t of = robot.snapshot().counters.value(bus_counter::kCycles) - cycles;
  ASSERT_GE(of, 99u);
  EXPECT_LE(static_cast<double>(robot.link().emptyReads() - before) / static_cast<double>(of), 4.1);
}

TEST(CanopenKinds, TheOwnCanPortOfSk5xxE) {
  CanRobot::Options options;
  options.drives = {{"connection", std::string{"onboard"}}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives)
      drive.bus.as<sim::CanDriveConfig>().connection = sim::CanConnection::kOnboard;
  };
  CanRobot robot{options};
  expectDrives(robot);
}

// Experimental: taken to be as SK 5xxE on its own port.
TEST(CanopenKinds, TheSystemBus) {
  CanRobot::Options options;
  options.drives = {{"connection", std::string{"system_bus"}}};
  options.each = {{{"address", 32}}, {{"address", 34}}};
  options.simulate = [](sim::SimConfig& config) {
    config.drives[0].address = 32;
    config.drives[1].address = 34;
    for (sim::DriveConfig& drive : config.drives)
      drive.bus.as<sim::CanDriveConfig>().connection = sim::CanConnection::kSystemBus;
  };
  CanRobot robot{options};
  ASSERT_EQ(2u, robot.transport().warnings().size());
  EXPECT_THAT(robot.transport().warnings()[0], HasSubstr("experimental"));
  expectDrives(robot);
}

// Mappings that cannot be written: what they hold is compared first, and found right.
TEST(CanopenKinds, AFixedMappingIsFine) {
  CanRobot::Options options;
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::CanDriveConfig>().fixed_mapping = true;
  };
  CanRobot robot{options};
  expectDrives(robot);
}

TEST(CanopenKinds, ArraysByTheTable) {
  CanRobot::Options options;
  options.drives = {{"array_sub_index", std::string{"table"}}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::CanDriveConfig>().array_sub_by_table = true;
  };
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.unit(1).inverter().trip(30, true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.snapshot().drives[1].fault_number == 30; }, std::chrono::seconds{1}));
}

// Nothing changes in a drive that is commanded nothing: one that says nothing by itself is never there, and the note tells
// why, which event_time mends.
TEST(CanopenKinds, WithoutAnEventTimeANodeMustSendOnceByItself) {
  for (const double event_time : {0.0, 0.05}) {
    CanRobot::Options options;
    options.drives = {{"event_time", event_time}};
    CanRobot robot{options};
    robot.link().setDeaf(0x183);
    ASSERT_TRUE(robot.runUntil([&] { return robot.online(1); }));
    robot.run(std::chrono::seconds{1});
    EXPECT_FALSE(robot.online(0));
    EXPECT_THAT(robot.text(0), HasSubstr("the node is operational, but sends no process data: "));
    EXPECT_THAT(robot.text(0), HasSubstr("is its mains supply on, does P509 select CANopen?"));
    const auto told = HasSubstr("With event_time 0 it must send once when it becomes operational");
    EXPECT_EQ(event_time == 0.0, ::testing::Value(robot.text(0), told)) << robot.text(0);
  }
}

// Heartbeats both ways: the nodes watch ours (1016h) and stop their inverters when it ends.
TEST(CanopenKinds, OurHeartbeatIsWatchedByTheNodes) {
  CanRobot::Options options;
  options.bus = {{"heartbeat", 0.05}};
  options.drives = {{"error_control", std::string{"heartbeat"}}, {"watch_master", 0.2}};
  CanRobot robot{options};
  EXPECT_THAT(robot.transport().identity(0).protected_by, HasSubstr("heartbeat for 0.2 s"));
  expectDrives(robot);
  EXPECT_EQ(0u, robot.node(0).counters().masters_lost);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.bus().run(milliseconds{400});
  EXPECT_EQ(100, robot.unit(0).inverter().faultNumber());
}

// Only P513 is left then; who starts the node is told.
TEST(CanopenKinds, WithoutErrorControlOnlyP513Protects) {
  CanRobot::Options options;
  options.drives = {{"error_control", std::string{"none"}}};
  CanRobot robot{options};
  EXPECT_EQ("", robot.transport().identity(0).protected_by);
  EXPECT_EQ(TimeoutOwner::kInverter, robot.transport().identity(0).timeout_owner);
  expectDrives(robot);
}

// Its boot-up was not heard, and nothing but its process data tells that it has restarted.
TEST(CanopenKinds, WithoutErrorControlANodeThatRestartedUnheardComesBack) {
  CanRobot::Options options;
  options.drives = {{"error_control", std::string{"none"}}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  robot.link().setDeaf(0x704);
  robot.node(1).setPowered(false);
  robot.run(milliseconds{50});
  const std::uint64_t boot_ups = robot.node(1).counters().boot_ups;
  robot.node(1).setPowered(true);
  ASSERT_TRUE(robot.runUntil([&] { return robot.node(1).counters().boot_ups > boot_ups; }, std::chrono::seconds{1}));
  robot.run(milliseconds{50});
  robot.link().setDeaf(std::nullopt);
  ASSERT_TRUE(robot.runUntil([&] { return !robot.online(1); }, std::chrono::seconds{1}));
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(1); }, std::chrono::seconds{5})) << robot.text(1);
  EXPECT_TRUE(robot.online(0));
}

}  // namespace
}  // namespace nord_driver::test
