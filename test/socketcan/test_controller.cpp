// A driver of a real controller (SJA1000 on kvaser_pci, emulated): what only such an interface has. The emulated
// machine has two of them on one bus; where there are none, these tests are skipped.
#include <errno.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/can_system.h"
#include "link/can/socket_can.h"
#include "socketcan/network.h"

namespace nord_driver::link {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SocketCanController : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!exists("can0") || !exists("can1")) GTEST_SKIP() << "no controller in this machine";
    ip("link set can0 down");
    ip("link set can1 down");
    ip("link set can0 type can bitrate 500000 restart-ms 0 listen-only off");
    ip("link set can1 type can bitrate 500000 restart-ms 0 listen-only off");
  }
  static void up() {
    ip("link set can0 up");
    ip("link set can1 up");
  }
  static CanSettings at(std::uint32_t bit_rate) {
    CanSettings settings = settingsFor("can0");
    settings.bit_rate = bit_rate;
    return settings;
  }
};

TEST_F(SocketCanController, TellsItsBitRateAndState) {
  up();
  CanInterface interface;
  ASSERT_EQ(0, linuxCanSystem().readInterface("can0", interface));
  EXPECT_STREQ("can", interface.kind.c_str());
  EXPECT_TRUE(interface.is_can);
  EXPECT_TRUE(interface.up);
  EXPECT_TRUE(interface.has_controller);
  EXPECT_FALSE(interface.listen_only);
  EXPECT_EQ(500'000u, interface.bit_rate);
  EXPECT_EQ(0u, interface.restart_ms);
  EXPECT_EQ(CanState::kActive, interface.state);
}

TEST_F(SocketCanController, FramesPassOverTheBus) {
  up();
  SocketCan here{at(500'000)}, there{settingsFor("can1", {0x1B2})};
  ASSERT_TRUE(here.open()) << here.lastError();
  ASSERT_TRUE(there.open()) << there.lastError();
  EXPECT_EQ(CanState::kActive, here.state());
  CanFrame got;
  for (std::uint16_t i = 0; i < 50; ++i) {
    ASSERT_EQ(CanSend::kSent, here.send(numberedFrame(0x1B2, i)));
    ASSERT_TRUE(next(there, got));
    ASSERT_EQ(numberedFrame(0x1B2, i), got);
  }
}

TEST_F(SocketCanController, AnotherBitRateIsRefusedInWords) {
  up();
  SocketCan link{at(250'000)};
  EXPECT_FALSE(link.open());
  EXPECT_THAT(link.lastError(), HasSubstr("can0: runs at 500000 bit/s, and 250000 bit/s are configured"));
}

// The rate can only be changed while it is down, so it is looked at when it comes back.
TEST_F(SocketCanController, ABitRateChangedMeanwhileIsRefused) {
  up();
  SocketCan link{at(500'000)};
  ASSERT_TRUE(link.open()) << link.lastError();
  ip("link set can0 down");
  EXPECT_TRUE(reaches(link, CanState::kDown));
  ip("link set can0 up type can bitrate 125000");
  EXPECT_FALSE(link.waitReadable(link.now() + kPatience));
  EXPECT_FALSE(link.isOpen());
  EXPECT_THAT(link.lastError(), HasSubstr("runs at 125000 bit/s"));
}

TEST_F(SocketCanController, ListenOnlyIsRefusedInWords) {
  ip("link set can0 type can listen-only on");
  up();
  SocketCan link{at(500'000)};
  EXPECT_FALSE(link.open());
  EXPECT_THAT(link.lastError(), AllOf(HasSubstr("listens only"), HasSubstr("listen-only off")));
}

TEST_F(SocketCanController, DownAndUpAgain) {
  SocketCan link{at(500'000)};
  ASSERT_TRUE(link.open()) << link.lastError();
  EXPECT_EQ(CanState::kDown, link.state());
  up();
  EXPECT_TRUE(reaches(link, CanState::kActive));
  ip("link set can0 down");
  EXPECT_TRUE(reaches(link, CanState::kDown));
}

// The kernel's own answers to a request to restart: EBUSY when it is not bus-off, EINVAL when restart-ms does it. The
// request is understood, then.
TEST_F(SocketCanController, ARestartIsAskedForInTheKernelsWords) {
  up();
  CanInterface interface;
  ASSERT_EQ(0, linuxCanSystem().readInterface("can0", interface));
  EXPECT_EQ(-EBUSY, linuxCanSystem().restart(interface.index));
  ip("link set can0 down");
  ip("link set can0 up type can restart-ms 100");
  ASSERT_EQ(0, linuxCanSystem().readInterface("can0", interface));
  EXPECT_EQ(100u, interface.restart_ms);
  EXPECT_EQ(-EINVAL, linuxCanSystem().restart(interface.index));
}

}  // namespace
}  // namespace nord_driver::link
