#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;

// The whole of a start, byte by byte: our MAC id 10, a module at 9 with assembly 100/110, factory settings.
TEST(StartUp, Dialogue) {
  ScannerConfig config = busConfig(1, 9);
  config.mac = 10;
  config.nodes[0].io.expected_packet_rate = milliseconds{0x0E0A};
  ScannerRun run{config};
  run.devices[0]->rate_step = 16;
  run.devices[0]->input = {0x00, 0x31, 0x0B, 0x00, 0x00};
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return run.scanner.input(0).count > 0; }, seconds{3}));
  EXPECT_THAT(run.seen, ElementsAre("> 457#00341244332211",  // duplicate-MAC check: port 0, vendor 1234h, serial number
                                    "> 457#00341244332211",
                                    "> 44E#4A4B0301010A",  // allocate: class 3, instance 1, explicit, master 10
                                    "< 44B#4ACB00",        // 8/8
                                    "> 44C#0A0E010101",    // vendor id
                                    "< 44B#0A8E8501",
                                    "> 44C#4A0E010102",  // device type
                                    "< 44B#4A8E0200",
                                    "> 44C#0A0E010103",  // product code
                                    "< 44B#0A8E0700",
                                    "> 44C#4A0E010104",  // revision
                                    "< 44B#4A8E0104",
                                    "> 44C#0A0E050109",  // expected packet rate of the explicit connection
                                    "< 44B#0A8EC409",
                                    "> 44E#4A4B0301020A",  // allocate: polled
                                    "< 44B#4ACB00",
                                    "> 44C#0A0E050207",  // produced size
                                    "< 44B#0A8E0500",
                                    "> 44C#4A0E050208",  // consumed size
                                    "< 44B#4A8E0500",
                                    "> 44C#0A100502090A0E",  // expected packet rate 0E0Ah (facts: ICP DAS)
                                    "< 44B#0A90100E",        // rounded to 0E10h
                                    "> 44D#007E040000",      // poll: module outputs, 047E, setpoint 0
                                    "< 3C9#00310B0000"));    // module inputs, 0B31, actual value 0
  EXPECT_EQ(milliseconds{0x0E10}, run.scanner.status(0).packet_rate);
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// Nothing but the duplicate-MAC check in the first two seconds.
TEST(StartUp, SaysNothingElseForTwoSeconds) {
  ScannerRun run{busConfig(2)};
  run.begin();
  const Instant began = run.now;
  ASSERT_TRUE(run.runUntil([&] { return run.scanner.busState() == BusState::kOnline; }, seconds{4}));
  EXPECT_GE(run.now - began, seconds{2});
  EXPECT_LE(run.now - began, milliseconds{2010});
  run.step();
  ASSERT_LT(2u, run.seen.size());
  EXPECT_EQ("> 407#00341244332211", run.seen[0]);
  EXPECT_EQ(run.seen[0], run.seen[1]);
  EXPECT_EQ("> 42E#", run.seen[2].substr(0, 6)) << "then allocations begin";
}

TEST(StartUp, AllRunAndAreHeard) {
  ScannerRun run{busConfig(4)};
  run.devices[2]->answers_rate = false;  // then it is read
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(4u, run.count(DevicenetEventKind::kNodeExchanging));
  for (const DevicenetEvent& event : run.events) {
    if (event.kind == DevicenetEventKind::kNodeFound) {
      EXPECT_EQ(0u, event.value);
    }
  }
  EXPECT_EQ(4u, run.count(DevicenetEventKind::kNodeFound));
  EXPECT_EQ("exchanges process data by poll, expected packet rate 30 ms",
            run.eventText(DevicenetEventKind::kNodeExchanging));
  EXPECT_EQ(milliseconds{30}, run.scanner.status(2).packet_rate) << "25 ms, rounded up to tens by the device";
  EXPECT_EQ(389, run.scanner.status(0).vendor_id);
  EXPECT_EQ(1, run.scanner.status(0).major_revision);
  EXPECT_EQ(4, run.scanner.status(0).minor_revision);
  EXPECT_EQ((std::vector<std::uint8_t>{0x00, 0x7E, 0x04, 0x00, 0x00}), run.devices[3]->output);
  run.run(seconds{30});
  EXPECT_TRUE(run.allExchanging());
  EXPECT_THAT(run.violations(), testing::IsEmpty());
  for (const auto& device : run.devices) EXPECT_EQ(0u, device->explicit_deaths + device->io_deaths);
}

// A device that comes later is found without a restart.
TEST(StartUp, FindsWhatComesLater) {
  ScannerRun run{busConfig(2)};
  run.devices[1]->powerOff();
  run.begin();
  run.run(seconds{20});
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
  EXPECT_EQ(NodeState::kAbsent, run.scanner.status(1).state);
  EXPECT_STREQ("does not answer", run.scanner.status(1).reason.c_str());
  run.devices[1]->powerOn();
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}, 1));
}

// Another time on-line is a first one: who had failed often is asked as soon again, and is absent until he answers.
TEST(StartUp, AnotherOneBeginsAsTheFirst) {
  ScannerRun run{busConfig(1)};
  const auto asked = [&] {
    run.devices[0]->powerOff();
    run.begin();
    const Instant began = run.now;
    std::vector<Duration> times;
    run.on_sent = [&](const CanFrame& frame) {
      if (frame.id == 0x42E) times.push_back(run.now - began);
    };
    run.run(seconds{6});
    run.on_sent = nullptr;
    return times;
  };
  const std::vector<Duration> first = asked();
  ASSERT_LT(3u, first.size());
  EXPECT_LT(first[1] - first[0], first[2] - first[1]) << "the pauses grow";
  EXPECT_EQ(first, asked());

  run.devices[0]->powerOn();
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  run.scanner.handleBusLost("can0: bus-off", run.now);
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  run.run(seconds{1});
  run.devices[0]->powerOff();
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return run.scanner.busState() == BusState::kOnline; }, seconds{4}));
  EXPECT_EQ(NodeState::kAbsent, run.scanner.status(0).state);
  EXPECT_STREQ("", run.scanner.status(0).reason.c_str());
}

// A driver that was killed left its connections behind: they are ours, and released with the bits that are allocated; with those
// that would be ours where the device does not tell, or says that nobody holds what it has refused to allocate.
TEST(StartUp, TakesOverWhatIsOursFromBefore) {
  struct Told {
    bool owner, choice;
  };
  for (const Told tells : {Told{true, true}, Told{false, true}, Told{true, false}}) {
    ScannerRun run{busConfig(1)};
    run.devices[0]->tells_owner = tells.owner;
    run.devices[0]->tells_choice = tells.choice;
    run.devices[0]->explicit_rate = 30000;
    run.devices[0]->belongsTo(0, 0x03, run.now);
    ASSERT_TRUE(run.starts()) << run.scanner.status(0).reason.c_str();
    EXPECT_EQ(0x03, run.devices[0]->released_last);
    EXPECT_EQ(0u, run.scanner.status(0).counters.refusals);
  }
}

// The explicit connection died of idleness meanwhile, the one for process data is still there, timed out.
TEST(StartUp, TakesOverWhatIsLeftOfIt) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(0, 0x02, run.now);
  ASSERT_TRUE(run.starts()) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(0x02, run.devices[0]->released_last);
}

// FFh is the master of a device that has none (allocation information): what is left of its connections
// is nobody's.
TEST(StartUp, NobodyIsNoOtherMaster) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(0xFF, 0x02, run.now);
  run.begin();
  run.run(seconds{3});
  EXPECT_FALSE(run.scanner.status(0).owner);
  EXPECT_THAT(run.scanner.status(0).reason.c_str(), testing::Not(testing::HasSubstr("MAC id 255")));
}

// Off and on again between the two allocations: the second one is refused for want of the first. That is no refusal of the
// process data, and no reason to wait: everything begins again.
TEST(StartUp, AModuleThatStartsAnewBetweenTheAllocations) {
  ScannerRun run{busConfig(1)};
  bool once = true;
  run.on_sent = [&](const CanFrame& frame) {
    if (!once || frame.id != 0x42E || frame.data[1] != 0x4B || frame.data[4] != 0x02) return;
    once = false;
    run.devices[0]->powerOff();
    run.devices[0]->powerOn();
  };
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return !once; }, seconds{3}));
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{500})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(0u, run.scanner.status(0).counters.refusals);
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// Explicit messages alone: no process data, but the connection is watched.
TEST(StartUp, ExplicitMessagesAlone) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.kind = IoKind::kNone;
  ScannerRun run{config};
  run.no_inputs = true;
  ASSERT_TRUE(run.starts());
  run.run(seconds{30});
  EXPECT_EQ(0u, run.sentTo("42D"));
  EXPECT_EQ(0x01, run.devices[0]->held);
  EXPECT_EQ(0u, run.devices[0]->explicit_deaths);
  run.devices[0]->powerOff();
  EXPECT_TRUE(run.reaches(NodeState::kLost, seconds{3}));
}

// Not every device has a revision, and none is compared.
TEST(StartUp, ADeviceWithoutARevisionRuns) {
  for (const bool too_short : {false, true}) {
    ScannerRun run{busConfig(1)};
    run.devices[0]->attributes.erase({1, 1, 4});
    if (too_short) run.devices[0]->attributes[{1, 1, 4}] = {9};
    ASSERT_TRUE(run.starts()) << run.scanner.status(0).reason.c_str();
    EXPECT_EQ(0, run.scanner.status(0).major_revision);
    EXPECT_EQ(0, run.scanner.status(0).minor_revision);
    EXPECT_EQ(0u, run.scanner.status(0).counters.refusals);
  }
}

}  // namespace
}  // namespace nord_driver::devicenet
