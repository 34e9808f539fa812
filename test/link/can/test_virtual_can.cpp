// The virtual bus with real sockets, all ends in this process. A wait has a deadline and ends as soon as it can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <deque>

#include "link/can/can_packet.h"
#include "link/can/virtual_can.h"
#include "link/can/virtual_can_hub.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A bus of this process only.
CanSettings settings(std::vector<std::uint32_t> ids = {}) {
  CanSettings all;
  all.interface = "virtual:test_" + std::to_string(::getpid());
  all.ids = std::move(ids);
  return all;
}

CanFrame frame(std::uint32_t id, std::uint8_t value) {
  return dataFrame(id, std::array<std::uint8_t, 2>{value, 0x5A});
}

class VirtualCanTest : public ::testing::Test {
 protected:
  /// Lets the hub bring round what waits.
  void serve() { hub.waitReadable(hub.now()); }
  /// The hub's owner takes everything; the count.
  int takeAll() {
    int count = 0;
    ReceivedCanFrame received;
    while (hub.receive(received)) ++count;
    return count;
  }
  static bool next(CanLink& link, CanFrame& to) {
    ReceivedCanFrame received;
    if (!link.waitReadable(link.now() + seconds{5}) || !link.receive(received)) return false;
    to = received.frame;
    return true;
  }
  static bool isSilent(CanLink& link) {
    ReceivedCanFrame received;
    return !link.receive(received);
  }

  VirtualCanHub hub{settings()};
  CanFrame got;
};

TEST_F(VirtualCanTest, WithoutABusTheNameIsSaid) {
  VirtualCan link{settings()};
  EXPECT_FALSE(link.open());
  EXPECT_FALSE(link.isOpen());
  EXPECT_THAT(link.lastError(),
              AllOf(HasSubstr(settings().interface), HasSubstr("no such virtual bus: is the simulator running?")));
  EXPECT_EQ(CanSend::kFailed, link.send(frame(1, 1)));
}

TEST_F(VirtualCanTest, EveryFrameComesToAllOthersAndNeverBack) {
  ASSERT_TRUE(hub.open()) << hub.lastError();
  VirtualCan first{settings()}, second{settings()};
  ASSERT_TRUE(first.open()) << first.lastError();
  ASSERT_TRUE(second.open());
  serve();
  EXPECT_EQ(2u, hub.members());
  const CanFrame sent = frame(0x232, 1);
  EXPECT_EQ(CanSend::kSent, first.send(sent));
  ASSERT_TRUE(next(hub, got));
  EXPECT_EQ(sent, got);
  ASSERT_TRUE(next(second, got));
  EXPECT_EQ(sent, got);
  EXPECT_TRUE(isSilent(first));
  const CanFrame answer = frame(0x1B2, 2);
  EXPECT_EQ(CanSend::kSent, hub.send(answer));
  ASSERT_TRUE(next(first, got));
  EXPECT_EQ(answer, got);
  ASSERT_TRUE(next(second, got));
  EXPECT_EQ(answer, got);
  EXPECT_TRUE(isSilent(hub));
}

TEST_F(VirtualCanTest, ExtendedAndRemoteFramesTravel) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings()};
  ASSERT_TRUE(link.open());
  CanFrame extended = frame(0x1234'5678, 3);
  extended.extended = true;
  link.send(remoteFrame(0x732, 1));
  link.send(extended);
  ASSERT_TRUE(next(hub, got));
  EXPECT_EQ(remoteFrame(0x732, 1), got);
  ASSERT_TRUE(next(hub, got));
  EXPECT_EQ(extended, got);
}

// As the kernel's filters: data frames of the identifiers given, nothing else.
TEST_F(VirtualCanTest, AMemberReceivesItsIdentifiersOnly) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings({0x1B2})};
  ASSERT_TRUE(link.open());
  hub.send(frame(0x1B3, 1));
  hub.send(remoteFrame(0x1B2, 2));
  hub.send(frame(0x1B2, 2));
  ASSERT_TRUE(next(link, got));
  EXPECT_EQ(frame(0x1B2, 2), got);
  EXPECT_TRUE(isSilent(link));
  EXPECT_EQ(0u, link.counters().dropped);
}

TEST_F(VirtualCanTest, WaitingEndsAtTheDeadline) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings({0x1B2})};
  ASSERT_TRUE(link.open());
  hub.send(frame(0x1B3, 1));  // wakes, but is not for us
  const Instant until = link.now() + milliseconds{2};
  EXPECT_FALSE(link.waitReadable(until));
  EXPECT_GE(link.now(), until);
  EXPECT_FALSE(hub.waitReadable(hub.now() + milliseconds{2}));
}

TEST_F(VirtualCanTest, ABusThatGoesClosesAndCanBeJoinedAgain) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings()};
  ASSERT_TRUE(link.open());
  serve();
  hub.close();
  EXPECT_FALSE(link.waitReadable(link.now() + seconds{5}));
  EXPECT_FALSE(link.isOpen());
  EXPECT_THAT(link.lastError(), HasSubstr("the virtual bus has gone"));
  EXPECT_FALSE(link.open());
  ASSERT_TRUE(hub.open());
  ASSERT_TRUE(link.open()) << link.lastError();
  hub.send(frame(1, 1));
  EXPECT_TRUE(next(link, got));
  hub.close();
  EXPECT_EQ(CanSend::kFailed, link.send(frame(1, 1)));
  EXPECT_FALSE(link.isOpen());
}

TEST_F(VirtualCanTest, TwoBusesOfOneNameAreRefused) {
  ASSERT_TRUE(hub.open());
  VirtualCanHub second{settings()};
  EXPECT_FALSE(second.open());
  EXPECT_THAT(second.lastError(), HasSubstr("another process has made a virtual bus of this name"));
  hub.close();
  EXPECT_TRUE(second.open());
}

TEST_F(VirtualCanTest, AMemberThatLeavesIsForgotten) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings()};
  ASSERT_TRUE(link.open());
  serve();
  link.send(frame(1, 1));
  link.close();
  ASSERT_TRUE(next(hub, got)) << "what it had sent is not lost";
  serve();
  EXPECT_EQ(0u, hub.members());
  EXPECT_EQ(1u, hub.hubCounters().left);
}

// The hub does not read: the sender sees a full queue, and is woken when there is room.
TEST_F(VirtualCanTest, AFullQueueIsSeenAndWaitedFor) {
  ASSERT_TRUE(hub.open());
  VirtualCan link{settings()};
  ASSERT_TRUE(link.open());
  int sent = 0;
  while (sent < 1000 && link.send(frame(0x100, 0)) == CanSend::kSent) ++sent;
  EXPECT_GE(sent, 40);
  EXPECT_LE(sent, 128) << "old frames must not wait in great numbers";
  EXPECT_EQ(1u, link.counters().queue_full);
  EXPECT_FALSE(link.waitWritable(link.now() + milliseconds{2}));
  EXPECT_EQ(sent, takeAll());
  EXPECT_TRUE(link.waitWritable(link.now() + seconds{5}));
  EXPECT_EQ(CanSend::kSent, link.send(frame(0x100, 0)));
}

// A member that does not read loses frames and knows how many; the others lose none.
TEST_F(VirtualCanTest, AMemberThatReadsLateKnowsWhatItLost) {
  ASSERT_TRUE(hub.open());
  VirtualCan slow{settings()}, quick{settings()};
  ASSERT_TRUE(slow.open());
  ASSERT_TRUE(quick.open());
  serve();
  const int total = 1000;
  for (int i = 0; i < total; ++i) {
    ASSERT_EQ(CanSend::kSent, hub.send(frame(0x100, 0)));
    ASSERT_TRUE(next(quick, got));
  }
  const std::uint64_t lost = hub.counters().dropped;
  EXPECT_GT(lost, 100u);
  EXPECT_LT(lost, 800u);
  int read = 0;
  for (ReceivedCanFrame received; slow.receive(received);) ++read;
  EXPECT_EQ(total - static_cast<int>(lost), read);
  hub.send(frame(0x101, 0));  // its number shows the gap
  ASSERT_TRUE(next(slow, got));
  EXPECT_EQ(lost, slow.counters().dropped);
  EXPECT_EQ(0u, quick.counters().dropped);
}

TEST_F(VirtualCanTest, AStuckMemberIsPartedWith) {
  ASSERT_TRUE(hub.open());
  VirtualCan stuck{settings()};
  ASSERT_TRUE(stuck.open());
  serve();
  for (int i = 0; i < 3000 && hub.members() > 0; ++i) hub.send(frame(0x100, 0));
  EXPECT_EQ(0u, hub.members());
  EXPECT_EQ(1u, hub.hubCounters().stuck);
  EXPECT_EQ(VirtualCanHub::kLostToDisconnect, hub.hubCounters().lost);
  EXPECT_EQ(CanSend::kFailed, stuck.send(frame(1, 1)));
  EXPECT_FALSE(stuck.isOpen());
}

TEST_F(VirtualCanTest, TooManyMembersAreRefused) {
  ASSERT_TRUE(hub.open());
  std::deque<VirtualCan> members;
  for (std::size_t i = 0; i < VirtualCanHub::kMostMembers; ++i) {
    members.emplace_back(settings());
    ASSERT_TRUE(members.back().open());
    serve();
  }
  EXPECT_EQ(VirtualCanHub::kMostMembers, hub.members());
  VirtualCan surplus{settings()};
  ASSERT_TRUE(surplus.open());
  serve();
  EXPECT_EQ(1u, hub.hubCounters().refused);
  EXPECT_FALSE(surplus.waitReadable(surplus.now() + seconds{5}));
  EXPECT_FALSE(surplus.isOpen());
}

// Everybody on this machine can connect: what is no frame is no member.
TEST_F(VirtualCanTest, WhoSendsNonsenseIsPartedWith) {
  ASSERT_TRUE(hub.open());
  VirtualCan good{settings()};
  ASSERT_TRUE(good.open());
  const std::string path = "nord_driver/can/test_" + std::to_string(::getpid());
  for (const std::size_t length : {std::size_t{3}, kCanPacketLength, std::size_t{17}}) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, path.data(), path.size());
    const int raw = ::socket(AF_UNIX, SOCK_SEQPACKET, 0);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + path.size());
    ASSERT_EQ(0, ::connect(raw, reinterpret_cast<sockaddr*>(&address), size));
    const std::array<std::uint8_t, 32> nonsense{};
    ASSERT_EQ(static_cast<ssize_t>(length), ::send(raw, nonsense.data(), length, 0));
    serve();
    ::close(raw);
  }
  EXPECT_EQ(3u, hub.hubCounters().malformed);
  EXPECT_EQ(1u, hub.members());
  EXPECT_TRUE(isSilent(good));
}

// One that sends without end must not keep the others from being heard.
TEST_F(VirtualCanTest, NobodyStarves) {
  ASSERT_TRUE(hub.open());
  VirtualCan loud{settings()}, quiet{settings()};
  ASSERT_TRUE(loud.open());
  ASSERT_TRUE(quiet.open());
  for (int i = 0; i < 20; ++i) loud.send(frame(0x100, 0));
  quiet.send(frame(0x200, 0));
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(next(hub, got));
    if (got.id == 0x200) return;
  }
  FAIL() << "not among the first three";
}

}  // namespace
}  // namespace nord_driver::link
