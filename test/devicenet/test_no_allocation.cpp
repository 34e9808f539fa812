#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"
#include "support/count_allocations.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

// The other test proves nothing unless this counts.
TEST(NoAllocation, IsCounted) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  EXPECT_EQ(1u, test::countAllocations([] { ::operator delete(::operator new(1)); }));
}

// From its construction on the scanner takes no memory: start, exchange, requests, refusals, losses, return, a full
// link, foreign and malformed frames, a communication fault, a lost bus and release included.
TEST(NoAllocation, AfterConstruction) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  ScannerConfig config = busConfig(4);
  config.nodes[1].product_code = std::uint16_t{1};
  config.nodes[2] = nodeConfig(7, IoKind::kChangeOfState, 33, 33);
  config.nodes[3] = nodeConfig(8, IoKind::kStrobe, 8, 5);
  Scanner scanner{config};
  std::vector<std::unique_ptr<FakeDevice>> devices;
  for (const NodeConfig& node : config.nodes) {
    devices.push_back(std::make_unique<FakeDevice>(node.mac));
    devices.back()->produced = node.io.input_bytes;
    devices.back()->consumed = node.io.output_bytes;
    devices.back()->attributes[{4, 100, 3}] = std::vector<std::uint8_t>(40, 1);
  }
  const std::vector<CanFrame> noise{frame("42B#05CD010003000000"),
                                    frame("42B#00"),
                                    frame("437#00850178563412"),
                                    frame("42E#114B03010111"),
                                    frame("3C5#00"),
                                    frame("4FB#0011"),
                                    frame("42B#CA41030405060708"),
                                    frame("407#00850178563412"),
                                    frame("407#80850178563412")};
  const ExplicitRequest request = setAttribute(1, 4, 100, 3, ByteView{std::vector<std::uint8_t>(40, 2)});
  Instant now{std::chrono::hours{1}};
  std::array<bool, 4> exchanged{};
  unsigned long allocated = 0;
  for (int i = 0; i < 20000; ++i, now += milliseconds{1}) {
    if (i == 4000) devices[0]->powerOff();
    if (i == 4500) devices[0]->powerOn();
    std::vector<CanFrame> received, sent;
    sent.reserve(256);
    for (auto& device : devices) {
      device->tick(now);
      CanFrame out;
      while (device->next(out)) received.push_back(out);
    }
    allocated += test::countAllocations([&] {
      if (i == 0 || i == 11000) scanner.restart(now);
      if (i == 10000) scanner.handleBusLost("can0: bus-off", now);
      if (i == 19000) scanner.releaseAll(now);
      for (const CanFrame& in : received) scanner.handleFrame(in, now);
      if (i % 100 == 50) scanner.handleFrame(noise[static_cast<std::size_t>(i / 100) % 7], now);
      if (i == 8000) scanner.handleFrame(noise[7], now);
      if (i == 15000) scanner.handleFrame(noise[8], now);
      if (i % 10 == 0) {
        const std::array<std::uint8_t, 33> output{0, 0x7E, 4};
        for (std::size_t node = 0; node < 4; ++node) scanner.setOutput(node, output);
        scanner.startCycle(now);
        scanner.submit(0, request);
      }
      scanner.poll(now);
      CanFrame out;
      while (sent.size() < 256 && scanner.pollTransmit(out)) {
        if (i % 70 == 0) {
          scanner.notSent();
          break;
        }
        sent.push_back(out);
      }
      while (scanner.pollAnswer()) {
      }
      while (scanner.pollEvent()) {
      }
    });
    for (std::size_t node = 0; node < 4; ++node) {
      exchanged[node] = exchanged[node] || scanner.status(node).state == NodeState::kExchanging;
    }
    for (const CanFrame& out : sent) {
      for (auto& device : devices) device->receive(out, now);
    }
  }
  EXPECT_EQ(0u, allocated);
  // It did what it was to be watched at.
  EXPECT_EQ((std::array<bool, 4>{true, false, true, true}), exchanged);
  EXPECT_EQ(1u, scanner.counters().own_mac_used);
  EXPECT_LE(2u, scanner.status(0).counters.losses);
  EXPECT_LT(0u, scanner.counters().not_sent);
  EXPECT_TRUE(scanner.released());
}

}  // namespace
}  // namespace nord_driver::devicenet
