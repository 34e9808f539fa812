#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/fake_can_system.h"
#include "link/can/socket_can.h"

namespace nord_driver::link {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// BU 0060 p. 96: the answer to the control word at node 50.
const CanFrame kTpdo1 = dataFrame(0x1B2, std::array<std::uint8_t, 4>{0x31, 0x0B, 0x00, 0x00});
const CanFrame kRpdo1 = dataFrame(0x232, std::array<std::uint8_t, 4>{0x7E, 0x04, 0x00, 0x00});

class SocketCanTest : public ::testing::Test {
 protected:
  CanSettings settings() const {
    CanSettings all;
    all.interface = "can0";
    all.ids = {0x732, 0x1B2, 0x0B2, 0x1B2};
    all.remote_ids = {0x733, 0x732, 0x733};
    return all;
  }
  /// How long a wait that finds nothing may last.
  Instant soon() const { return kernel.time + milliseconds{10}; }

  FakeCanSystem kernel;
  SocketCan link{settings(), kernel};
  ReceivedCanFrame received;
};

TEST_F(SocketCanTest, AsksForExactlyItsIdentifiersBeforeItIsBound) {
  ASSERT_TRUE(link.open()) << link.lastError();
  EXPECT_THAT(kernel.filters, ElementsAre(0x0B2, 0x1B2, 0x732));
  EXPECT_THAT(kernel.remote_filters, ElementsAre(0x732, 0x733));
  EXPECT_TRUE(kernel.filtered_before_bind);
  EXPECT_TRUE(kernel.time_stamps);
  EXPECT_EQ(0, kernel.send_buffer);
  EXPECT_EQ(212'992, kernel.receive_buffer);
  // linux/can/error.h: TX time-out, controller, protocol, transceiver, ACK, bus-off, restarted; no lost arbitration.
  EXPECT_EQ(0x17Du, kernel.error_classes);
  EXPECT_EQ(2, kernel.open_descriptors);
  link.close();
  EXPECT_EQ(0, kernel.open_descriptors);
}

TEST_F(SocketCanTest, WithoutIdentifiersEveryFrameIsTaken) {
  CanSettings everything;
  everything.interface = "can0";
  SocketCan other{everything, kernel};
  ASSERT_TRUE(other.open());
  EXPECT_FALSE(kernel.filters_set);
}

TEST_F(SocketCanTest, SendsAndReceives) {
  ASSERT_TRUE(link.open());
  EXPECT_EQ(CanSend::kSent, link.send(kRpdo1));
  EXPECT_THAT(kernel.sent, ElementsAre(kRpdo1));
  EXPECT_FALSE(link.receive(received));
  kernel.arrive(kTpdo1);
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kTpdo1, received.frame);
  EXPECT_FALSE(link.receive(received));
}

// What waitReadable() found is not lost, and comes first.
TEST_F(SocketCanTest, WaitingKeepsTheOrder) {
  ASSERT_TRUE(link.open());
  const CanFrame second = dataFrame(0x732, std::array<std::uint8_t, 1>{0x05});
  kernel.arrive(kTpdo1);
  kernel.arrive(second);
  EXPECT_TRUE(link.waitReadable(soon()));
  EXPECT_TRUE(link.waitReadable(soon()));
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kTpdo1, received.frame);
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(second, received.frame);
}

TEST_F(SocketCanTest, WaitingEndsAtTheDeadline) {
  ASSERT_TRUE(link.open());
  const Instant until = soon();
  EXPECT_FALSE(link.waitReadable(until));
  EXPECT_EQ(until, kernel.time);
  kernel.poll_errors = {EINTR};
  kernel.arrive(kTpdo1);
  EXPECT_TRUE(link.waitReadable(soon()));
}

// An error frame wakes the caller's poll, but is nothing to be received.
TEST_F(SocketCanTest, ErrorFramesAreTakenIn) {
  ASSERT_TRUE(link.open());
  kernel.arriveError(0x020);
  const Instant until = soon();
  EXPECT_FALSE(link.waitReadable(until));
  EXPECT_EQ(until, kernel.time);
  EXPECT_EQ(1u, link.counters().no_acknowledge);
  EXPECT_THAT(link.advice(), HasSubstr("no other node acknowledges"));
  kernel.arriveError(0x004, {0, 0x20});
  kernel.arrive(kTpdo1);
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kTpdo1, received.frame);
  EXPECT_EQ(CanState::kPassive, link.state());
}

// One that comes for each bit must not hold the bus cycle.
TEST_F(SocketCanTest, AFloodOfErrorFramesDoesNotHoldTheCaller) {
  ASSERT_TRUE(link.open());
  for (int i = 0; i < 1000; ++i) kernel.arriveError(0x008);
  EXPECT_FALSE(link.receive(received));
  EXPECT_GT(kernel.arrivals.size(), 900u);
  kernel.arrivals.clear();
}

TEST_F(SocketCanTest, TheKernelsTimeStampCounts) {
  ASSERT_TRUE(link.open());
  kernel.time += seconds{1};
  kernel.arrive(kTpdo1, milliseconds{3});
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kernel.time - milliseconds{3}, received.at);
  kernel.arrive(kTpdo1);  // an interface without
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kernel.time, received.at);
}

// The stamp is of the clock on the wall, which may have been set since: never before the socket was last seen empty,
// never in the future.
TEST_F(SocketCanTest, AClockSetMeanwhileDoesNotMoveTheFrame) {
  ASSERT_TRUE(link.open());
  EXPECT_FALSE(link.receive(received));
  const Instant empty = kernel.time;
  kernel.time += milliseconds{20};
  kernel.arrive(kTpdo1, std::chrono::hours{1});
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(empty, received.at);
  kernel.arrive(kTpdo1, std::chrono::hours{-1});
  ASSERT_TRUE(link.receive(received));
  EXPECT_EQ(kernel.time, received.at);
}

TEST_F(SocketCanTest, LostFramesAreCountedAcrossReopening) {
  ASSERT_TRUE(link.open());
  kernel.drop_count = 722;
  EXPECT_EQ(722u, link.counters().dropped);
  EXPECT_EQ(722u, link.counters().dropped);
  kernel.drop_count = 730;
  link.close();
  kernel.drop_count = 0;  // a new socket's
  ASSERT_TRUE(link.open());
  kernel.drop_count = 5;
  EXPECT_EQ(735u, link.counters().dropped);
}

TEST_F(SocketCanTest, AFullQueueIsNoFailure) {
  ASSERT_TRUE(link.open());
  kernel.send_errors = {EAGAIN, ENOBUFS, EINTR};
  EXPECT_EQ(CanSend::kQueueFull, link.send(kRpdo1));
  EXPECT_EQ(CanSend::kQueueFull, link.send(kRpdo1));
  EXPECT_TRUE(link.isOpen());
  EXPECT_EQ(2u, link.counters().queue_full);
  EXPECT_EQ(CanSend::kSent, link.send(kRpdo1));
  EXPECT_EQ(1u, kernel.sent.size());
}

TEST_F(SocketCanTest, WaitsForRoomToSend) {
  ASSERT_TRUE(link.open());
  kernel.send_errors = {EAGAIN};
  EXPECT_EQ(CanSend::kQueueFull, link.send(kRpdo1));
  kernel.has_room = false;
  const Instant until = soon();
  EXPECT_FALSE(link.waitWritable(until));
  EXPECT_EQ(until, kernel.time);
  kernel.has_room = true;
  EXPECT_TRUE(link.waitWritable(soon()));
}

// After ENOBUFS the socket itself has room: poll() would return at once, for ever.
TEST_F(SocketCanTest, AFullQueueOfTheInterfaceIsNotPolled) {
  ASSERT_TRUE(link.open());
  kernel.send_errors = {ENOBUFS, ENOBUFS};
  const Instant begin = kernel.time;
  EXPECT_EQ(CanSend::kQueueFull, link.send(kRpdo1));
  EXPECT_TRUE(link.waitWritable(soon()));
  EXPECT_EQ(begin + SocketCan::kQueueRetry, kernel.time);
  EXPECT_EQ(CanSend::kQueueFull, link.send(kRpdo1));
  const Instant until = kernel.time + microseconds{100};
  EXPECT_FALSE(link.waitWritable(until));
  EXPECT_EQ(until, kernel.time);
  EXPECT_EQ(0, kernel.polls);
}

TEST_F(SocketCanTest, AClosedLinkDoesNothing) {
  EXPECT_EQ(CanSend::kFailed, link.send(kRpdo1));
  EXPECT_FALSE(link.receive(received));
  EXPECT_FALSE(link.waitReadable(soon()));
  EXPECT_FALSE(link.waitWritable(soon()));
  EXPECT_STREQ("", link.advice());
  EXPECT_THAT(kernel.sent, IsEmpty());
}

}  // namespace
}  // namespace nord_driver::link
