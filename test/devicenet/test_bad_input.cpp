#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ScannerConfig everyKind() {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5),
                  nodeConfig(6, IoKind::kPoll, 33, 33),
                  nodeConfig(7, IoKind::kStrobe, 8, 5),
                  nodeConfig(8, IoKind::kChangeOfState),
                  nodeConfig(9, IoKind::kCyclic, 10, 10),
                  nodeConfig(10, IoKind::kStrobe, 4, 0)};
  return config;
}

// Every length from 0 to 8, data and remote, on every identifier of ours, with bytes that mean nothing: nothing is taken
// for process data that is not as long as configured, nobody is lost for good, and everything goes on.
TEST(BadInput, EveryLengthOnEveryIdentifier) {
  constexpr std::array<std::uint8_t, 6> kFills{0x00, 0x05, 0x3F, 0x80, 0xC0, 0xFF};
  for (const std::uint8_t fill : kFills) {
    ScannerRun run{everyKind()};
    ASSERT_TRUE(run.starts());
    for (const std::uint32_t id : run.scanner.receivedIds()) {
      for (std::uint8_t size = 0; size <= 8; ++size) {
        for (const bool remote : {false, true}) {
          CanFrame bad;
          bad.id = id;
          bad.size = size;
          bad.remote = remote;
          bad.data.fill(fill);
          run.scanner.handleFrame(bad, run.now);
          run.pump();
        }
      }
    }
    for (std::size_t i = 0; i < run.scanner.nodeCount(); ++i) {
      const std::size_t length = run.scanner.input(i).bytes.size();
      EXPECT_TRUE(length == 0 || length == everyKind().nodes[i].io.input_bytes) << i;
    }
    EXPECT_TRUE(run.runUntil([&] { return run.allExchanging(); }, seconds{5})) << unsigned{fill};
    run.run(milliseconds{200});
    EXPECT_TRUE(run.allExchanging());
  }
}

// The same in every state of the start, one frame each millisecond.
TEST(BadInput, DuringTheStart) {
  ScannerRun run{everyKind()};
  const std::vector<std::uint32_t> ids = run.scanner.receivedIds();
  std::size_t next = 0;
  run.begin();
  for (int i = 0; i < 12000; ++i) {
    CanFrame bad;
    bad.id = ids[next++ % ids.size()];
    bad.size = static_cast<std::uint8_t>(i / 7 % 9);
    // A duplicate-MAC message of seven bytes with our MAC id is not bad: it is the other one.
    if (bad.id == 0x407) bad.size = 6;
    bad.data.fill(static_cast<std::uint8_t>(i));
    run.scanner.handleFrame(bad, run.now);
    run.step();
  }
  EXPECT_TRUE(run.runUntil([&] { return run.allExchanging(); }, seconds{2}));
}

// A header with another MAC id than ours: to another master, never taken for an answer.
TEST(BadInput, WrongMacInTheHeader) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.loses = [&run](const CanFrame& frame) {
    if (frame.id != 0x42B) return false;
    CanFrame changed = frame;
    changed.data[0] |= 0x21;
    run.scanner.handleFrame(changed, run.now);
    return true;
  };
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 1, 1, 1)));
  std::optional<NodeAnswer> answer;
  for (int i = 0; i < 2000 && !answer; ++i) {
    run.step();
    answer = run.scanner.pollAnswer();
  }
  ASSERT_TRUE(answer);
  EXPECT_EQ(ExplicitEnd::kTimedOut, answer->answer.end);
  EXPECT_EQ(2u, run.scanner.counters().second_scanner);
  EXPECT_EQ(2u, run.scanner.status(0).counters.foreign_requests);
}

// A fragment that never ends, of an answer of the start: given up, and the device is connected again.
TEST(BadInput, FragmentThatNeverEnds) {
  ScannerRun run{busConfig(1)};
  unsigned count = 0;
  run.loses = [&](const CanFrame& frame) {
    if (count > 200 || frame.id != 0x42B || frame.data[1] != 0x8E) return false;
    for (int i = 0; i < 40; ++i) {
      const auto byte = static_cast<std::uint8_t>(i == 0 ? 0x00 : 0x40u | (static_cast<unsigned>(i) & 0x3Fu));
      FixedBytes<8> bytes{static_cast<std::uint8_t>(frame.data[0] | 0x80u), byte, 0x8E, 1, 2, 3, 4, 5};
      run.scanner.handleFrame(dataFrame(0x42B, bytes), run.now);
      ++count;
    }
    return true;
  };
  run.begin();
  run.run(milliseconds{2100});
  EXPECT_NE(NodeState::kExchanging, run.scanner.status(0).state);
  EXPECT_TRUE(run.runUntil([&] { return run.allExchanging(); }, seconds{6}));
}

// The filters of the interface: everything of our devices and our MAC id, sorted, never more than a socket can filter.
TEST(BadInput, ReceivedIdentifiers) {
  Scanner one{busConfig(1)};
  const auto ids = one.receivedIds();
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  for (const std::uint32_t id : {0x3C5u, 0x42Bu, 0x407u, 0x42Fu, 0x42Eu, 0x42Du, 0x42Cu, 0x42Au, 0x410u, 0x745u}) {
    EXPECT_THAT(ids, testing::Contains(id));
  }
  ScannerConfig config = busConfig(0);
  config.cycle_time = seconds{1};
  for (std::uint8_t mac = 1; mac < 64; ++mac) config.nodes.push_back(nodeConfig(mac, IoKind::kChangeOfState));
  const auto all = Scanner{config}.receivedIds();
  EXPECT_GE(Scanner::kMostIds, all.size());
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  for (const std::uint32_t id : {0x37Fu, 0x3FFu, 0x5FBu, 0x407u}) EXPECT_THAT(all, testing::Contains(id));
}

// What is no identifier of DeviceNet, or of nobody we know, is counted and told once.
TEST(BadInput, Foreign) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  CanFrame extended = frame("3C5#0102030405");
  extended.extended = true;
  run.scanner.handleFrame(extended, run.now);
  for (const char* other : {"7F0#", "7FF#00", "7C0#01", "600#00", "000#01", "3C7#0102030405", "4FB#0000"})
    run.say(other);
  EXPECT_EQ(8u, run.scanner.counters().foreign);
  run.say("4FB#0000");
  run.step();
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kForeignNode));
  EXPECT_EQ("a device with MAC id 31 is on the bus, but is not configured",
            run.eventText(DevicenetEventKind::kForeignNode));
}

// Another master that is refused does nothing with the device. A fragment is no refusal, whatever its number: 94h says which
// part of a long answer it is.
TEST(BadInput, ARefusalOfAnotherMasterIsNoUse) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const NodeCounters& counters = run.scanner.status(0).counters;
  run.say("42B#01940201");
  EXPECT_EQ(1u, counters.foreign_requests);
  EXPECT_EQ(0u, counters.foreign_use);
  run.say("42B#018E8501");
  EXPECT_EQ(2u, counters.foreign_requests);
  EXPECT_EQ(1u, counters.foreign_use);
  run.say("42B#8194FF01");
  EXPECT_EQ(3u, counters.foreign_requests);
  EXPECT_EQ(2u, counters.foreign_use);
  EXPECT_EQ(3u, run.scanner.counters().second_scanner);
}

// What another master sends it: a question for a connection may be refused, process data and requests are use.
TEST(BadInput, OnlyAnAllocationMayStillBeRefused) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const NodeCounters& counters = run.scanner.status(0).counters;
  run.say("42E#014B03010101");
  EXPECT_EQ(1u, counters.foreign_requests);
  EXPECT_EQ(0u, counters.foreign_use);
  for (const char* used : {"42D#00", "42C#010E010101", "42A#"}) run.say(used);
  EXPECT_EQ(4u, counters.foreign_requests);
  EXPECT_EQ(3u, counters.foreign_use);
}

// Group 2 message 1 is no connection of the predefined set that is used here, nor one of a second scanner of ours.
TEST(BadInput, AMulticastPollIsForeign) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.say("429#0102");
  EXPECT_EQ(1u, run.scanner.counters().foreign);
  EXPECT_EQ(0u, run.scanner.counters().second_scanner);
  EXPECT_EQ(0u, run.scanner.status(0).counters.foreign_requests);
}

// Nothing was given out: there is nothing that could not be sent.
TEST(BadInput, NothingIsNotSent) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const std::uint64_t sent = run.scanner.counters().frames_sent;
  run.scanner.notSent();
  EXPECT_EQ(sent, run.scanner.counters().frames_sent);
  EXPECT_EQ(0u, run.scanner.counters().not_sent);
}

}  // namespace
}  // namespace nord_driver::devicenet
