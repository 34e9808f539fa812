#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using std::chrono::seconds;

ScannerConfig oneOf(IoKind kind, std::size_t in, std::size_t out, bool acknowledge = true) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, kind, in, out)};
  config.nodes[0].io.acknowledge = acknowledge;
  return config;
}

// Poll: one command and one answer a cycle, the newest values.
TEST(ProcessData, Poll) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  const std::size_t before = run.devices[0]->polls;
  const auto inputs = run.scanner.input(0).count;
  run.output = {0x03, 0x7F, 0x04, 0x00, 0x20};
  run.devices[0]->input = {0x0F, 0x37, 0x0B, 0xFF, 0x1F};
  run.run(milliseconds{100});
  EXPECT_EQ(before + 10, run.devices[0]->polls);
  EXPECT_EQ(inputs + 10, run.scanner.input(0).count);
  EXPECT_EQ(run.output, run.devices[0]->output);
  EXPECT_EQ(ByteView{run.devices[0]->input}, ByteView{run.scanner.input(0).bytes});
  EXPECT_EQ(0u, run.scanner.status(0).counters.missed);
}

// Nothing is sent before there is a value: no zeros, and no message of no bytes, which would trip P151 (BU 0280 4.1.3).
TEST(ProcessData, NoPollWithoutAValue) {
  ScannerRun run{busConfig(1)};
  run.sets_outputs = false;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{3}));
  run.run(milliseconds{50});
  EXPECT_EQ(0u, run.sentTo("42D"));
}

// The answer to a poll is missed now and then; an answer of no bytes is a sign of life without a value.
TEST(ProcessData, MissedAndEmptyAnswers) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  int n = 0;
  run.loses = [&n](const CanFrame& frame) { return frame.id == 0x3C5 && n++ % 2 == 0; };
  run.run(milliseconds{200});
  EXPECT_EQ(10u, run.scanner.status(0).counters.missed);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
  run.loses = [&run](const CanFrame& frame) {
    if (frame.id != 0x3C5) return false;
    run.scanner.handleFrame(dataFrame(0x3C5, ByteView{}), run.now);
    return true;
  };
  const auto inputs = run.scanner.input(0).count;
  run.run(seconds{1});
  EXPECT_EQ(inputs, run.scanner.input(0).count);
  EXPECT_LE(100u, run.scanner.status(0).counters.empty_inputs);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
}

// Answers of a wrong length are not taken.
TEST(ProcessData, WrongLength) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.sets_outputs = false;
  const auto inputs = run.scanner.input(0).count;
  for (const char* bad : {"3C5#01", "3C5#01020304", "3C5#010203040506", "3C5#R5"}) run.say(bad);
  EXPECT_EQ(4u, run.scanner.status(0).counters.malformed);
  EXPECT_EQ(inputs, run.scanner.input(0).count);
  run.say("385#0102030405");  // of a bit strobe connection
  run.say("345#0102030405");  // of change of state
  EXPECT_EQ(6u, run.scanner.status(0).counters.malformed);
}

// Bit strobe: one command for all with a bit each, at most eight bytes back (BU 0280 4.2.1).
TEST(ProcessData, BitStrobe) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kStrobe, 8, 0), nodeConfig(12, IoKind::kStrobe, 4, 0), nodeConfig(20)};
  ScannerRun run{config};
  run.output = {0x01};
  run.devices[0]->input = {1, 2, 3, 4, 5, 6, 7, 8};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{100});
  EXPECT_EQ(0x05, run.devices[0]->held);
  EXPECT_THAT(run.seen, testing::Contains("> 400#2010000000000000"));  // bits 5 and 12
  EXPECT_EQ(ByteView{run.devices[0]->input}, ByteView{run.scanner.input(0).bytes});
  EXPECT_EQ(4u, run.scanner.input(1).bytes.size());
  EXPECT_EQ(run.devices[0]->polls, run.devices[1]->polls) << "one command for both";
  EXPECT_LE(10u, run.scanner.counters().strobes);
  run.output = {0x00};
  run.run(milliseconds{20});
  EXPECT_THAT(run.seen, testing::Contains("> 400#0000000000000000"));
  run.devices[1]->powerOff();
  EXPECT_TRUE(run.reaches(NodeState::kLost, seconds{1}, 1));
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
  run.devices[1]->powerOn();
  EXPECT_TRUE(run.runUntil([&] { return run.allExchanging(); }, seconds{2}));
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// A bit strobe carries no words: the outputs go by a poll beside it, on a second connection. Its bit stays 0, with 1 a NORD
// module keeps its last outputs (BU 0280 4.2.1).
TEST(ProcessData, BitStrobeWithAPollBesideIt) {
  ScannerRun run{oneOf(IoKind::kStrobe, 5, 5)};
  run.output = {0x01, 0x7F, 0x04, 0x00, 0x20};
  run.devices[0]->input = {0x00, 0x37, 0x0B, 0x00, 0x20};
  run.begin();
  ASSERT_TRUE(run.runUntil([&] { return run.scanner.input(0).count > 0; }, seconds{3}));
  const std::vector<std::string> start(run.seen.end() - 18, run.seen.end());
  EXPECT_THAT(start,
              testing::ElementsAre("> 42E#404B03010600",  // allocate: polled and bit strobed
                                   "< 42B#40CB00",
                                   "> 42C#000E050207",  // poll: produced size
                                   "< 42B#008E0500",
                                   "> 42C#400E050208",  // consumed size
                                   "< 42B#408E0500",
                                   "> 42C#000E050307",  // bit strobe: produced size
                                   "< 42B#008E0500",
                                   "> 42C#400E050308",  // it consumes the eight bytes of the command
                                   "< 42B#408E0800",
                                   "> 42C#00100503091900",  // expected packet rate 25 ms, rounded to 30
                                   "< 42B#00901E00", "> 42C#40100502091900", "< 42B#40901E00", "> 42D#017F040020",
                                   "> 400#0000000000000000", "< 3C5#00370B0020", "< 385#00370B0020"));
  run.run(milliseconds{100});
  EXPECT_THAT(run.seen, testing::Contains("> 42D#017F040020"));
  EXPECT_THAT(run.seen, testing::Contains("< 3C5#00370B0020"));
  EXPECT_THAT(run.seen, testing::Not(testing::Contains("> 400#2000000000000000")));
  EXPECT_EQ(ByteView{run.output}, ByteView{run.devices[0]->output});
  // The inputs are those of the strobe; the answer to the poll says that the outputs have come.
  const auto before = run.scanner.input(0).count;
  run.loses = [](const CanFrame& frame) { return frame.id == 0x385; };
  run.run(milliseconds{50});
  EXPECT_EQ(before, run.scanner.input(0).count);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
  run.loses = nullptr;
  run.run(milliseconds{50});
  run.loses = [](const CanFrame& frame) { return frame.id == 0x3C5; };
  EXPECT_TRUE(run.reaches(NodeState::kLost, milliseconds{200}));
  EXPECT_EQ("gave no answer to our poll for 120 ms", run.eventText(DevicenetEventKind::kNodeLost));
  run.loses = nullptr;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  run.loses = [](const CanFrame& frame) { return frame.id == 0x385; };
  EXPECT_TRUE(run.reaches(NodeState::kLost, milliseconds{200})) << "and the other way round";
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// Change of state: sent when it changes, and at the expected packet rate; acknowledged both ways.
TEST(ProcessData, ChangeOfState) {
  ScannerRun run{oneOf(IoKind::kChangeOfState, 5, 5)};
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(0x11, run.devices[0]->held);
  run.run(milliseconds{200});
  std::size_t before = run.devices[0]->outputs;
  run.run(milliseconds{600});
  EXPECT_THAT(run.devices[0]->outputs - before, testing::AllOf(testing::Ge(20u), testing::Le(30u)))
      << "unchanged: at the rate of 30 ms, never later";
  before = run.devices[0]->outputs;
  for (std::uint8_t i = 1; i <= 20; ++i) {
    run.output[4] = i;
    run.run(milliseconds{10});
    EXPECT_EQ(run.output, run.devices[0]->output);
  }
  EXPECT_EQ(before + 20, run.devices[0]->outputs) << "changed: in every cycle";
  run.devices[0]->input = {1, 2, 3, 4, 5};
  run.run(milliseconds{3});
  EXPECT_EQ(ByteView{run.devices[0]->input}, ByteView{run.scanner.input(0).bytes});
  EXPECT_THAT(run.seen, testing::Contains("> 42A#"));
  EXPECT_EQ(0u, run.devices[0]->repeated_productions) << "acknowledged in time";
  EXPECT_EQ(0u, run.scanner.status(0).counters.unacknowledged);
  EXPECT_EQ(0u, run.devices[0]->io_deaths);
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// Without an acknowledge it is repeated once; when none comes for four times the rate the device is lost.
TEST(ProcessData, Unacknowledged) {
  ScannerRun run{oneOf(IoKind::kChangeOfState, 5, 5)};
  ASSERT_TRUE(run.starts());
  int dropped = 0;
  run.loses = [&dropped](const CanFrame& frame) { return frame.id == 0x3C5 && dropped++ == 0; };
  run.run(milliseconds{200});
  EXPECT_EQ(1u, run.scanner.status(0).counters.unacknowledged);
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
  run.devices[0]->mute_acknowledges = true;
  ASSERT_TRUE(run.reaches(NodeState::kLost, milliseconds{200}));
  EXPECT_EQ("acknowledged no data for 120 ms", run.eventText(DevicenetEventKind::kNodeLost));
}

// However long nobody acknowledges: each message is sent twice, never more often.
TEST(ProcessData, RepeatedOnce) {
  ScannerConfig config = oneOf(IoKind::kChangeOfState, 5, 5);
  config.nodes[0].io.expected_packet_rate = milliseconds{200};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{50});
  run.devices[0]->mute_acknowledges = true;
  run.output[4] = 0x55;
  const std::size_t before = run.sentTo("42D");
  run.run(milliseconds{100});
  EXPECT_EQ(before + 2, run.sentTo("42D"));
  EXPECT_EQ(2u, run.scanner.status(0).counters.unacknowledged);
}

// A message that was not given out before the next cycle is dropped, and counted.
TEST(ProcessData, SupersededByTheNextCycle) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.scanner.startCycle(run.now);
  run.scanner.startCycle(run.now + milliseconds{10});
  EXPECT_EQ(1u, run.scanner.counters().superseded);
  EXPECT_EQ(1u, run.scanner.status(0).counters.superseded);
}

// Suppressed: allocated so, nobody acknowledges, nobody waits for it.
TEST(ProcessData, AcknowledgeSuppressed) {
  ScannerRun run{oneOf(IoKind::kChangeOfState, 5, 5, false)};
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(0x51, run.devices[0]->held);
  run.run(seconds{1});
  EXPECT_EQ(0u, run.sentTo("42A"));
  EXPECT_EQ(0u, run.scanner.status(0).counters.unacknowledged);
  EXPECT_TRUE(run.allExchanging());
  run.devices[0]->deaf_to_io = true;
  ASSERT_TRUE(run.reaches(NodeState::kLost, milliseconds{200}));
  EXPECT_EQ("sent no data for 120 ms", run.eventText(DevicenetEventKind::kNodeLost));
  run.run(milliseconds{225});
  EXPECT_EQ(0x11, run.devices[0]->released_last) << "the bits that name connections";
}

// Cyclic: at the expected packet rate, whatever changes.
TEST(ProcessData, Cyclic) {
  ScannerRun run{oneOf(IoKind::kCyclic, 33, 33)};
  run.output = Bytes(33, 1);
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(0x21, run.devices[0]->held);
  const std::size_t before = run.devices[0]->outputs;
  run.before_cycle = [&run] { ++run.output[0]; };
  run.run(milliseconds{600});
  EXPECT_THAT(run.devices[0]->outputs - before, testing::AllOf(testing::Ge(20u), testing::Le(30u)));
  EXPECT_EQ(33u, run.scanner.input(0).bytes.size());
  EXPECT_EQ(0u, run.devices[0]->io_deaths);
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// A value nobody renews does not stay alive: without cycles nothing is sent, and the device times out.
TEST(ProcessData, NothingIsSentBetweenCycles) {
  for (const IoKind kind : {IoKind::kPoll, IoKind::kChangeOfState, IoKind::kCyclic}) {
    ScannerRun run{oneOf(kind, 5, 5)};
    ASSERT_TRUE(run.starts());
    run.run(milliseconds{100});
    const std::size_t outputs = run.devices[0]->outputs;
    for (int i = 0; i < 100; ++i) {
      run.now += milliseconds{1};
      run.devices[0]->tick(run.now);
      CanFrame frame;
      while (run.devices[0]->next(frame)) run.deliver(frame);
      run.scanner.poll(run.now);
      run.pump();
    }
    EXPECT_EQ(outputs, run.devices[0]->outputs) << toText(kind);
  }
}

// The link has no room: what was due in a cycle is not sent later.
TEST(ProcessData, FullLink) {
  ScannerRun run{busConfig(3)};
  ASSERT_TRUE(run.starts());
  run.output[4] = 0x11;
  run.link_full = true;
  run.run(milliseconds{20});
  run.link_full = false;
  CanFrame frame;
  EXPECT_FALSE(run.scanner.pollTransmit(frame));
  EXPECT_LE(6u, run.scanner.counters().superseded);
  EXPECT_LT(0u, run.scanner.counters().not_sent);
  run.output[4] = 0x22;
  run.run(milliseconds{20});
  EXPECT_EQ(0x22, run.devices[2]->output[4]);
  EXPECT_TRUE(run.allExchanging());
}

// Dropped because the link was full, whatever frame it refused: a changed value, which may be a stop, goes out in the next
// cycle, not one expected packet rate later.
TEST(ProcessData, AChangeThatWasDroppedIsSentInTheNextCycle) {
  for (const bool refuses_an_acknowledge : {true, false}) {
    for (const std::size_t size : {std::size_t{5}, std::size_t{33}}) {
      ScannerConfig config = oneOf(IoKind::kChangeOfState, size, size);
      config.nodes[0].io.expected_packet_rate = seconds{1};
      ScannerRun run{config};
      run.output.resize(size);
      ASSERT_TRUE(run.starts());
      run.run(milliseconds{50});
      run.output[1] = 0x7B;
      if (refuses_an_acknowledge) run.devices[0]->input = {1, 2, 3, 4, 5};
      run.link_full = true;
      run.run(milliseconds{10});
      run.link_full = false;
      ASSERT_NE(run.output, run.devices[0]->output);
      run.run(milliseconds{10});
      EXPECT_EQ(run.output, run.devices[0]->output) << refuses_an_acknowledge << ", " << size << " bytes";
      const std::size_t outputs = run.devices[0]->outputs;
      run.run(milliseconds{100});
      EXPECT_EQ(outputs, run.devices[0]->outputs) << "once";
    }
  }
}

// Cyclic: one that was refused is made up for in the next cycle too; else the device would hear nothing for two rates.
TEST(ProcessData, ACyclicMessageThatWasRefusedIsSentInTheNextCycle) {
  ScannerConfig config = oneOf(IoKind::kCyclic, 5, 5);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.output[1] = 0x7B;
  run.link_full = true;
  ASSERT_TRUE(run.runUntil([&run] { return run.scanner.counters().not_sent > 0; }, seconds{2}));
  run.link_full = false;
  run.run(milliseconds{10});
  EXPECT_EQ(run.output, run.devices[0]->output);
}

// Cyclic: what is not to wait for a rate of a second goes out in the next cycle, once.
TEST(ProcessData, ACyclicMessageThatIsHurriedIsSentInTheNextCycle) {
  ScannerConfig config = oneOf(IoKind::kCyclic, 5, 5);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  ScannerRun run{config};
  ASSERT_TRUE(run.starts());
  run.run(milliseconds{50});
  const std::uint64_t before = run.scanner.status(0).counters.outputs;
  run.output[1] = 0x7B;
  run.run(milliseconds{50});
  EXPECT_EQ(before, run.scanner.status(0).counters.outputs) << "by its rate";
  run.scanner.hurry(0);
  run.run(milliseconds{10});
  EXPECT_EQ(run.output, run.devices[0]->output);
  run.run(milliseconds{50});
  EXPECT_EQ(before + 1, run.scanner.status(0).counters.outputs);
}

// However soon somebody looks after a command went out: nobody is late yet, and nothing is sent twice.
TEST(ProcessData, ALookRightBehindACommandChangesNothing) {
  for (const IoKind kind : {IoKind::kPoll, IoKind::kStrobe, IoKind::kChangeOfState, IoKind::kCyclic}) {
    std::size_t sent[2] = {};
    for (const bool looks : {false, true}) {
      ScannerConfig config = busConfig(1);
      config.nodes[0].io.kind = kind;
      ScannerRun run{config};
      ASSERT_TRUE(run.starts()) << toText(kind);
      const std::size_t before = run.sentTo("42D");
      for (int i = 0; i < 500; ++i) {
        run.step();
        if (!looks) continue;
        run.scanner.poll(run.now);
        run.pump();
      }
      EXPECT_EQ(0u, run.scanner.status(0).counters.losses) << toText(kind);
      sent[looks ? 1 : 0] = run.sentTo("42D") - before;
    }
    EXPECT_EQ(sent[0], sent[1]) << toText(kind);
    EXPECT_GT(sent[0], 0u) << toText(kind);
  }
}

}  // namespace
}  // namespace nord_driver::devicenet
