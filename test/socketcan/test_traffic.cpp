// SocketCan on the kernel's own vcan: what is sent, received, filtered, lost and stamped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/can_interface.h"
#include "link/can/make_can_link.h"
#include "link/can/socket_can.h"
#include "socketcan/network.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class SocketCanTraffic : public ::testing::Test {
 protected:
  VcanInterface bus{"nord_vcan"};
  CanFrame got;
};

// The machine has vcan0 up before anything runs: what the rostests use.
TEST_F(SocketCanTraffic, TheInterfaceOfTheMachineIsThere) {
  const auto link = makeCanLink(settingsFor("vcan0"));
  ASSERT_TRUE(link->open()) << link->lastError();
  EXPECT_EQ(CanState::kUnknown, link->state());
  EXPECT_STREQ("", link->advice());
}

TEST_F(SocketCanTraffic, FramesOfEveryKindArriveUnchanged) {
  SocketCan sender{bus.settings()}, receiver{bus.settings()};
  ASSERT_TRUE(sender.open()) << sender.lastError();
  ASSERT_TRUE(receiver.open()) << receiver.lastError();
  CanFrame extended = dataFrame(0x1ABC'DEF0, std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  extended.extended = true;
  // BU 0060 p. 96: control word 047Eh to node 50.
  const CanFrame frames[] = {dataFrame(0x232, std::array<std::uint8_t, 4>{0x7E, 0x04, 0x00, 0x00}),
                             dataFrame(0x080, {}), remoteFrame(0x732, 1), extended};
  for (const CanFrame& frame : frames) ASSERT_EQ(CanSend::kSent, sender.send(frame));
  for (const CanFrame& frame : frames) {
    ASSERT_TRUE(next(receiver, got));
    EXPECT_EQ(frame, got);
  }
  ReceivedCanFrame own;
  EXPECT_FALSE(sender.receive(own)) << "what we send does not come back";
}

// Of all that is on the bus exactly the identifiers asked for: no neighbour, no remote or extended frame.
TEST_F(SocketCanTraffic, FiltersAreExact) {
  SocketCan sender{bus.settings()}, receiver{bus.settings({0x732, 0x1B2})};
  ASSERT_TRUE(sender.open());
  ASSERT_TRUE(receiver.open());
  for (std::uint32_t id = 0; id <= kHighestStandardId; ++id) {
    CanFrame extended = numberedFrame(id, 1);
    extended.extended = true;
    ASSERT_EQ(CanSend::kSent, sender.send(extended));
    ASSERT_EQ(CanSend::kSent, sender.send(remoteFrame(id, 1)));
    ASSERT_EQ(CanSend::kSent, sender.send(numberedFrame(id, 2)));
  }
  for (const std::uint32_t id : {0x1B2u, 0x732u}) {
    ASSERT_TRUE(next(receiver, got));
    EXPECT_EQ(numberedFrame(id, 2), got);
  }
  ReceivedCanFrame more;
  EXPECT_FALSE(receiver.receive(more));
  EXPECT_EQ(0u, receiver.counters().dropped);
}

// Another master's guarding: remote frames of the identifiers asked for, and of no other.
TEST_F(SocketCanTraffic, RemoteFramesAreFilteredToo) {
  CanSettings settings = bus.settings({0x732, 0x1B2});
  settings.remote_ids = {0x732};
  SocketCan sender{bus.settings()}, receiver{settings};
  ASSERT_TRUE(sender.open());
  ASSERT_TRUE(receiver.open());
  for (const std::uint32_t id : {0x1B2u, 0x731u, 0x732u, 0x733u}) {
    ASSERT_EQ(CanSend::kSent, sender.send(remoteFrame(id, 1)));
  }
  ASSERT_EQ(CanSend::kSent, sender.send(numberedFrame(0x732, 2)));
  ASSERT_TRUE(next(receiver, got));
  EXPECT_EQ(remoteFrame(0x732, 1), got);
  ASSERT_TRUE(next(receiver, got));
  EXPECT_EQ(numberedFrame(0x732, 2), got);
  ReceivedCanFrame more;
  EXPECT_FALSE(receiver.receive(more));
  ASSERT_EQ(CanSend::kSent, receiver.send(remoteFrame(0x732, 1)));
  EXPECT_FALSE(receiver.receive(more)) << "our own question does not come back";
}

// CAN_RAW_FILTER_MAX; our own limit is the kernel's.
TEST_F(SocketCanTraffic, AsManyFiltersAsTheKernelTakes) {
  BareSocket bare{bus.name()};
  EXPECT_TRUE(bare.takesFilters(kMostCanIds));
  EXPECT_FALSE(bare.takesFilters(kMostCanIds + 1));
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < kMostCanIds; ++id) ids.push_back(id);
  SocketCan link{bus.settings(ids)};
  EXPECT_TRUE(link.open()) << link.lastError();
}

// Every frame of a thousand that nobody reads is either kept or counted.
TEST_F(SocketCanTraffic, WhatIsLostIsCounted) {
  constexpr std::uint32_t kMarker = 0x7FF;
  SocketCan sender{bus.settings()}, receiver{bus.settings({0x181})}, last{bus.settings({kMarker})};
  ASSERT_TRUE(sender.open());
  ASSERT_TRUE(receiver.open());
  ASSERT_TRUE(last.open());
  for (std::uint16_t i = 0; i < 1000; ++i) ASSERT_EQ(CanSend::kSent, sender.send(numberedFrame(0x181, i)));
  // The kernel may deliver later than the sending call returns: what was sent before it has come when it has.
  ASSERT_EQ(CanSend::kSent, sender.send(numberedFrame(kMarker, 0)));
  ASSERT_TRUE(next(last, got));
  const std::uint64_t lost = receiver.counters().dropped;
  EXPECT_GT(lost, 300u);
  std::uint16_t kept = 0;
  for (ReceivedCanFrame received; receiver.receive(received); ++kept) EXPECT_EQ(kept, numberOf(received.frame));
  EXPECT_GT(kept, 250);
  EXPECT_EQ(1000u, kept + lost);
  EXPECT_EQ(lost, receiver.counters().dropped) << "reading loses nothing more";
}

// A frame read late is as old as it is: of when the kernel had it, on the steady clock. The kernel begins to stamp a
// while after it was asked to (net_enable_timestamp() leaves it to a worker); until then a frame is of when it was
// read.
TEST_F(SocketCanTraffic, TheTimeOfAFrameIsThatOfItsArrival) {
  SocketCan sender{bus.settings()}, receiver{bus.settings()};
  ASSERT_TRUE(sender.open());
  ASSERT_TRUE(receiver.open());
  const Instant give_up = receiver.now() + kPatience;
  while (true) {
    const Instant before = receiver.now();
    ASSERT_EQ(CanSend::kSent, sender.send(numberedFrame(0x181, 1)));
    const Instant read_at = receiver.now() + milliseconds{300};
    receiver.sleepUntil(read_at);
    ReceivedCanFrame received;
    ASSERT_TRUE(receiver.receive(received));
    ASSERT_GE(received.at, before - milliseconds{1});
    ASSERT_LE(received.at, receiver.now());
    if (received.at < read_at - milliseconds{100}) return;
    ASSERT_LT(receiver.now(), give_up) << "no frame is stamped";
  }
}

TEST_F(SocketCanTraffic, WhatIsNoCanBusIsRefused) {
  SocketCan loopback{settingsFor("lo")}, nowhere{settingsFor("nord_nowhere")};
  EXPECT_FALSE(loopback.open());
  EXPECT_EQ("lo: is no CAN interface", loopback.lastError());
  EXPECT_FALSE(nowhere.open());
  EXPECT_THAT(nowhere.lastError(), HasSubstr("there is no such interface"));
}

}  // namespace
}  // namespace nord_driver::link
