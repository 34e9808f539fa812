// A link that does not take every frame: what it takes first, and what counts as sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

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

/// What a link takes that has room for one frame in each cycle.
std::vector<std::uint32_t> takenOneACycle(ScannerRun& run, int cycles) {
  std::vector<std::uint32_t> taken;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (std::size_t i = 0; i < run.scanner.nodeCount(); ++i) run.scanner.setOutput(i, ByteView{run.output});
    run.scanner.startCycle(run.now);
    bool took = false;
    for (CanFrame frame; run.scanner.pollTransmit(frame);) {
      if (took) {
        run.scanner.notSent();
        continue;
      }
      taken.push_back(frame.id);
      took = true;
    }
  }
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

}  // namespace
}  // namespace nord_driver::devicenet
