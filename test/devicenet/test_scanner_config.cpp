#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <vector>

#include "devicenet/scanner.h"
#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

std::string refusalOf(const std::function<void(ScannerConfig&)>& spoil, std::size_t nodes = 2) {
  ScannerConfig config = busConfig(nodes);
  spoil(config);
  try {
    Scanner scanner{config};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScannerConfig, Good) {
  EXPECT_EQ("accepted", refusalOf([](ScannerConfig&) {}));
}

TEST(ScannerConfig, MacIds) {
  EXPECT_EQ("MAC id 5 is configured twice, as devices 1 and 2",
            refusalOf([](ScannerConfig& config) { config.nodes[1].mac = 5; }));
  EXPECT_EQ("MAC id 6 is our own and that of a device", refusalOf([](ScannerConfig& config) { config.mac = 6; }));
  EXPECT_EQ("MAC id 64 is not 0 to 63", refusalOf([](ScannerConfig& config) { config.nodes[1].mac = 64; }));
  EXPECT_EQ("our MAC id 64 is not 0 to 63", refusalOf([](ScannerConfig& config) { config.mac = 64; }));
  EXPECT_EQ("0 devices; a DeviceNet scanner needs 1 to 63",
            refusalOf([](ScannerConfig& config) { config.nodes.clear(); }));
}

// What is allocated: the bits of the allocation choice (class 3, attribute 5), and the instance of the connection object
// (class 5) it makes; BU 0280 4.3.4. A strobe has a poll beside it only where there are outputs.
TEST(ScannerConfig, ChoiceOfTheConnections) {
  const auto choiceOf = [](IoKind kind, std::optional<std::size_t> outputs, bool acknowledge = true) {
    IoConfig io;
    io.kind = kind;
    if (outputs) io.output_bytes = *outputs;
    io.acknowledge = acknowledge;
    return unsigned{ioChoice(io)};
  };
  EXPECT_EQ(0x00u, choiceOf(IoKind::kNone, std::nullopt));
  EXPECT_EQ(0x02u, choiceOf(IoKind::kPoll, 5u));
  EXPECT_EQ(0x02u, choiceOf(IoKind::kPoll, 5u, false));
  EXPECT_EQ(0x04u, choiceOf(IoKind::kStrobe, std::nullopt));
  EXPECT_EQ(0x06u, choiceOf(IoKind::kStrobe, 5u));
  EXPECT_EQ(0x10u, choiceOf(IoKind::kChangeOfState, 5u));
  EXPECT_EQ(0x50u, choiceOf(IoKind::kChangeOfState, 5u, false));
  EXPECT_EQ(0x20u, choiceOf(IoKind::kCyclic, 5u));
  EXPECT_EQ(0x60u, choiceOf(IoKind::kCyclic, 5u, false));
  EXPECT_EQ(2, connectionInstance(IoKind::kPoll));
  EXPECT_EQ(3, connectionInstance(IoKind::kStrobe));
  EXPECT_EQ(4, connectionInstance(IoKind::kChangeOfState));
  EXPECT_EQ(4, connectionInstance(IoKind::kCyclic));
}

TEST(ScannerConfig, BitRate) {
  EXPECT_EQ("a bit rate of 1000000 bit/s; DeviceNet has 125000, 250000 and 500000",
            refusalOf([](ScannerConfig& config) { config.bit_rate = 1'000'000; }));
}

TEST(ScannerConfig, Sizes) {
  EXPECT_EQ("MAC id 5: an input size of 9 bytes; bit strobe carries at most 8",
            refusalOf([](ScannerConfig& config) { config.nodes[0] = nodeConfig(5, IoKind::kStrobe, 9, 0); }));
  EXPECT_EQ("MAC id 5: an input size of 65 bytes; poll carries at most 64",
            refusalOf([](ScannerConfig& config) { config.nodes[0].io.input_bytes = 65; }));
  EXPECT_EQ("MAC id 5: an input size of 0 bytes cannot be supervised; expected 1 to 64",
            refusalOf([](ScannerConfig& config) { config.nodes[0].io.input_bytes = 0; }));
  EXPECT_EQ("MAC id 5: an output size of 65 bytes; at most 64 are carried",
            refusalOf([](ScannerConfig& config) { config.nodes[0].io.output_bytes = 65; }));
}

TEST(ScannerConfig, Times) {
  EXPECT_EQ("MAC id 5: an expected packet rate of 4.5 ms; expected whole milliseconds, 1 to 65535",
            refusalOf([](ScannerConfig& config) {
              config.nodes[0].io.expected_packet_rate = std::chrono::microseconds{4500};
            }));
  EXPECT_EQ(
      "MAC id 5: with an expected packet rate of 4.0 ms it gives up after 16.0 ms, but hears from us only every 10.0 "
      "ms",
      refusalOf([](ScannerConfig& config) { config.nodes[0].io.expected_packet_rate = milliseconds{4}; }));
  EXPECT_EQ("MAC id 5: a time-out of 5.0 ms is shorter than the cycle of 10.0 ms",
            refusalOf([](ScannerConfig& config) { config.nodes[0].io.timeout = milliseconds{5}; }));
  EXPECT_EQ("the cycle time must be above 0",
            refusalOf([](ScannerConfig& config) { config.cycle_time = Duration::zero(); }));
}

// Facts 5: 33 bytes each way are 1310 bits with the worst stuffing, 8 bytes 270.
TEST(ScannerConfig, TimeOnTheWire) {
  ScannerConfig config = busConfig(1);
  config.bit_rate = 125'000;
  config.nodes[0].io.input_bytes = config.nodes[0].io.output_bytes = 33;
  EXPECT_EQ(1310 * Duration{8000}, cycleOnWire(config));
  config.nodes[0].io.input_bytes = config.nodes[0].io.output_bytes = 8;
  EXPECT_EQ(270 * Duration{8000}, cycleOnWire(config));
  config.nodes[0] = nodeConfig(5, IoKind::kStrobe, 8, 0);
  EXPECT_EQ(270 * Duration{8000}, cycleOnWire(config)) << "the command counts once";
  config.nodes.push_back(nodeConfig(6, IoKind::kStrobe, 8, 0));
  EXPECT_EQ(405 * Duration{8000}, cycleOnWire(config));
  config.nodes = {nodeConfig(5, IoKind::kStrobe, 8, 5)};
  EXPECT_EQ(510 * Duration{8000}, cycleOnWire(config)) << "a poll of 105 beside it, answered by 135";
  config.nodes = {nodeConfig(5, IoKind::kChangeOfState, 4, 4)};
  EXPECT_EQ(300 * Duration{8000}, cycleOnWire(config)) << "two of 95, two acknowledges of 55";
}

TEST(ScannerConfig, CycleTheBusCannotCarry) {
  EXPECT_EQ("a cycle of 10.0 ms is asked for, but 8 devices take up to 13.4 ms at 125 kbit/s",
            refusalOf([](ScannerConfig& config) { config.bit_rate = 125'000; }, 8));
  EXPECT_EQ("accepted", refusalOf(
                            [](ScannerConfig& config) {
                              config.bit_rate = 125'000;
                              config.cycle_time = milliseconds{14};
                            },
                            8));
}

// What is left to the cycle: two of them, at least 25 ms, whole milliseconds.
TEST(ScannerConfig, ExpectedPacketRate) {
  ScannerConfig config = busConfig(1);
  EXPECT_EQ(milliseconds{25}, completed(config).nodes[0].io.expected_packet_rate);
  config.cycle_time = std::chrono::microseconds{16700};
  EXPECT_EQ(milliseconds{34}, completed(config).nodes[0].io.expected_packet_rate);
  config.nodes[0].io.expected_packet_rate = milliseconds{75};
  EXPECT_EQ(milliseconds{75}, completed(config).nodes[0].io.expected_packet_rate);
}

// Each bound itself is taken.
TEST(ScannerConfig, TakesWhatIsJustWithinItsBounds) {
  const std::vector<std::function<void(ScannerConfig&)>> all{
      [](ScannerConfig& config) { config.nodes[0] = nodeConfig(5, IoKind::kStrobe, 8, 0); },
      [](ScannerConfig& config) { config.nodes[0] = nodeConfig(5, IoKind::kPoll, 64, 64); },
      [](ScannerConfig& config) { config.nodes[0] = nodeConfig(5, IoKind::kNone, 0, 0); },
      [](ScannerConfig& config) { config.nodes[0].mac = 63; },
      [](ScannerConfig& config) { config.mac = 63; },
      [](ScannerConfig& config) { config.nodes[0].io.expected_packet_rate = milliseconds{5}; },
      [](ScannerConfig& config) { config.nodes[0].io.expected_packet_rate = milliseconds{65535}; },
      [](ScannerConfig& config) { config.nodes[0].io.timeout = milliseconds{10}; },
      [](ScannerConfig& config) { config.longest_retry = config.first_retry; },
      [](ScannerConfig& config) { config.cycle_time = cycleOnWire(config); },
      [](ScannerConfig& config) { config.bit_rate = 125'000; },
      [](ScannerConfig& config) { config.bit_rate = 250'000; }};
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ("accepted", refusalOf(all[i])) << i;
}

TEST(ScannerConfig, PausesAndTimeOutsAreAboveZero) {
  const std::string pauses = "the pauses between two tries must be above 0, and the longest not shorter than the first";
  EXPECT_EQ(pauses, refusalOf([](ScannerConfig& config) { config.first_retry = Duration::zero(); }));
  EXPECT_EQ(pauses, refusalOf([](ScannerConfig& config) { config.fault_pause = Duration::zero(); }));
  EXPECT_EQ(pauses, refusalOf([](ScannerConfig& config) { config.longest_retry = config.first_retry - Duration{1}; }));
  const std::string timeouts = "MAC id 6: its time-outs must be above 0";
  EXPECT_EQ(timeouts, refusalOf([](ScannerConfig& config) { config.nodes[1].connect_timeout = Duration::zero(); }));
  EXPECT_EQ(timeouts, refusalOf([](ScannerConfig& config) { config.nodes[1].request_timeout = Duration::zero(); }));
  EXPECT_EQ("MAC id 6: an expected packet rate of 65536.0 ms; expected whole milliseconds, 1 to 65535",
            refusalOf([](ScannerConfig& config) { config.nodes[1].io.expected_packet_rate = milliseconds{65536}; }));
}

}  // namespace
}  // namespace nord_driver::devicenet
