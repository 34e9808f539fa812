// A pair of virtual interfaces with a token bucket between them imitates a bus slower than the sender.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "link/can/socket_can.h"
#include "socketcan/network.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;

/// 100 frames a second: the kernel books 16 bytes each.
constexpr const char* kRate = "rate 12800bit burst 16";
constexpr milliseconds kFrame{10};
/// The smallest send buffer holds eight; the bucket and the pair itself one or two more.
constexpr int kMostOnTheirWay = 12;

class SocketCanSlowBus : public ::testing::Test {
 protected:
  SocketCanSlowBus() {
    ip("link add dev nord_near type vxcan peer name nord_far");
    ip("link set nord_near up");
    ip("link set nord_far up");
  }
  ~SocketCanSlowBus() override { ip("link del nord_near"); }

  void slowDown(const std::string& queue) {
    tc("qdisc add dev nord_near root tbf " + std::string(kRate) + " " + queue);
  }
  /// What was sent until the queue was full, and what left meanwhile: a slow machine takes its time.
  struct Filled {
    int sent = 0;
    int most_left = 0;
  };
  Filled fill() {
    Filled filled;
    const Instant begin = link.now();
    while (filled.sent < 1000 &&
           link.send(numberedFrame(0x232, static_cast<std::uint16_t>(filled.sent))) == CanSend::kSent) {
      ++filled.sent;
    }
    filled.most_left = static_cast<int>((link.now() - begin) / kFrame) + 1;
    return filled;
  }

  SocketCan link{settingsFor("nord_near")};
  SocketCan far{settingsFor("nord_far")};
};

// With room for many in the queue of the interface our own small buffer is what fills: poll() wakes us.
TEST_F(SocketCanSlowBus, AFullBufferIsSeenAndPollWakes) {
  slowDown("limit 16000");
  ASSERT_TRUE(link.open()) << link.lastError();
  ASSERT_TRUE(far.open()) << far.lastError();
  const Filled filled = fill();
  EXPECT_GE(filled.sent, 4);
  EXPECT_LE(filled.sent, kMostOnTheirWay + filled.most_left);
  EXPECT_EQ(1u, link.counters().queue_full);
  EXPECT_TRUE(link.isOpen());
  EXPECT_FALSE(link.waitWritable(link.now() + milliseconds{1}));
  ASSERT_TRUE(link.waitWritable(link.now() + kPatience));
  EXPECT_EQ(CanSend::kSent, link.send(numberedFrame(0x232, 99)));
}

// ENOBUFS: the queue of the interface is full before our buffer is, and poll() would say "go on" for ever.
TEST_F(SocketCanSlowBus, AFullInterfaceIsSeenAndNotPolledWithoutEnd) {
  slowDown("limit 32");
  ASSERT_TRUE(link.open());
  ASSERT_TRUE(far.open());
  const Filled filled = fill();
  EXPECT_LE(filled.sent, 4 + filled.most_left);
  int tries = 0;
  const Instant end = link.now() + kPatience;
  const Instant begin = link.now();
  while (link.now() < end && link.send(numberedFrame(0x232, 99)) != CanSend::kSent) {
    link.waitWritable(end);
    ++tries;
  }
  EXPECT_LT(link.now(), end);
  EXPECT_LE(tries, (link.now() - begin) / SocketCan::kQueueRetry + 1) << "that would be spinning";
}

// One that always sends its newest value and drops it when there is no room: what arrives is never older than the few
// frames on their way, however long the bus was too slow.
TEST_F(SocketCanSlowBus, NothingOldLeavesAfterAStall) {
  slowDown("limit 16000");
  ASSERT_TRUE(link.open());
  ASSERT_TRUE(far.open());
  const Instant give_up = link.now() + kPatience;
  std::uint16_t newest = 0;
  int sent = 0;
  int received = 0;
  ReceivedCanFrame frame;
  while (link.now() < give_up && (received < 50 || sent == newest)) {  // a cycle of 1 ms: ten times too fast
    ++newest;
    if (link.send(numberedFrame(0x232, newest)) == CanSend::kSent) ++sent;
    link.sleepUntil(link.now() + milliseconds{1});
    while (far.receive(frame)) ++received;
  }
  EXPECT_GE(received, 50);
  EXPECT_LT(sent, newest) << "the bus was never too slow: nothing was tried";
  EXPECT_LE(sent - received, kMostOnTheirWay);
}

}  // namespace
}  // namespace nord_driver::link
