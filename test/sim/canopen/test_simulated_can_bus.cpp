#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

using link::CanSend;
using link::CanState;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using Frames = std::vector<std::string>;

// 47 bits and eight for each data byte (ISO 11898-1, without stuff bits); 4 us a bit at 250 kbit/s.
TEST(SimulatedCanBus, FramesTakeTheirTime) {
  CanConversation bus;
  bus.boot();
  std::vector<Instant> ends;
  bus.bus.setTap([&](const CanFrame&, SimulatedCanBus::Sender, Instant at) { ends.push_back(at); });
  const Instant start = bus.bus.now();
  bus.send("732#R1");
  ASSERT_TRUE(bus.bus.waitReadable(start + seconds(1.0)));
  ASSERT_EQ(2u, ends.size());
  EXPECT_EQ(microseconds{47 * 4}, ends[0] - start);
  EXPECT_EQ(microseconds{(47 + 8) * 4}, ends[1] - ends[0]);
  link::ReceivedCanFrame received;
  ASSERT_TRUE(bus.bus.receive(received));
  EXPECT_EQ(ends[1], received.at);
}

TEST(SimulatedCanBus, WaitsInNoTime) {
  CanConversation bus;
  bus.boot();
  const Instant start = bus.bus.now();
  EXPECT_FALSE(bus.bus.waitReadable(start + seconds(60.0)));
  EXPECT_EQ(seconds(60.0), bus.bus.now() - start);
}

// Of what is ready at the same time the lowest identifier is first; what one interface sends stays in its order.
TEST(SimulatedCanBus, LowestIdentifierWins) {
  CanConversation bus;
  bus.boot();
  Frames order;
  bus.bus.setTap(
      [&](const CanFrame& frame, SimulatedCanBus::Sender, Instant) { order.push_back(nord_driver::text(frame)); });
  bus.send("000#8032");
  bus.send("632#4001100000000000");
  bus.bus.inject(nord_driver::frame("701#05"));
  bus.bus.inject(nord_driver::frame("0A0#01"));
  bus.send("080#");
  bus.bus.run(milliseconds(3));
  EXPECT_EQ((Frames{"000#8032", "0A0#01", "632#4001100000000000", "080#", "701#05", "5B2#4F01100000000000"}), order);
  EXPECT_EQ((Frames{"0A0#01", "701#05", "5B2#4F01100000000000"}), bus.take());
}

// A full queue is said and counted; it empties with the bus.
TEST(SimulatedCanBus, QueueFull) {
  CanConversation bus;
  bus.boot();
  const CanFrame frame = nord_driver::frame("701#05");
  for (int i = 0; i < 8; ++i) EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
  EXPECT_EQ(CanSend::kQueueFull, bus.bus.send(frame));
  bus.bus.run(milliseconds(5));
  EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
  bus.bus.setQueueFull(true);
  EXPECT_EQ(CanSend::kQueueFull, bus.bus.send(frame));
  EXPECT_EQ(2u, bus.bus.counters().queue_full);
  bus.bus.setQueueFull(false);
  EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
}

TEST(SimulatedCanBus, QueueThatEmptiesSlowly) {
  CanConversation bus;
  bus.boot();
  const CanFrame frame = nord_driver::frame("701#05");
  bus.bus.setQueuePace(milliseconds(20));
  EXPECT_EQ(CanSend::kQueueFull, bus.bus.send(frame));
  bus.bus.run(milliseconds(20));
  EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
  bus.bus.run(milliseconds(19));
  EXPECT_EQ(CanSend::kQueueFull, bus.bus.send(frame));
  bus.bus.run(milliseconds(1));
  EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
  bus.bus.setQueuePace({});
  EXPECT_EQ(CanSend::kSent, bus.bus.send(frame));
}

// Nobody acknowledges: the controller repeats the frame for ever, becomes error passive, the queue fills. It goes out
// when a node is there again.
TEST(SimulatedCanBus, NobodyAcknowledges) {
  CanConversation bus;
  bus.boot();
  bus.drive().setPlugged(false);
  bus.bus.run(milliseconds(5));
  for (int i = 0; i < 9; ++i) bus.send("732#R1");
  bus.bus.run(milliseconds(100));
  EXPECT_EQ(CanState::kPassive, bus.bus.state());
  EXPECT_LT(100u, bus.bus.counters().no_acknowledge);
  EXPECT_STREQ("no other node acknowledges: are the drives powered and is the bus terminated?", bus.bus.advice());
  for (int i = 0; i < 8; ++i) bus.send("732#R1");
  EXPECT_EQ(CanSend::kQueueFull, bus.bus.send(nord_driver::frame("732#R1")));
  bus.drive().setPlugged(true);
  bus.bus.run(milliseconds(50));
  EXPECT_EQ(CanState::kActive, bus.bus.state());
  EXPECT_STREQ("", bus.bus.advice());
}

TEST(SimulatedCanBus, BusOffAndRestart) {
  CanConversation bus;
  bus.boot();
  bus.send("732#R1");
  bus.bus.setBusOff();
  EXPECT_EQ(CanState::kBusOff, bus.bus.state());
  EXPECT_TRUE(bus.bus.isOpen());
  EXPECT_EQ(CanSend::kFailed, bus.bus.send(nord_driver::frame("732#R1")));
  EXPECT_EQ(Frames{}, bus.takeAfter(milliseconds(20))) << "what waited is lost";
  bus.bus.restart();
  EXPECT_EQ("732#7F", bus.ask("732#R1"));
  EXPECT_EQ(1u, bus.bus.counters().bus_off);
  EXPECT_EQ(1u, bus.bus.counters().restarts);
}

// Down: open, but nothing goes. Removed: closed, and no open() until it is back.
TEST(SimulatedCanBus, InterfaceDownAndRemoved) {
  CanConversation bus;
  bus.boot();
  bus.bus.setInterfaceUp(false);
  EXPECT_EQ(CanState::kDown, bus.bus.state());
  EXPECT_TRUE(bus.bus.isOpen());
  EXPECT_EQ(CanSend::kFailed, bus.bus.send(nord_driver::frame("732#R1")));
  bus.bus.setInterfaceUp(true);
  EXPECT_EQ("732#7F", bus.ask("732#R1"));
  bus.bus.setInterfacePresent(false);
  EXPECT_FALSE(bus.bus.isOpen());
  EXPECT_EQ("simulated CAN bus: the interface is gone", bus.bus.lastError());
  EXPECT_FALSE(bus.bus.open());
  bus.bus.setInterfacePresent(true);
  EXPECT_TRUE(bus.bus.open());
  EXPECT_EQ("732#FF", bus.ask("732#R1"));
}

// Receive overflow: the frames are gone, the counter tells.
TEST(SimulatedCanBus, Overflow) {
  CanConversation bus;
  bus.boot();
  bus.bus.overflow(1);
  EXPECT_EQ("", bus.ask("732#R1"));
  EXPECT_EQ(1u, bus.bus.counters().dropped);
  CanBusSettings small;
  small.receive_queue = 4;
  CanConversation slow{oneCanDrive(), small};
  slow.boot();
  slow.sdo("2B 17 10 00 01 00 00 00");  // a heartbeat every millisecond
  slow.bus.run(milliseconds(20));
  EXPECT_EQ(4u, slow.take().size());
  EXPECT_LT(10u, slow.bus.counters().dropped);
}

TEST(SimulatedCanBus, LostFrames) {
  CanConversation bus;
  bus.boot();
  bus.bus.loseRequests(1);
  EXPECT_EQ("", bus.ask("732#R1"));
  bus.bus.loseAnswers(1);
  EXPECT_EQ("", bus.ask("732#R1"));
  EXPECT_EQ("732#FF", bus.ask("732#R1"));
}

// A turned bit is an error frame: everybody drops it, it is sent again and arrives all the same. Repeatable by its
// seed.
TEST(SimulatedCanBus, DisturbsRepeatably) {
  CanDisturbance noise;
  noise.error = noise.duplicate = noise.lose = 0.1;
  Frames runs[2];
  for (Frames& run : runs) {
    CanConversation bus;
    bus.boot();
    bus.bus.setDisturbance(noise);
    for (int i = 0; i < 200; ++i) {
      bus.send("732#R1");
      for (const std::string& text : bus.takeAfter(milliseconds(3))) run.push_back(text);
    }
    EXPECT_LT(10u, bus.bus.counters().bus_errors);
    EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  }
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_LT(150u, runs[0].size());
  CanDisturbance errors;
  errors.error = 0.3;
  CanConversation bus;
  bus.boot();
  bus.bus.setDisturbance(errors);
  for (int i = 0; i < 100; ++i) EXPECT_NE("", bus.ask("732#R1"));
}

// An adapter on USB hands over what it has received when it likes.
TEST(SimulatedCanBus, ALateFrameIsOvertaken) {
  CanConversation bus;
  bus.boot();
  CanDisturbance late;
  late.late = 1.0;
  bus.bus.setDisturbance(late);
  bus.bus.inject(nord_driver::frame("101#01"));
  EXPECT_EQ(Frames{}, bus.takeAfter(milliseconds(3)));
  bus.bus.setDisturbance({});
  bus.bus.inject(nord_driver::frame("102#02"));
  EXPECT_EQ((Frames{"102#02", "101#01"}), bus.takeAfter(milliseconds(5)));
}

// What others send concerns the nodes, never the referee: a stranger's SDO, a remote frame, 29 bits.
TEST(SimulatedCanBus, ForeignFrames) {
  CanConversation bus;
  bus.boot();
  bus.bus.inject(nord_driver::frame("632#4001100000000000"));
  EXPECT_EQ((Frames{"632#4001100000000000", "5B2#4F01100000000000"}), bus.takeAfter(milliseconds(20)));
  CanFrame extended = nord_driver::frame("632#40");
  extended.extended = true;
  extended.id = 0x18FF1234;
  bus.bus.inject(extended);
  bus.bus.run(milliseconds(5));
  link::ReceivedCanFrame received;
  ASSERT_TRUE(bus.bus.receive(received));
  EXPECT_EQ(extended, received.frame);
  EXPECT_TRUE(bus.referee().content());
}

}  // namespace
}  // namespace nord_driver::sim
