#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"
#include "sim/devicenet/dn_conversation.h"
#include "sim/profibus/conversation.h"
#include "support/count_allocations.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

// From its construction on the simulated segment takes no memory: start-up, exchange, parameters, faults, an unplugged
// station, its return and disturbed bytes included. A driver's own measurement of its cycle may rely on it.

TEST(NoAllocation, AfterConstruction) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  SimConfig config = oneDrive();
  config.body = BodyConfig{{0}, {0}, 0.1, 0.5};
  Conversation bus{config};
  std::vector<std::vector<std::uint8_t>> requests;
  requests.push_back(Conversation::variable(0x88, 0x81, 0x6D, fromHex("3C 3E")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x5D, fromHex("3D 3E 88 0A 01 0B 75 31 00")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x7D, fromHex("3E 3E F3 F1")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x5D, fromHex("3C 3E")));
  const char* const exchanges[] = {"0000000000000000 047E 0000", "744E0200000003E8 047F 2000",
                                   "7FCE0200000003E8 047F 2000", "0000000000000000 047F 2000"};
  unsigned code = 0x7D;
  for (const char* data : exchanges) {
    requests.push_back(Conversation::variable(0x08, 0x01, code, fromHex(data)));
    code ^= 0x20u;
  }
  Disturbance noise;
  noise.flip = noise.lose = noise.duplicate = 0.01;
  std::size_t received = 0;

  test::allocations = 0;
  test::countThisThread(true);
  for (int round = 0; round < 20; ++round) {
    if (round == 10) bus.segment.setDisturbance(noise);
    for (const auto& request : requests) {
      bus.segment.run(milliseconds(1));
      bus.segment.write(request);
      const Instant until = bus.segment.now() + milliseconds(5);
      while (bus.segment.waitReadable(until)) {
        std::uint8_t buffer[64];
        received += bus.segment.read(buffer, sizeof buffer);
      }
    }
    bus.drive().inverter().trip(30, false);
    bus.segment.run(milliseconds(20));
    bus.drive().setPlugged(false);
    bus.segment.run(milliseconds(300));
    bus.drive().setPlugged(true);
    bus.segment.run(milliseconds(400));
  }
  test::countThisThread(false);

  EXPECT_EQ(0u, test::allocations);
  EXPECT_LT(1000u, received);
  EXPECT_LT(9u, bus.drive().parameters().eepromWrites());
}

// The same with a module: slots, records, its time-out and SYNC.
TEST(NoAllocation, OfAModule) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  Conversation bus{oneModule(2)};
  bus.segment.stations().module(0).parameters().preset(151, 0, 0, 100);
  std::vector<std::vector<std::uint8_t>> requests;
  requests.push_back(Conversation::variable(0x88, 0x81, 0x6D, fromHex("3C 3E")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x5D, fromHex("3D 3E A8 0A 01 0B 0B A8 00 80 00 00")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x7D, fromHex("3E 3E 30 F5 F1")));
  requests.push_back(Conversation::variable(0x88, 0x81, 0x5D, fromHex("3C 3E")));
  const char* const exchanges[] = {"02 0000000000000000 047E 0000 047E 0000", "01 744E0200000003E8 047F 2000 047E 0000",
                                   "00 0000000000000000 0000 0000 0000 0000"};
  unsigned code = 0x7D;
  for (const char* data : exchanges) {
    requests.push_back(Conversation::variable(0x08, 0x01, code, fromHex(data)));
    code ^= 0x20u;
  }
  for (const char* pdu : {"33 33 5F 00 64 08 1496 0000 0000 0000", "33 33", "33 33", "33 33 5E 00 64 08", "33 33"}) {
    requests.push_back(Conversation::variable(0x88, 0x81, code ^ 0x01u, fromHex(pdu)));
    code ^= 0x20u;
  }
  requests.push_back(Conversation::variable(0xFF, 0x81, 0x46, fromHex("3A 3E 20 00")));
  std::size_t received = 0;

  test::allocations = 0;
  test::countThisThread(true);
  for (int round = 0; round < 20; ++round) {
    for (const auto& request : requests) {
      bus.segment.run(milliseconds(1));
      bus.segment.write(request);
      const Instant until = bus.segment.now() + milliseconds(5);
      while (bus.segment.waitReadable(until)) {
        std::uint8_t buffer[64];
        received += bus.segment.read(buffer, sizeof buffer);
      }
    }
    bus.segment.run(milliseconds(120));
    bus.drive().setPlugged(round % 2 != 0);
    bus.segment.stations().module(0).setPowered(round % 3 != 0);
  }
  test::countThisThread(false);

  EXPECT_EQ(0u, test::allocations);
  EXPECT_LT(1000u, received);
}

// The same of the simulated CAN bus and its nodes.
TEST(NoAllocation, OnACanBus) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  CanConversation bus;
  std::vector<CanFrame> requests;
  for (const char* text : {"732#R1", "632#4066200100000000", "632#2B17100014000000", "000#0132", "232#7E040000",
                           "232#7F040020", "080#", "632#4008100000000000", "632#6000000000000000"}) {
    requests.push_back(nord_driver::frame(text));
  }
  CanDisturbance noise;
  noise.lose = noise.error = noise.duplicate = 0.05;
  std::size_t received = 0;

  test::allocations = 0;
  test::countThisThread(true);
  for (int round = 0; round < 20; ++round) {
    if (round == 10) bus.bus.setDisturbance(noise);
    for (const CanFrame& request : requests) {
      bus.bus.send(request);
      const Instant until = bus.bus.now() + milliseconds(10);
      while (bus.bus.waitReadable(until)) {
        link::ReceivedCanFrame frame;
        while (bus.bus.receive(frame)) ++received;
      }
    }
    bus.drive().inverter().trip(30, false);
    bus.bus.run(milliseconds(20));
    bus.drive().setPlugged(false);
    bus.bus.run(milliseconds(50));
    bus.drive().setPlugged(true);
    bus.bus.run(milliseconds(400));
  }
  test::countThisThread(false);

  EXPECT_EQ(0u, test::allocations);
  EXPECT_LT(200u, received);
}

// The same of the DeviceNet modules: fragments both ways, parameters, a time-out, the supply.
TEST(NoAllocation, OnADeviceNetBus) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  DnConversation bus{dnGateway(4, 102)};
  bus.connect();
  std::vector<CanFrame> requests;
  for (const char* text :
       {"44E#0A 4C 03 01 03", "44E#0A 4B 03 01 03 0A", "44C#0A 10 05 02 09 64 00", "44D#00 00 7E 04 00 00 00 00",
        "44D#41 00 00 7E 04 00 00 00", "44D#42 00 00 00 7E 04 00 00", "44D#43 00 00 00 00 7E 04 00",
        "44D#84 00 00 00 00 00", "44C#0A 0E 01 01 07", "44C#8A C0 00", "44C#8A C1 00", "44C#0A 10 65 01 03 64 00",
        "44C#0A 0E 6F 01 05", "457#80 FF FF 01 00 00 00"}) {
    requests.push_back(nord_driver::frame(text));
  }
  CanDisturbance noise;
  noise.lose = noise.error = noise.duplicate = 0.05;
  std::size_t received = 0;

  test::allocations = 0;
  test::countThisThread(true);
  for (int round = 0; round < 20; ++round) {
    if (round == 10) bus.bus.setDisturbance(noise);
    for (const CanFrame& request : requests) {
      bus.bus.send(request);
      const Instant until = bus.bus.now() + milliseconds(10);
      while (bus.bus.waitReadable(until)) {
        link::ReceivedCanFrame frame;
        while (bus.bus.receive(frame)) ++received;
      }
    }
    bus.drive().inverter().trip(30, false);
    bus.bus.run(milliseconds(500));
    bus.drive().setPlugged(round % 2 != 0);
    bus.module().setPowered(round % 4 != 0);
    bus.bus.run(milliseconds(2500));
  }
  test::countThisThread(false);

  EXPECT_EQ(0u, test::allocations);
  EXPECT_LT(100u, received);
}

}  // namespace
}  // namespace nord_driver::sim
