// A node whose state changes without our asking: by another master's command, or by itself. Whatever drive_timeout
// allows, the base stops within two cycles of what is on the wire, and no setpoint is sent to a node that is not
// operational.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;
constexpr std::uint8_t kRightNode = 4;
constexpr std::uint32_t kRightReceivePdo = 0x204, kRightErrorControl = 0x704;

/// drive_timeout long enough to bridge a restart of a node, which takes 0.1 to 0.4 s.
class Unasked {
 public:
  explicit Unasked(const std::string& error_control, const std::string& boot_reset = "communication")
      : robot_{options(error_control, boot_reset)} {}

  void drive() {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_EQ(0x2000, robot_.setpoint(kLeft));
    robot_.bus().setTap([this](const CanFrame& frame, sim::SimulatedCanBus::Sender sender, Instant) {
      if (frame.id == kRightErrorControl && frame.size == 1 && !frame.remote) states_.push_back(frame.data[0]);
      if (sender != sim::SimulatedCanBus::Sender::kMaster || frame.id != kRightReceivePdo) return;
      sent_.push_back(toHex(frame.bytes()));
      if (robot_.node(kRight).state() != sim::NmtState::kOperational) ++sent_in_vain_;
    });
  }
  /// Another master's command, on the wire when this returns.
  void command(std::uint8_t specifier) {
    robot_.bus().inject(dataFrame(0x000, ByteView{FixedBytes<2>{specifier, kRightNode}}));
    robot_.bus().run(milliseconds{1});
    forget();
  }
  void forget() {
    sent_.clear();
    states_.clear();
    sent_in_vain_ = 0;
  }
  void step() {
    robot_.command(kHalfSpeed);  // somebody goes on commanding, whatever happens
    robot_.step();
  }
  bool stopped() { return !robot_.snapshot().base.enabled && robot_.setpoint(kLeft) == 0; }
  void expectStoppedInTwoCycles() {
    step();
    step();
    EXPECT_TRUE(stopped());
    EXPECT_EQ(0x047F, robot_.controlWord(kLeft)) << "the other keeps its torque on its way down";
    EXPECT_NE(0x047F, robot_.controlWord(kRight));
    EXPECT_EQ(
        "drive right stopped: its connection to the bus was reset, or left operation, without being asked (status word "
        "1337, operation enabled)",
        robot_.snapshot().base.text.str());
  }
  /// It is started again, and stays at rest until somebody enables it.
  void expectBackAndAtRest() {
    EXPECT_TRUE(robot_.runUntil([this] { return robot_.online(kRight); }, seconds{2})) << robot_.text(kRight);
    for (int i = 0; i < 500; ++i) {
      step();
      ASSERT_TRUE(stopped()) << i;
      ASSERT_EQ(0, robot_.setpoint(kRight)) << i;
    }
    EXPECT_TRUE(robot_.standsStill());
    EXPECT_TRUE(robot_.snapshot().base.stopped);
    EXPECT_EQ(0u, sent_in_vain_) << "RPDOs to a node that is not operational";
    EXPECT_THAT(sent_, Each("7E 04 00 00"));
    robot_.run(milliseconds{600});
    robot_.ask(cycle::RequestKind::kAcknowledge, kRight);
    EXPECT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
    EXPECT_EQ("no rule broken", robot_.bus().referee().report());
  }
  /// Cycles until the base has stopped.
  int cyclesUntilStopped(int limit) {
    int cycles = 0;
    for (; cycles < limit && !stopped(); ++cycles) step();
    return cycles;
  }

  CanRobot robot_;
  std::vector<std::string> sent_;  ///< to the right drive
  std::vector<std::uint8_t> states_;
  int sent_in_vain_ = 0;

 private:
  static CanRobot::Options options(const std::string& error_control, const std::string& boot_reset) {
    CanRobot::Options options;
    options.node = {{"drive_timeout", 0.5}};
    options.drives = {{"error_control", error_control}, {"boot_reset", boot_reset}, {"heartbeat_time", 0.1}};
    return options;
  }
};

struct Command {
  const char* error_control;
  std::uint8_t specifier;
  const char* name;
};
void PrintTo(const Command& command, std::ostream* out) {
  *out << command.error_control << ", " << command.name;
}

class UnaskedCommand : public ::testing::TestWithParam<Command> {};

TEST_P(UnaskedCommand, StopsTheBaseAtOnce) {
  Unasked unasked{GetParam().error_control};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.command(GetParam().specifier);
  unasked.expectStoppedInTwoCycles();
  EXPECT_THAT(unasked.robot_.busText(), HasSubstr(std::string{"another master sends NMT \""} + GetParam().name));
  unasked.expectBackAndAtRest();
}

// The command itself may not have reached us: the next state the node tells is as good, one guard or heartbeat time
// later.
TEST_P(UnaskedCommand, IsToldByTheNodeToo) {
  Unasked unasked{GetParam().error_control};
  if (std::string{GetParam().error_control} == "none") return;  // nobody tells
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.robot_.link().setDeaf(0x000);
  unasked.command(GetParam().specifier);
  while (unasked.states_.empty()) unasked.step();
  EXPECT_LE(unasked.cyclesUntilStopped(20), 2);
  unasked.forget();
  unasked.expectBackAndAtRest();
}

INSTANTIATE_TEST_SUITE_P(
    All, UnaskedCommand,
    ::testing::Values(Command{"guarding", 0x82, "reset communication"}, Command{"guarding", 0x81, "reset node"},
                      Command{"guarding", 0x80, "enter pre-operational"}, Command{"guarding", 0x02, "stop"},
                      Command{"heartbeat", 0x82, "reset communication"},
                      Command{"heartbeat", 0x80, "enter pre-operational"}, Command{"heartbeat", 0x02, "stop"},
                      Command{"none", 0x82, "reset communication"}, Command{"none", 0x80, "enter pre-operational"},
                      Command{"none", 0x02, "stop"}));

// A short break of its supply: it is away for 0.1 s, less than drive_timeout, and comes with a boot-up nobody asked
// for.
TEST(UnaskedState, ABootUpStopsTheBaseAtOnce) {
  Unasked unasked{"guarding"};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.robot_.node(kRight).setPowered(false);
  unasked.robot_.bus().run(milliseconds{2});
  unasked.robot_.node(kRight).setPowered(true);
  unasked.forget();
  while (unasked.states_.empty()) unasked.step();
  ASSERT_EQ(0x00, unasked.states_.front());
  EXPECT_LE(unasked.cyclesUntilStopped(20), 2);
  EXPECT_THAT(unasked.robot_.snapshot().base.text.str(), HasSubstr("drive right stopped: its connection to the bus"));
  unasked.forget();
  unasked.expectBackAndAtRest();
}

// Start is what it is told anyway.
TEST(UnaskedState, StartChangesNothing) {
  Unasked unasked{"guarding"};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.command(0x01);
  for (int i = 0; i < 100; ++i) unasked.step();
  EXPECT_TRUE(unasked.robot_.snapshot().base.enabled);
  EXPECT_EQ(0x2000, unasked.robot_.setpoint(kLeft));
}

// To all nodes at once: neither is left running.
TEST(UnaskedState, ABroadcastStopsAllDrives) {
  Unasked unasked{"guarding"};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.robot_.bus().inject(dataFrame(0x000, ByteView{FixedBytes<2>{0x80, 0x00}}));
  unasked.robot_.bus().run(milliseconds{1});
  unasked.step();
  unasked.step();
  EXPECT_TRUE(unasked.stopped());
  EXPECT_NE(0x047F, unasked.robot_.controlWord(kLeft));
  EXPECT_TRUE(unasked.robot_.runUntil([&] { return unasked.robot_.standsStill(); }, seconds{10}));
}

// Without a reset at its start, a node that was stopped is led back all the same.
TEST(UnaskedState, AStoppedNodeThatIsNeverResetComesBack) {
  Unasked unasked{"guarding", "none"};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.command(0x02);
  unasked.expectStoppedInTwoCycles();
  unasked.expectBackAndAtRest();
}

// Lost by its guarding, with a drive_timeout beyond that: what is sent on unanswered is a stop word.
TEST(UnaskedState, ALostNodeGetsNoMoreSetpoints) {
  Unasked unasked{"guarding"};
  ASSERT_NO_FATAL_FAILURE(unasked.drive());
  unasked.robot_.node(kRight).setMute(true);
  ASSERT_TRUE(unasked.robot_.runUntil([&] { return !unasked.robot_.snapshot().drives[kRight].module_answers; },
                                      milliseconds{450}))
      << "before drive_timeout";
  unasked.forget();
  for (int i = 0; i < 30; ++i) unasked.step();
  EXPECT_TRUE(unasked.stopped());
  EXPECT_THAT(unasked.sent_, Each("7E 04 00 00"));
}

}  // namespace
}  // namespace nord_driver::test
