// A link that does not take every frame: what it takes first, and what counts as sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

// What stops a drive leaves first where the link takes a frame only now and then: before a bit strobe, which would be a sign
// of life for P151 besides, and before an acknowledge.
TEST(FullQueue, OutputsLeaveBeforeAllElse) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kStrobe), nodeConfig(6, IoKind::kChangeOfState)};
  ScannerRun run{config};
  run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
  ASSERT_TRUE(run.starts());
  CanFrame data;
  data.id = 0x346;
  for (const std::uint8_t byte : run.devices[1]->input) data.data[data.size++] = byte;
  const auto idsOfACycle = [&] {
    run.scanner.handleFrame(data, run.now);
    for (std::size_t i = 0; i < 2; ++i) run.scanner.setOutput(i, ByteView{run.output});
    run.scanner.startCycle(run.now);
    std::vector<std::uint32_t> ids;
    for (CanFrame frame; run.scanner.pollTransmit(frame);) ids.push_back(frame.id);
    return ids;
  };
  idsOfACycle();  // what was left
  run.output[0] ^= 0x01;
  EXPECT_THAT(idsOfACycle(), testing::ElementsAre(0x42Du, 0x435u, 0x400u, 0x432u));
}

/// What a link takes that has room for so many frames in each cycle: a list for each.
std::vector<std::vector<std::uint32_t>> takenInEach(ScannerRun& run, int cycles, std::size_t room) {
  std::vector<std::vector<std::uint32_t>> taken(static_cast<std::size_t>(cycles));
  for (std::vector<std::uint32_t>& of_this : taken) {
    for (std::size_t i = 0; i < run.scanner.nodeCount(); ++i) run.scanner.setOutput(i, ByteView{run.output});
    run.scanner.startCycle(run.now);
    for (CanFrame frame; run.scanner.pollTransmit(frame);) {
      if (of_this.size() == room) {
        run.scanner.notSent();
      } else {
        of_this.push_back(frame.id);
      }
    }
  }
  return taken;
}

std::vector<std::uint32_t> takenOneACycle(ScannerRun& run, int cycles) {
  std::vector<std::uint32_t> taken;
  for (const auto& of_one : takenInEach(run, cycles, 1)) taken.insert(taken.end(), of_one.begin(), of_one.end());
  return taken;
}

// Each device has its turn: none feeds the time-outs of one wheel alone.
TEST(FullQueue, EachDeviceHasItsTurn) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5), nodeConfig(6), nodeConfig(7)};
  ScannerRun run{config};
  run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
  ASSERT_TRUE(run.starts());
  EXPECT_THAT(takenOneACycle(run, 6), testing::ElementsAre(0x42Du, 0x435u, 0x43Du, 0x42Du, 0x435u, 0x43Du));
}

// A message of two frames never gets through; the others' do.
TEST(FullQueue, AMessageThatIsTooLongForItIsNoHindrance) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kPoll, 9, 9), nodeConfig(6)};
  ScannerRun run{config};
  run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
  ASSERT_TRUE(run.starts());
  EXPECT_THAT(takenOneACycle(run, 4), testing::ElementsAre(0x42Du, 0x435u, 0x42Du, 0x435u));
}

/// In how many of these cycles the message of a device, of so many frames, left as a whole.
std::ptrdiff_t served(const std::vector<std::vector<std::uint32_t>>& taken, std::uint32_t id, std::ptrdiff_t frames) {
  return std::count_if(taken.begin(), taken.end(), [=](const std::vector<std::uint32_t>& of_one) {
    return std::count(of_one.begin(), of_one.end(), id) == frames;
  });
}

// Behind another one a message does not fit that would alone: it begins the next cycle.
TEST(FullQueue, AMessageThatWouldFitAloneHasItsTurn) {
  struct Case {
    std::vector<std::size_t> frames;  // of the message of each device
    std::size_t room;
  };
  for (const Case& one : {Case{{3, 3}, 4}, Case{{3, 3}, 5}, Case{{1, 2}, 2}, Case{{2, 1}, 2}, Case{{1, 1, 3}, 4},
                          Case{{3, 3, 3}, 8}, Case{{2, 3, 1}, 3}}) {
    ScannerConfig config = busConfig(0);
    for (std::size_t i = 0; i < one.frames.size(); ++i) {
      const std::size_t bytes = one.frames[i] == 1 ? 5 : 7 * one.frames[i] - 2;
      config.nodes.push_back(nodeConfig(static_cast<std::uint8_t>(5 + i), IoKind::kPoll, bytes, bytes));
    }
    ScannerRun run{config};
    run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
    ASSERT_TRUE(run.starts());
    const auto taken = takenInEach(run, 12, one.room);
    for (std::size_t i = 0; i < one.frames.size(); ++i) {
      const auto id = static_cast<std::uint32_t>(0x42D + 8 * i);
      EXPECT_GE(served(taken, id, static_cast<std::ptrdiff_t>(one.frames[i])), 3)
          << "device " << i << " of " << one.frames.size() << ", room " << one.room;
    }
  }
}

// There is room again within the cycle: it is for the word that stops, in the next one.
TEST(FullQueue, NothingElseLeavesBeforeAnOutputThatWasRefused) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5), nodeConfig(6, IoKind::kChangeOfState)};
  ScannerRun run{config};
  run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
  ASSERT_TRUE(run.starts());
  CanFrame frame;
  while (run.scanner.pollTransmit(frame)) {
  }
  for (std::size_t i = 0; i < 2; ++i) run.scanner.setOutput(i, ByteView{run.output});
  run.scanner.startCycle(run.now);
  ASSERT_TRUE(run.scanner.pollTransmit(frame));
  run.scanner.notSent();
  CanFrame data;
  data.id = 0x346;
  for (const std::uint8_t byte : run.devices[1]->input) data.data[data.size++] = byte;
  run.scanner.handleFrame(data, run.now);
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 1, 1, 1)));
  EXPECT_FALSE(run.scanner.pollTransmit(frame)) << std::hex << frame.id;
  for (std::size_t i = 0; i < 2; ++i) run.scanner.setOutput(i, ByteView{run.output});
  run.scanner.startCycle(run.now);
  std::vector<std::uint32_t> ids;
  while (run.scanner.pollTransmit(frame)) ids.push_back(frame.id);
  ASSERT_LE(3u, ids.size());
  EXPECT_EQ(0x42Du, ids[0]);
  EXPECT_THAT(ids, testing::IsSupersetOf({0x432u, 0x42Cu}));
}

// A strobe that the link did not take is none.
TEST(FullQueue, ABitStrobeThatWasNotSentIsCountedBack) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kStrobe, 8, 0)};
  ScannerRun run{config};
  run.output = {0x01};
  ASSERT_TRUE(run.starts());
  const std::uint64_t strobes = run.scanner.counters().strobes, superseded = run.scanner.counters().superseded;
  run.scanner.startCycle(run.now);
  CanFrame frame;
  ASSERT_TRUE(run.scanner.pollTransmit(frame));
  ASSERT_EQ(0x400u, frame.id);
  EXPECT_EQ(strobes + 1, run.scanner.counters().strobes);
  const std::uint64_t sent = run.scanner.counters().frames_sent;
  run.scanner.notSent();
  EXPECT_EQ(sent - 1, run.scanner.counters().frames_sent);
  EXPECT_EQ(strobes, run.scanner.counters().strobes);
  EXPECT_EQ(superseded + 1, run.scanner.counters().superseded);
}

// The device was not asked: it has missed nothing, and is not lost for want of an answer.
TEST(FullQueue, NobodyMissesAnAnswerToABitStrobeThatWasNotSent) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kStrobe, 8, 0)};
  ScannerRun run{config};
  run.output = {0x01};
  ASSERT_TRUE(run.starts());
  const std::uint64_t missed = run.scanner.status(0).counters.missed;
  for (int cycle = 0; cycle < 20; ++cycle) {
    run.scanner.startCycle(run.now);
    CanFrame frame;
    ASSERT_TRUE(run.scanner.pollTransmit(frame));
    ASSERT_EQ(0x400u, frame.id) << cycle;
    run.scanner.notSent();
    run.now += milliseconds{10};
    run.scanner.poll(run.now);
  }
  EXPECT_EQ(missed, run.scanner.status(0).counters.missed);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
}

}  // namespace
}  // namespace nord_driver::devicenet
