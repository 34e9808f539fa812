// Who is taken for somebody that works with the bus, and how long nothing is sent.
#include <gtest/gtest.h>

#include "transport/canopen/canopen_listening.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

constexpr Instant kStart{std::chrono::seconds{1000}};

struct Listener {
  Listener() { listen.restart(kStart); }
  bool mayTalkAfter(milliseconds time) { return listen.mayTalk(kStart + time); }

  CanListenFirst listen{kCanopenListening, milliseconds{500}};
};

CanFrame state(std::uint32_t id, std::uint8_t value) {
  return dataFrame(id, ByteView{FixedBytes<1>{value}});
}

// A node that nobody works with sends its boot-up, heartbeats and emergencies (CiA 301 7.2.7, 7.2.8.3.2).
TEST(CanListenFirst, NodesNobodyWorksWithMayBeHeard) {
  Listener listener;
  for (const CanFrame& frame : {state(0x703, 0x00), state(0x703, 0x7F), state(0x77F, 0x04),
                                dataFrame(0x083, ByteView{FixedBytes<8>{0x00, 0x10, 1, 0, 0, 0, 0, 0}})}) {
    EXPECT_FALSE(showsCanopenMaster(frame)) << frame.id;
    listener.listen.handle(frame);
  }
  EXPECT_FALSE(listener.mayTalkAfter(milliseconds{499}));
  EXPECT_TRUE(listener.mayTalkAfter(milliseconds{500}));
  EXPECT_TRUE(listener.listen.text().empty());
}

// Process data, SDO, NMT, SYNC, TIME, guarding and its answers, a node that is operational, and what is no CANopen.
TEST(CanListenFirst, EverythingElseIsSomebodyElse) {
  CanFrame extended = state(0x703, 0x7F);
  extended.extended = true;
  const CanFrame frames[] = {dataFrame(0x203, ByteView{FixedBytes<4>{0x7E, 0x04, 0, 0}}),
                             dataFrame(0x183, ByteView{FixedBytes<4>{0x31, 0x0B, 0, 0}}),
                             dataFrame(0x603, ByteView{FixedBytes<8>{0x40, 0x00, 0x10, 0, 0, 0, 0, 0}}),
                             dataFrame(0x583, ByteView{FixedBytes<8>{0x43, 0x00, 0x10, 0, 0, 0, 0, 0}}),
                             dataFrame(0x000, ByteView{FixedBytes<2>{0x01, 0x03}}),
                             dataFrame(0x080, ByteView{}),
                             dataFrame(0x100, ByteView{FixedBytes<6>{0, 0, 0, 0, 0, 0}}),
                             remoteFrame(0x703, 1),
                             state(0x703, 0xFF),  // pre-operational with the toggle bit
                             state(0x703, 0x05),
                             state(0x700, 0x7F),
                             dataFrame(0x703, ByteView{FixedBytes<2>{0x7F, 0x00}}),
                             dataFrame(0x083, ByteView{FixedBytes<2>{0x00, 0x10}}),
                             extended};
  for (const CanFrame& frame : frames) {
    EXPECT_TRUE(showsCanopenMaster(frame)) << frame.id;
    Listener listener;
    listener.listen.handle(frame);
    EXPECT_EQ(frame.id, listener.listen.heard());
    EXPECT_FALSE(listener.mayTalkAfter(std::chrono::hours{1})) << frame.id;
    EXPECT_TRUE(listener.listen.isSilent());
    EXPECT_FALSE(listener.listen.nextDeadline().has_value());
  }
}

TEST(CanListenFirst, NamesTheIdentifierSeenFirst) {
  Listener listener;
  EXPECT_STREQ("listens for others on the bus before anything is sent", listener.listen.text().c_str());
  listener.listen.handle(dataFrame(0x003, ByteView{}));
  listener.listen.handle(dataFrame(0x203, ByteView{}));
  EXPECT_STREQ(
      "the bus is in use: 003h was seen; nothing is sent beside another master, nor to nodes that one has left "
      "operational: end it, or switch them off and on",
      listener.listen.text().c_str());
}

// What came before listening was over is looked at first, however late somebody looks.
TEST(CanListenFirst, ALateLookMissesNobody) {
  Listener listener;
  listener.listen.handle(dataFrame(0x203, ByteView{}));
  EXPECT_FALSE(listener.mayTalkAfter(milliseconds{2000}));
}

// Later on the answers to our own questions are on the bus; only what a master sends counts then.
TEST(CanListenFirst, AMasterThatComesLaterEndsIt) {
  Listener listener;
  ASSERT_TRUE(listener.mayTalkAfter(milliseconds{500}));
  listener.listen.handle(dataFrame(0x583, ByteView{}));
  EXPECT_TRUE(listener.mayTalkAfter(milliseconds{600}));
  listener.listen.handleMaster(0x000, kStart + milliseconds{650});
  EXPECT_FALSE(listener.mayTalkAfter(milliseconds{700}));
  EXPECT_EQ(0x000u, listener.listen.heard());
}

// A driver waits until the other master has been silent for two seconds, and from then on the nodes are its own.
TEST(CanListenFirst, ADriverWaitsUntilTheOtherHasEnded) {
  CanListenFirst listen{kCanopenListening, milliseconds{500}, CanListener::kDriver};
  listen.restart(kStart);
  EXPECT_FALSE(listen.mayTalk(kStart + milliseconds{499}));
  listen.handleMaster(0x203, kStart + milliseconds{499});
  EXPECT_FALSE(listen.mayTalk(kStart + milliseconds{600}));
  listen.handleMaster(0x000, kStart + milliseconds{1000});
  EXPECT_STREQ("another master works with these nodes: 000h was seen; nothing is sent until it has been silent for 2 s",
               listen.text().c_str());
  EXPECT_EQ(kStart + milliseconds{3000}, listen.nextDeadline());
  EXPECT_FALSE(listen.mayTalk(kStart + milliseconds{2999}));
  EXPECT_TRUE(listen.mayTalk(kStart + milliseconds{3000}));
  EXPECT_TRUE(listen.text().empty());
  listen.handleMaster(0x203, kStart + milliseconds{3500});
  EXPECT_TRUE(listen.mayTalk(kStart + milliseconds{3500}));
  EXPECT_FALSE(listen.nextDeadline().has_value());
}

// An interface that is down says nothing about the bus.
TEST(CanListenFirst, TimeInWhichNobodyCanBeHeardDoesNotCount) {
  Listener listener;
  listener.listen.postpone(kStart + milliseconds{400});
  EXPECT_FALSE(listener.mayTalkAfter(milliseconds{899}));
  EXPECT_TRUE(listener.mayTalkAfter(milliseconds{900}));
  listener.listen.postpone(kStart + milliseconds{950});
  EXPECT_TRUE(listener.mayTalkAfter(milliseconds{951})) << "it talks already";

  CanListenFirst driver{kCanopenListening, milliseconds{500}, CanListener::kDriver};
  driver.restart(kStart);
  driver.handleMaster(0x203, kStart);
  driver.postpone(kStart + milliseconds{1000});
  EXPECT_FALSE(driver.mayTalk(kStart + milliseconds{2999}));
  EXPECT_TRUE(driver.mayTalk(kStart + milliseconds{3000}));
}

// A driver that has only waited has not had the nodes; one that talks goes on, since its drives may turn.
TEST(CanListenFirst, ADriverThatIsSilentStaysSoWhenTheInterfaceIsBack) {
  CanListenFirst alone{kCanopenListening, milliseconds{500}, CanListener::kDriver};
  CanListenFirst waits = alone;
  for (CanListenFirst* const listen : {&alone, &waits}) listen->restart(kStart);
  waits.handleMaster(0x203, kStart + milliseconds{100});
  for (CanListenFirst* const listen : {&alone, &waits}) listen->restart(kStart + milliseconds{4000});
  EXPECT_FALSE(alone.mayTalk(kStart + milliseconds{4499}));
  EXPECT_FALSE(waits.mayTalk(kStart + milliseconds{5999})) << "the other one need not be heard more often";
  EXPECT_EQ(0x203u, waits.heard());
  for (CanListenFirst* const listen : {&alone, &waits}) {
    EXPECT_TRUE(listen->mayTalk(kStart + milliseconds{6000}));
    listen->restart(kStart + milliseconds{9000});
    EXPECT_TRUE(listen->mayTalk(kStart + milliseconds{9000}));
  }
}

// The interface was opened anew.
TEST(CanListenFirst, ListensAnewAfterARestart) {
  Listener listener;
  listener.listen.handle(dataFrame(0x203, ByteView{}));
  listener.listen.restart(kStart + milliseconds{1000});
  EXPECT_EQ(kStart + milliseconds{1500}, listener.listen.nextDeadline());
  EXPECT_FALSE(listener.mayTalkAfter(milliseconds{1400}));
  EXPECT_TRUE(listener.mayTalkAfter(milliseconds{1500}));
}

// What a node sends by itself that somebody left operational keeps nobody off who was asked to set it free; what only a
// master makes it send does, and a drive that runs.
TEST(CanListenFirst, NodesLeftOperationalAreToldFromThoseOfAMaster) {
  for (const CanFrame& left :
       {state(0x703, 0x05), state(0x703, 0x7F), dataFrame(0x183, ByteView{FixedBytes<4>{0x31, 0x0B, 0, 0}}),
        dataFrame(0x283, ByteView{FixedBytes<8>{0x21, 0x0B, 0, 0, 0, 0, 0, 0}}),
        dataFrame(0x083, ByteView{FixedBytes<8>{0x00, 0x10, 1, 0, 0, 0, 0, 0}})}) {
    EXPECT_FALSE(showsCanopenMasterOrMotion(left)) << left.id;
  }
  for (const CanFrame& kept :
       {dataFrame(0x183, ByteView{FixedBytes<4>{0x37, 0x0B, 0, 0x20}}),
        dataFrame(0x183, ByteView{FixedBytes<4>{0x17, 0x0B, 0, 0x20}}),  // quick stop active: on its ramp
        dataFrame(0x183, ByteView{FixedBytes<4>{0x0F, 0x0B, 0, 0x20}}),  // fault reaction active
        state(0x703, 0x85), remoteFrame(0x703, 1), dataFrame(0x000, ByteView{FixedBytes<2>{0x01, 0x03}}),
        dataFrame(0x080, ByteView{}), dataFrame(0x203, ByteView{FixedBytes<4>{0x7E, 0x04, 0, 0}}),
        dataFrame(0x603, ByteView{FixedBytes<8>{0x40, 0x00, 0x10, 0, 0, 0, 0, 0}}),
        dataFrame(0x583, ByteView{FixedBytes<8>{0x43, 0x00, 0x10, 0, 0, 0, 0, 0}})}) {
    EXPECT_TRUE(showsCanopenMasterOrMotion(kept)) << kept.id;
  }
}

}  // namespace
}  // namespace nord_driver
