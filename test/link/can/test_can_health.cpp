// The numbers of the error frames are those of linux/can/error.h, typed here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/can_health.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StrEq;

constexpr std::uint32_t kController = 0x004;
constexpr std::uint32_t kProtocol = 0x008;
constexpr std::uint32_t kAcknowledge = 0x020;
constexpr std::uint32_t kBusOff = 0x040;
constexpr std::uint32_t kRestarted = 0x100;

class CanHealthTest : public ::testing::Test {
 protected:
  CanHealthTest() {
    interface.index = 3;
    interface.name = "can0";
    interface.is_can = interface.up = interface.has_controller = true;
    interface.bit_rate = 500'000;
    interface.state = CanState::kActive;
    health.opened(interface);
  }
  void error(std::uint32_t classes, std::array<std::uint8_t, 8> data = {}) { health.handleError({classes, data}, now); }

  CanInterface interface;
  CanHealth health;
  Instant now{std::chrono::hours{1}};
};

TEST_F(CanHealthTest, AHealthyBusNeedsNoWords) {
  EXPECT_EQ(CanState::kActive, health.state());
  EXPECT_STREQ("", health.advice());
}

// linux/can/error.h: data[1] 04h/08h warning, 10h/20h passive, 40h active again; RX and TX alike.
TEST_F(CanHealthTest, FollowsTheFaultConfinement) {
  error(kController, {0, 0x08});
  EXPECT_EQ(CanState::kWarning, health.state());
  EXPECT_THAT(health.advice(), HasSubstr("can0: many errors"));
  error(kController, {0, 0x10});
  EXPECT_EQ(CanState::kPassive, health.state());
  EXPECT_THAT(health.advice(), HasSubstr("can0 is error passive"));
  error(kController, {0, 0x04});
  EXPECT_EQ(CanState::kWarning, health.state());
  error(kController, {0, 0x20});
  EXPECT_EQ(CanState::kPassive, health.state());
  EXPECT_EQ(4u, health.counters().controller_errors);
  error(kController, {0, 0x40});
  EXPECT_EQ(CanState::kActive, health.state());
  EXPECT_EQ(4u, health.counters().controller_errors);
  EXPECT_STREQ("", health.advice());
}

// ISO 11898-1: each good frame lowers the counters by one; drivers that never say "active" must not warn for ever.
TEST_F(CanHealthTest, EnoughGoodFramesProveTheRecovery) {
  error(kController, {0, 0x30});
  for (int i = 0; i < CanHealth::kFramesToRecover - 1; ++i) health.handleFrame();
  EXPECT_EQ(CanState::kPassive, health.state());
  error(kController, {0, 0x30});  // begins again
  for (int i = 0; i < CanHealth::kFramesToRecover - 1; ++i) health.handleFrame();
  EXPECT_EQ(CanState::kPassive, health.state());
  health.handleFrame();
  EXPECT_EQ(CanState::kActive, health.state());
}

TEST_F(CanHealthTest, TheOverflowOfTheControllerIsCounted) {
  error(kController, {0, 0x01});
  EXPECT_EQ(1u, health.counters().controller_errors);
  EXPECT_EQ(CanState::kActive, health.state());
}

// Two ways to say it: a class of its own, or a protocol error at the ACK slot (19h).
TEST_F(CanHealthTest, NobodyAcknowledges) {
  for (const std::uint32_t classes : {kAcknowledge, kProtocol}) {
    error(classes, {0, 0, 0x80, 0x19});
    EXPECT_STREQ("can0: no other node acknowledges: are the drives powered and is the bus terminated?",
                 health.advice());
    health.handleFrame();  // somebody is there
    EXPECT_STREQ("", health.advice());
  }
  EXPECT_EQ(2u, health.counters().no_acknowledge);
  EXPECT_EQ(0u, health.counters().bus_errors);
}

TEST_F(CanHealthTest, ManyProtocolErrorsWithinASecondAreTold) {
  for (int i = 0; i < 4; ++i) error(kProtocol, {0, 0, 0x04, 0x0A});
  EXPECT_STREQ("", health.advice());
  now += milliseconds{999};
  error(kProtocol, {0, 0, 0x04, 0x0A});
  EXPECT_THAT(health.advice(), HasSubstr("5 bus errors within a second"));
  EXPECT_EQ(5u, health.counters().bus_errors);
}

TEST_F(CanHealthTest, RareProtocolErrorsAreOnlyCounted) {
  for (int i = 0; i < 20; ++i) {
    error(kProtocol, {0, 0, 0x01, 0x0A});
    now += milliseconds{300};
  }
  EXPECT_EQ(20u, health.counters().bus_errors);
  EXPECT_STREQ("", health.advice());
}

TEST_F(CanHealthTest, BusOffAndRestarted) {
  error(kBusOff);
  error(kBusOff);
  EXPECT_EQ(CanState::kBusOff, health.state());
  EXPECT_EQ(1u, health.counters().bus_off);
  error(kRestarted);
  EXPECT_EQ(CanState::kActive, health.state());
  EXPECT_EQ(1u, health.counters().restarts);
}

// The kernel tells of bus-off twice: as an error frame and as a message about the interface.
TEST_F(CanHealthTest, BusOffToldTwiceIsOne) {
  interface.state = CanState::kBusOff;
  health.handleInterface(interface);
  error(kBusOff);
  EXPECT_EQ(1u, health.counters().bus_off);
  error(kRestarted);
  interface.state = CanState::kActive;
  health.handleInterface(interface);
  EXPECT_EQ(1u, health.counters().restarts);
}

TEST_F(CanHealthTest, BusOffSaysWhoRestarts) {
  error(kBusOff);
  EXPECT_TRUE(health.wantsRestart());
  EXPECT_THAT(health.advice(), AllOf(HasSubstr("can0 is bus-off"), HasSubstr("asked for every second")));
  health.restartRefused();
  EXPECT_FALSE(health.wantsRestart());
  EXPECT_THAT(health.advice(), HasSubstr("sudo ip link set can0 type can restart"));
  error(kRestarted);
  error(kBusOff);  // permissions may have changed
  EXPECT_TRUE(health.wantsRestart());
}

TEST_F(CanHealthTest, AnAutomaticRestartIsLeftToTheInterface) {
  interface.restart_ms = 100;
  health.opened(interface);
  error(kBusOff);
  EXPECT_FALSE(health.wantsRestart());
  EXPECT_THAT(health.advice(), HasSubstr("restarts by itself after 100 ms"));
}

// vcan has no controller: nobody could be asked.
TEST_F(CanHealthTest, WithoutAControllerNothingIsAsked) {
  interface.has_controller = false;
  interface.state = CanState::kUnknown;
  health.opened(interface);
  error(kBusOff);
  EXPECT_FALSE(health.wantsRestart());
  EXPECT_THAT(health.advice(), AllOf(HasSubstr("can0 is bus-off"), Not(HasSubstr("restart"))));
}

TEST_F(CanHealthTest, DownAndUpAgain) {
  health.handleDown();
  EXPECT_EQ(CanState::kDown, health.state());
  EXPECT_STREQ("can0 is down: sudo ip link set can0 up", health.advice());
  health.handleInterface(interface);
  EXPECT_EQ(CanState::kActive, health.state());
  EXPECT_EQ(0u, health.counters().restarts);
}

// Without messages about interfaces a frame that went out is the proof.
TEST_F(CanHealthTest, ASentFrameProvesThatItIsUp) {
  health.handleDown();
  health.handleSent();
  EXPECT_EQ(CanState::kUnknown, health.state());
}

TEST_F(CanHealthTest, AnInterfaceNeverSetUpNeedsABitRate) {
  interface.up = false;
  interface.bit_rate = 0;
  health.opened(interface);
  EXPECT_STREQ("can0 is down: sudo ip link set can0 up type can bitrate RATE", health.advice());
}

TEST_F(CanHealthTest, AQueueThatStaysFullIsTold) {
  health.handleQueueFull();
  health.handleQueueFull();
  EXPECT_STREQ("", health.advice());
  health.handleQueueFull();
  EXPECT_THAT(health.advice(), HasSubstr("send queue stays full"));
  EXPECT_EQ(3u, health.counters().queue_full);
  health.handleSent();
  EXPECT_STREQ("", health.advice());
}

// systemd issue 9194: with fq_codel as default discipline CAN frames vanish silently.
TEST_F(CanHealthTest, TheWrongQueueingDisciplineIsNamed) {
  interface.queue = "fq_codel";
  health.opened(interface);
  EXPECT_THAT(health.advice(), HasSubstr("sudo tc qdisc replace dev can0 root pfifo_fast"));
}

TEST_F(CanHealthTest, ReopeningKeepsTheCountersAndForgetsTheState) {
  error(kAcknowledge);
  error(kBusOff);
  health.opened(interface);
  EXPECT_EQ(CanState::kActive, health.state());
  EXPECT_EQ(1u, health.counters().no_acknowledge);
  EXPECT_EQ(1u, health.counters().bus_off);
  EXPECT_STREQ("", health.advice());
}

}  // namespace
}  // namespace nord_driver::link
