// Error frames as the drivers of controllers send them (linux/can/error.h), put on a vcan by hand: the kernel gives
// them to sockets that asked for their class.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "link/can/socket_can.h"
#include "socketcan/network.h"

namespace nord_driver::link {
namespace {

using ::testing::HasSubstr;

class SocketCanErrors : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(link.open()) << link.lastError(); }
  /// Takes error frames in until `seen()`. The kernel may deliver later than the sending call returns.
  template <typename Seen>
  bool takeUntil(Seen seen) {
    const Instant end = link.now() + std::chrono::seconds{10};
    while (!seen() && link.now() < end) {
      EXPECT_FALSE(link.waitReadable(link.now() + std::chrono::milliseconds{5}))
          << "an error frame is nothing to be received";
    }
    return seen();
  }
  void controller(std::uint8_t status, CanState state) {
    driver.sendError(CAN_ERR_CRTL, {0, status});
    EXPECT_TRUE(takeUntil([&] { return link.state() == state; })) << static_cast<int>(state);
  }

  VcanInterface bus{"nord_vcan"};
  BareSocket driver{bus.name()};
  SocketCan link{bus.settings({0x1B2})};
};

TEST_F(SocketCanErrors, WarningPassiveActive) {
  controller(CAN_ERR_CRTL_RX_WARNING, CanState::kWarning);
  EXPECT_THAT(link.advice(), HasSubstr("many errors on the bus"));
  controller(CAN_ERR_CRTL_TX_PASSIVE, CanState::kPassive);
  EXPECT_THAT(link.advice(), HasSubstr("error passive"));
  controller(CAN_ERR_CRTL_ACTIVE, CanState::kActive);
  EXPECT_STREQ("", link.advice());
  EXPECT_EQ(2u, link.counters().controller_errors);
}

TEST_F(SocketCanErrors, NobodyAcknowledgesUntilSomebodyIsHeard) {
  driver.sendError(CAN_ERR_ACK);
  EXPECT_TRUE(takeUntil([&] { return link.counters().no_acknowledge == 1; }));
  EXPECT_THAT(link.advice(), HasSubstr("no other node acknowledges: are the drives powered"));
  SocketCan other{bus.settings()};
  ASSERT_TRUE(other.open());
  ASSERT_EQ(CanSend::kSent, other.send(numberedFrame(0x1B2, 1)));
  CanFrame got;
  ASSERT_TRUE(next(link, got));
  EXPECT_STREQ("", link.advice());
}

TEST_F(SocketCanErrors, ProtocolErrorsAreCounted) {
  for (int i = 0; i < 10; ++i) driver.sendError(CAN_ERR_PROT | CAN_ERR_BUSERROR, {0, 0, CAN_ERR_PROT_STUFF, 0x0A});
  EXPECT_TRUE(takeUntil([&] { return link.counters().bus_errors == 10; })) << link.counters().bus_errors;
  EXPECT_THAT(link.advice(), HasSubstr("bus errors within a second"));
}

TEST_F(SocketCanErrors, BusOffAndRestarted) {
  driver.sendError(CAN_ERR_BUSOFF);
  EXPECT_TRUE(reaches(link, CanState::kBusOff));
  EXPECT_EQ(CanSend::kFailed, link.send(numberedFrame(0x232, 1)));
  EXPECT_TRUE(link.isOpen());
  EXPECT_THAT(link.advice(), HasSubstr("is bus-off"));
  driver.sendError(CAN_ERR_RESTARTED);
  EXPECT_TRUE(reaches(link, CanState::kActive));
  EXPECT_EQ(CanSend::kSent, link.send(numberedFrame(0x232, 1)));
  EXPECT_EQ(1u, link.counters().bus_off);
  EXPECT_EQ(1u, link.counters().restarts);
}

// Each frame that loses arbitration is daily life: the kernel keeps this class from us.
TEST_F(SocketCanErrors, LostArbitrationIsNotAskedFor) {
  driver.sendError(CAN_ERR_LOSTARB, {5});
  driver.sendError(CAN_ERR_ACK);  // what was sent before it has come when it has
  EXPECT_TRUE(takeUntil([&] { return link.counters().no_acknowledge == 1; }));
  EXPECT_EQ(CanState::kUnknown, link.state());
  EXPECT_EQ(0u, link.counters().bus_errors + link.counters().controller_errors);
}

}  // namespace
}  // namespace nord_driver::link
