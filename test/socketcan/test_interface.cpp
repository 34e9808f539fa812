// An interface that is switched off, switched on, pulled out and plugged in again while the link is open.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/socket_can.h"
#include "socketcan/network.h"

namespace nord_driver::link {
namespace {

using ::testing::HasSubstr;

class SocketCanInterface : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(link.open()) << link.lastError(); }
  void expectTraffic() {
    SocketCan other{bus.settings()};
    ASSERT_TRUE(other.open()) << other.lastError();
    ASSERT_EQ(CanSend::kSent, other.send(numberedFrame(0x1B2, 7)));
    CanFrame got;
    ASSERT_TRUE(next(link, got));
    EXPECT_EQ(numberedFrame(0x1B2, 7), got);
    EXPECT_EQ(CanSend::kSent, link.send(numberedFrame(0x232, 8)));
    ASSERT_TRUE(next(other, got));
    EXPECT_EQ(numberedFrame(0x232, 8), got);
  }

  VcanInterface bus{"nord_vcan"};
  SocketCan link{bus.settings({0x1B2})};
};

TEST_F(SocketCanInterface, DownIsSeenAndUpAgainNeedsNoReopening) {
  ip("link set nord_vcan down");
  EXPECT_TRUE(reaches(link, CanState::kDown));
  EXPECT_TRUE(link.isOpen());
  EXPECT_STREQ("nord_vcan is down: sudo ip link set nord_vcan up", link.advice());
  EXPECT_EQ(CanSend::kFailed, link.send(numberedFrame(0x232, 1)));
  EXPECT_TRUE(link.isOpen());
  EXPECT_FALSE(link.waitReadable(link.now() + std::chrono::milliseconds{1})) << "no error is reported for ever";
  ip("link set nord_vcan up");
  EXPECT_TRUE(reaches(link, CanState::kUnknown));
  EXPECT_STREQ("", link.advice());
  expectTraffic();
}

// Without a wait in between: the send itself finds out.
TEST_F(SocketCanInterface, ASendSeesDownAtOnce) {
  ip("link set nord_vcan down");
  EXPECT_EQ(CanSend::kFailed, link.send(numberedFrame(0x232, 1)));
  EXPECT_EQ(CanState::kDown, link.state());
  ip("link set nord_vcan up");
  SocketCan other{bus.settings()};
  ASSERT_TRUE(other.open()) << other.lastError();
  EXPECT_EQ(CanSend::kSent, link.send(numberedFrame(0x232, 2)));
  // Received before the next one listens: a kernel under load has it under way for a while.
  CanFrame got;
  ASSERT_TRUE(next(other, got));
  EXPECT_EQ(numberedFrame(0x232, 2), got);
  expectTraffic();
}

TEST_F(SocketCanInterface, AnInterfaceThatIsDownCanBeOpened) {
  link.close();
  ip("link set nord_vcan down");
  ASSERT_TRUE(link.open()) << link.lastError();
  EXPECT_EQ(CanState::kDown, link.state());
  ip("link set nord_vcan up");
  EXPECT_TRUE(reaches(link, CanState::kUnknown));
  expectTraffic();
}

TEST_F(SocketCanInterface, RemovedClosesAndTheSameNameOpensAgain) {
  bus.remove();
  EXPECT_FALSE(link.waitReadable(link.now() + kPatience));
  EXPECT_FALSE(link.isOpen());
  EXPECT_EQ("nord_vcan: was removed", link.lastError());
  EXPECT_FALSE(link.open());
  EXPECT_THAT(link.lastError(), HasSubstr("no such interface"));
  bus.add();
  ASSERT_TRUE(link.open()) << link.lastError();
  expectTraffic();
}

TEST_F(SocketCanInterface, ASendSeesTheRemoval) {
  bus.remove();
  EXPECT_EQ(CanSend::kFailed, link.send(numberedFrame(0x232, 1)));
  EXPECT_FALSE(link.isOpen());
}

TEST_F(SocketCanInterface, WhatHappensToOthersDoesNotConcernUs) {
  {
    VcanInterface other{"nord_other"};
    ip("link set nord_other down");
  }
  expectTraffic();
  EXPECT_EQ(CanState::kUnknown, link.state());
}

}  // namespace
}  // namespace nord_driver::link
