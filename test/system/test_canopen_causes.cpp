// What stops the base over CANopen without being asked, and what is said about it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;

class CanopenCauses : public ::testing::Test {
 protected:
  void start(const CanRobot::Options& options = {}) {
    robot_ = std::make_unique<CanRobot>(options);
    ASSERT_TRUE(robot_->bringUpAndEnable());
    robot_->drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
    ASSERT_EQ(0x2000, robot_->snapshot().drives[kLeft].output.setpoints[0]);
  }
  void step() {
    robot_->command(kHalfSpeed);  // somebody goes on commanding, whatever happens
    robot_->step();
  }
  /// Cycles until the driver knows that the right drive has stopped or is gone, at most `limit`.
  int cyclesUntilKnown(int limit) {
    for (int i = 0; i < limit; ++i) {
      const cycle::DriveSnapshot& right = robot_->snapshot().drives[kRight];
      if (!right.online || right.stopped) return i;
      step();
    }
    return limit;
  }
  /// The drive concerned is idle two cycles later, the other keeps torque and gets setpoint 0.
  void expectReaction() {
    step();
    step();
    EXPECT_EQ(0x047E, robot_->controlWord(kRight));
    EXPECT_EQ(0x047F, robot_->controlWord(kLeft));
    EXPECT_EQ(0, robot_->snapshot().drives[kLeft].output.setpoints[0]);
  }
  void expectRestForGood() {
    for (int i = 0; i < 500; ++i) {
      step();
      ASSERT_EQ(0, robot_->snapshot().drives[kLeft].output.setpoints[0]);
      ASSERT_EQ(0, robot_->snapshot().drives[kRight].output.setpoints[0]);
    }
    EXPECT_TRUE(robot_->runUntil([this] { return robot_->standsStill(); }));
    EXPECT_FALSE(robot_->snapshot().base.enabled);
    EXPECT_TRUE(robot_->snapshot().base.stopped);
  }
  std::string stopText() { return robot_->snapshot().base.text.str(); }
  cycle::Completion enableAtRest() {
    robot_->run(milliseconds{600});  // the last command is too old by then
    return robot_->ask(cycle::RequestKind::kEnable);
  }
  cycle::Completion acknowledgeAndEnable() {
    robot_->ask(cycle::RequestKind::kAcknowledge, kLeft);
    robot_->ask(cycle::RequestKind::kAcknowledge, kRight);
    return enableAtRest();
  }
  Duration timeUntilOnline(Duration limit) {
    const Instant start = robot_->transport().now();
    while (!(robot_->online(kLeft) && robot_->online(kRight)) && robot_->transport().now() - start < limit) step();
    return robot_->transport().now() - start;
  }
  void expectNoRuleBroken() { EXPECT_EQ("no rule broken", robot_->bus().referee().report()); }

  std::unique_ptr<CanRobot> robot_;
};

// The emergency names the group, P700 the number (BU 0060 p. 93: 2310h is E3.0).
TEST_F(CanopenCauses, AFaultStopsTheBaseAndIsNamedTwice) {
  start();
  robot_->unit(kRight).inverter().trip(30, true);
  EXPECT_LE(cyclesUntilKnown(10), 3);
  expectReaction();
  EXPECT_THAT(stopText(), HasSubstr("drive right stopped: a fault of the inverter"));
  EXPECT_TRUE(robot_->runUntil([this] { return robot_->snapshot().drives[kRight].fault_number == 30; },
                               std::chrono::seconds{1}));
  EXPECT_EQ("drive right reports EMCY 2310h (E3.0, overcurrent at the output (I2t limit))", robot_->busText());
  expectRestForGood();
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("drive right: the inverter reports a fault"));
  expectNoRuleBroken();
}

// Node guarding, 100 ms times 3: the node is silent, the base stops, the drive is named with the reason.
TEST_F(CanopenCauses, AGuardedNodeThatFallsSilentStopsTheBase) {
  start();
  robot_->node(kRight).setMute(true);
  EXPECT_LE(cyclesUntilKnown(100), 40) << "event timer or guarding, then drive_timeout";
  expectReaction();
  EXPECT_THAT(stopText(), HasSubstr("drive right stopped: the inverter fell silent"));
  EXPECT_TRUE(
      robot_->runUntil([this] { return !robot_->snapshot().drives[kRight].module_answers; }, std::chrono::seconds{1}));
  EXPECT_THAT(robot_->text(kRight), HasSubstr("guard"));
  expectRestForGood();
}

// A lost node may still hear us: the stop word is sent on unanswered, but not for ever. After shutdown_timeout nothing
// is sent that would keep its P513 time-out from tripping.
TEST_F(CanopenCauses, AStopWordGoesIntoTheDarkForShutdownTimeoutOnly) {
  CanRobot::Options options;
  options.node = {{"shutdown_timeout", 1.0}};
  start(options);
  robot_->node(kRight).setMute(true);
  ASSERT_TRUE(
      robot_->runUntil([this] { return !robot_->snapshot().drives[kRight].module_answers; }, std::chrono::seconds{1}));
  std::vector<std::string> sent;
  robot_->bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
    if (frame.id == 0x204) sent.push_back(toHex(frame.bytes()));
  });
  for (int i = 0; i < 50; ++i) step();
  EXPECT_GE(sent.size(), 49u) << "one a cycle";
  for (const std::string& bytes : sent) EXPECT_EQ("7E 04 00 00", bytes);
  for (int i = 0; i < 60; ++i) step();
  sent.clear();
  for (int i = 0; i < 200; ++i) step();
  EXPECT_THAT(sent, ::testing::IsEmpty());
}

TEST_F(CanopenCauses, AHeartbeatThatStopsStopsTheBase) {
  CanRobot::Options options;
  options.drives = {{"error_control", std::string{"heartbeat"}}, {"heartbeat_time", 0.05}};
  start(options);
  robot_->node(kRight).setMute(true);
  EXPECT_LE(cyclesUntilKnown(100), 40);
  expectReaction();
  EXPECT_TRUE(
      robot_->runUntil([this] { return !robot_->snapshot().drives[kRight].module_answers; }, std::chrono::seconds{1}));
  EXPECT_THAT(robot_->text(kRight), HasSubstr("heartbeat"));
  expectRestForGood();
}

// Off and on again: found by its boot-up or by asking, within 2 s, at rest, and enabled only when asked.
TEST_F(CanopenCauses, ANodeThatWasOffIsBackWithinTwoSecondsAtRest) {
  start();
  robot_->unit(kRight).setPlugged(false);
  for (int i = 0; i < 150; ++i) step();
  EXPECT_FALSE(robot_->online(kRight));
  robot_->unit(kRight).setPlugged(true);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.0);
  expectRestForGood();
  EXPECT_STREQ("enabled", enableAtRest().message.c_str());
  robot_->drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  EXPECT_EQ(-0x2000, robot_->snapshot().drives[kRight].output.setpoints[0]);
}

// A short dip: the node's answers are lost for half a second.
TEST_F(CanopenCauses, ANodeThatIsBackDoesNotMoveBeforeItIsEnabled) {
  start();
  robot_->node(kRight).setMute(true);
  for (int i = 0; i < 60; ++i) step();
  robot_->node(kRight).setMute(false);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.0);
  expectRestForGood();
}

// Modules with a supply of their own answer for an inverter that is off, with zeros (BU 0020 2.1.3).
TEST_F(CanopenCauses, AnInverterThatIsOffBehindItsModuleStopsTheBase) {
  start();
  robot_->unit(kRight).setInverterPower(false);
  EXPECT_LE(cyclesUntilKnown(30), 25);
  expectReaction();
  EXPECT_TRUE(robot_->snapshot().drives[kRight].module_answers);
  EXPECT_FALSE(robot_->text(kRight).empty());
  robot_->unit(kRight).setInverterPower(true);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.0);
  expectRestForGood();
}

// Guarding goes on, but no process data come: nobody knows what the inverter does. Two and a half event times of 50 ms
// and drive_timeout are the bound.
TEST_F(CanopenCauses, ProcessDataThatStopStopTheBase) {
  start();
  robot_->link().setDeaf(0x184);
  EXPECT_LE(cyclesUntilKnown(100), 20);
  expectReaction();
  EXPECT_TRUE(robot_->snapshot().drives[kRight].module_answers);
  EXPECT_THAT(robot_->text(kRight), HasSubstr("operational, but sends no process data"));
  robot_->link().setDeaf(std::nullopt);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 0.5);
  expectRestForGood();
}

// The computer dies: the node misses its guarding, the inverter trips E10.0 and the motor coasts.
TEST_F(CanopenCauses, WithoutUsTheNodesStopTheirInverters) {
  start();
  EXPECT_THAT(robot_->transport().identity(kLeft).protected_by, HasSubstr("node guarding, 0.3 s"));
  robot_->bus().run(milliseconds{500});
  EXPECT_EQ(1u, robot_->node(kLeft).counters().masters_lost);
  EXPECT_EQ(100, robot_->unit(kLeft).inverter().faultNumber()) << "E10.0";
  EXPECT_EQ(100, robot_->unit(kRight).inverter().faultNumber());
}

// The clean end: at rest first, then the nodes leave operational by our word, and miss nobody.
TEST_F(CanopenCauses, ACleanEndLeavesNoFault) {
  start();
  robot_->run(milliseconds{600});
  ASSERT_TRUE(robot_->ask(cycle::RequestKind::kShutDown).success);
  robot_->transport().close();
  robot_->bus().run(std::chrono::seconds{3});
  for (const DriveIndex drive : {kLeft, kRight}) {
    EXPECT_EQ(0u, robot_->node(drive).counters().masters_lost);
    EXPECT_EQ(0, robot_->unit(drive).inverter().faultNumber());
    EXPECT_EQ(sim::NmtState::kPreOperational, robot_->node(drive).state());
  }
  expectNoRuleBroken();
}

// --- The bus itself --------------------------------------------------------------------------------------------------

TEST_F(CanopenCauses, BusOffStopsTheBaseAndIsOverAfterTheRestart) {
  start();
  robot_->bus().setBusOff();
  for (int i = 0; i < 60; ++i) step();
  EXPECT_FALSE(robot_->snapshot().connected);
  EXPECT_FALSE(robot_->online(kLeft));
  EXPECT_FALSE(robot_->busText().empty());
  robot_->bus().restart();
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.5);
  expectRestForGood();
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("fault")) << "E10.0, left by the guarding";
  EXPECT_TRUE(acknowledgeAndEnable().success);
}

TEST_F(CanopenCauses, AnInterfaceThatIsPulledAndBack) {
  start();
  robot_->bus().setInterfacePresent(false);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_FALSE(robot_->snapshot().connected);
  EXPECT_EQ(robot_->bus().lastError(), robot_->busText());
  EXPECT_EQ("the CAN interface is not open", robot_->text(kLeft));
  EXPECT_THAT(robot_->snapshot().base.text.c_str(), HasSubstr("fell silent")) << "nobody has reset anything";
  robot_->bus().setInterfacePresent(true);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.5);
  expectRestForGood();
  EXPECT_TRUE(acknowledgeAndEnable().success);
}

TEST_F(CanopenCauses, AnInterfaceThatIsSetDownAndUp) {
  start();
  robot_->bus().setInterfaceUp(false);
  for (int i = 0; i < 60; ++i) step();
  EXPECT_FALSE(robot_->online(kLeft));
  EXPECT_FALSE(robot_->busText().empty());
  EXPECT_EQ("the CAN bus does not work", robot_->text(kLeft));
  robot_->bus().setInterfaceUp(true);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.5);
  expectRestForGood();
}

// The stop word of a drive that fell silent takes the enable away, and so acknowledges (BU 0020 8). The fault it was
// left with is seen before, also when the node's first TPDO is late.
TEST_F(CanopenCauses, AFaultIsSeenBeforeAStopWordAcknowledgesIt) {
  constexpr std::uint32_t kTpdoOfLeft = 0x183;
  start();
  robot_->bus().setInterfacePresent(false);
  for (int i = 0; i < 100; ++i) step();
  ASSERT_NE(0, robot_->unit(kLeft).inverter().faultNumber()) << "nobody guards it any more";
  robot_->link().setDeaf(kTpdoOfLeft);
  robot_->bus().setInterfacePresent(true);
  EXPECT_TRUE(robot_->runUntil([this] { return robot_->node(kLeft).state() == sim::NmtState::kOperational; }));
  for (int i = 0; i < 4; ++i) step();
  robot_->link().setDeaf(std::nullopt);
  EXPECT_LT(toSeconds(timeUntilOnline(std::chrono::seconds{5})), 2.5);
  for (int i = 0; i < 60; ++i) step();
  EXPECT_TRUE(robot_->snapshot().drives[kLeft].fault_latched);
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("fault"));
}

// A queue that is full takes no setpoint, and no old one leaves when it drains: what goes out then is of that cycle.
TEST_F(CanopenCauses, NoStaleSetpointLeavesAfterAStall) {
  start();
  robot_->bus().setQueueFull(true);
  const std::uint64_t before = robot_->node(kLeft).counters().rpdos;
  for (int i = 0; i < 5; ++i) {
    robot_->command(kHalfSpeed);
    robot_->step();
    EXPECT_LE(toSeconds(robot_->exchangeTime()), 0.0055) << "half a cycle is the most a full queue may cost";
  }
  EXPECT_EQ(before, robot_->node(kLeft).counters().rpdos);
  robot_->command(0.0);
  robot_->step();
  robot_->bus().setQueueFull(false);
  std::vector<std::string> sent;
  robot_->bus().setTap([&](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant) {
    if (frame.id == 0x203) sent.push_back(toHex(frame.bytes()));
  });
  robot_->command(0.0);
  robot_->step();
  ASSERT_EQ(1u, sent.size()) << "one control word per cycle, not those of the cycles before";
  EXPECT_EQ("7F 04 00 00", sent[0]);
  EXPECT_GT(robot_->snapshot().counters.value(bus_counter::kStale), 0u) << "superseded RPDOs are counted";
}

// Frames the interface had no room for are counted; the drives stay.
TEST_F(CanopenCauses, AnOverflowIsCountedAndSurvived) {
  start();
  const std::uint64_t before = robot_->snapshot().counters.value(bus_counter::kOverruns);
  robot_->bus().overflow(3);
  robot_->drive(kHalfSpeed, 0.0, milliseconds{1500});
  EXPECT_EQ(before + 3, robot_->snapshot().counters.value(bus_counter::kOverruns));
  EXPECT_EQ("can0: received frames were lost, 3 since the start: this computer took them too late", robot_->busText());
  EXPECT_TRUE(robot_->online(kLeft));
  EXPECT_TRUE(robot_->snapshot().base.enabled);
}

// One frame in fifty is lost: retries, event timers and guarding carry it, whichever frames it hits.
TEST_F(CanopenCauses, ABadLineIsSurvived) {
  sim::CanDisturbance disturbance;
  disturbance.lose = 0.02;
  disturbance.duplicate = 0.02;
  disturbance.error = 0.05;
  for (const milliseconds begin :
       {milliseconds{0}, milliseconds{30}, milliseconds{70}, milliseconds{110}, milliseconds{150}}) {
    SCOPED_TRACE(std::to_string(begin.count()) + " ms later");
    start();
    robot_->drive(kHalfSpeed, 0.0, begin);
    robot_->bus().setDisturbance(disturbance);
    robot_->drive(kHalfSpeed, 0.0, std::chrono::seconds{20});
    EXPECT_TRUE(robot_->snapshot().base.enabled) << stopText();
    EXPECT_NEAR(kHalfSpeed, robot_->snapshot().base.velocity.linear_x, 0.02);
  }
}

// --- Others on the bus -----------------------------------------------------------------------------------------------

TEST_F(CanopenCauses, StrangersAreCountedAndNamedAndChangeNothing) {
  start();
  const std::uint64_t before = robot_->snapshot().counters.value(bus_counter::kUnexpected);
  const FixedBytes<8> zeros{0, 0, 0, 0, 0, 0, 0, 0};
  CanFrame extended = dataFrame(0x18DAF110, ByteView{zeros});
  extended.extended = true;
  for (const CanFrame& frame :
       {extended, dataFrame(0x1B9, ByteView{zeros}), dataFrame(0x183, ByteView{FixedBytes<1>{7}}),
        dataFrame(0x739, ByteView{FixedBytes<1>{5}}), dataFrame(0x083, ByteView{FixedBytes<2>{0, 0}}),
        dataFrame(0x583, ByteView{FixedBytes<3>{1, 2, 3}}), dataFrame(0x703, ByteView{zeros})}) {
    robot_->bus().inject(frame);
    robot_->drive(kHalfSpeed, 0.0, milliseconds{50});
  }
  EXPECT_GT(robot_->snapshot().counters.value(bus_counter::kUnexpected), before + 3);
  EXPECT_TRUE(robot_->snapshot().base.enabled) << stopText();
}

TEST_F(CanopenCauses, ASecondMasterIsNamed) {
  start();
  robot_->bus().inject(dataFrame(0x203, ByteView{FixedBytes<4>{0x7E, 0x04, 0, 0}}));
  robot_->drive(kHalfSpeed, 0.0, milliseconds{50});
  EXPECT_THAT(robot_->busText(), HasSubstr("master"));
}

// Another device under the id we expect: it is not started.
TEST(CanopenIdentity, AWrongDeviceIsRefusedInWords) {
  CanRobot::Options options;
  options.each = {{}, {{"vendor_id", 0x99}}};
  CanRobot robot{options};
  robot.run(std::chrono::seconds{3});
  EXPECT_TRUE(robot.online(kLeft));
  EXPECT_FALSE(robot.online(kRight));
  EXPECT_EQ(0u, robot.node(kRight).counters().rpdos);
  EXPECT_THAT(robot.text(kRight), AllOf(HasSubstr("vendor"), HasSubstr("99")));
}

TEST(CanopenIdentity, TheRightDeviceIsToldInItsNumbers) {
  CanRobot::Options demanded;
  demanded.drives = {{"vendor_id", 0x4E}, {"product_code", 1}};
  for (const CanRobot::Options& options : {demanded, CanRobot::Options{}}) {
    CanRobot robot{options};
    ASSERT_TRUE(robot.bringUp());
    EXPECT_EQ(0x004E0001u, robot.snapshot().drives[kLeft].device.ident);
  }
}

// Only what is ours reaches this computer: the interface filters the rest.
TEST(CanopenIdentity, TheInterfaceIsToldWhatToReceive) {
  CanRobot robot;
  const std::vector<std::uint32_t>& ids = robot.filteredIds();
  EXPECT_NE(ids.end(), std::find(ids.begin(), ids.end(), 0x183u));
  EXPECT_NE(ids.end(), std::find(ids.begin(), ids.end(), 0x084u));
  EXPECT_EQ(ids.end(), std::find(ids.begin(), ids.end(), 0x185u));
}

}  // namespace
}  // namespace nord_driver::test
