#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Starts a bus of one device that refuses; it is never polled. The reason.
std::string refusal(ScannerRun& run, Duration span = seconds{10}) {
  run.begin();
  run.run(span);
  EXPECT_EQ(NodeState::kRefused, run.scanner.status(0).state);
  EXPECT_EQ(0u, run.sentTo("42D"));
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kNodeRefused)) << "told once";
  EXPECT_THAT(run.violations(), testing::IsEmpty());
  return run.scanner.status(0).reason.str();
}

// Another device at that MAC id is named, let go, and not polled; the right one is taken when it comes.
TEST(Refusals, WrongDevice) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].vendor_id = std::uint16_t{389};
  config.nodes[0].device_type = std::uint16_t{2};
  config.nodes[0].product_code = std::uint16_t{8};
  ScannerRun run{config};
  EXPECT_EQ(
      "is another device than configured: vendor 389, device type 2, product code 7; expected vendor 389, device type "
      "2, product code 8",
      refusal(run));
  EXPECT_EQ(0, run.devices[0]->held);
  run.devices[0]->product = 8;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
}

// Its sizes are compared before the first poll; its parameters stay in reach, since P160 may be the reason.
TEST(Refusals, WrongSizes) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->produced = 8;
  run.devices[0]->consumed = 8;
  run.devices[0]->attributes[{181, 1, 60}] = {4, 0};
  EXPECT_EQ("sends 8 and takes 8 bytes of process data by poll; 5 and 5 are configured", refusal(run));
  EXPECT_EQ(8, run.scanner.status(0).produced_size);
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(9, 181, 1, 60)));
  run.run(milliseconds{50});
  const auto answer = run.scanner.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(4u, answer->answer.number());
  run.devices[0]->produced = run.devices[0]->consumed = 5;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  EXPECT_EQ(0x02, run.devices[0]->released_last) << "its explicit connection was never let go";
}

// A device without the sizes of its connection has nothing to be compared with what is configured.
TEST(Refusals, OfItsSizes) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->tells_sizes = false;
  EXPECT_EQ("does not tell the sizes of its process data: refuses: the attribute is not supported (14h)", refusal(run));
  run.devices[0]->tells_sizes = true;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
}

// By change of state object 2 takes our data where there is one; 4 takes acknowledges, of 0 bytes or, at Eaton, 8.
TEST(Refusals, SizesOfChangeOfState) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.kind = IoKind::kChangeOfState;
  for (const std::size_t size : {0u, 8u, 5u}) {
    ScannerRun run{config};
    run.devices[0]->acknowledge_size = size;
    EXPECT_TRUE(run.starts()) << size << ": " << run.scanner.status(0).reason.str();
  }
  {
    ScannerRun run{config};
    run.devices[0]->acknowledge_size = 5;
    run.devices[0]->consumed = 8;
    EXPECT_EQ(
        "sends 5 and takes 8 bytes of process data by change of state (connection objects 4 and 2); 5 and 5 are "
        "configured",
        refusal(run));
    EXPECT_EQ(8, run.scanner.status(0).consumed_size);
    EXPECT_EQ(0x10, run.devices[0]->released_last);
  }
  {
    ScannerRun run{config};
    run.devices[0]->produced = 8;
    EXPECT_EQ(
        "sends 8 and takes 5 bytes of process data by change of state (connection objects 4 and 2); 5 and 5 are "
        "configured",
        refusal(run));
  }
  for (const std::size_t size : {0u, 8u}) {
    ScannerRun run{config};
    run.devices[0]->consumes_at_2 = false;
    run.devices[0]->consumed = size;
    EXPECT_EQ("sends 5 and takes " + std::to_string(size) +
                  " bytes of process data by change of state; 5 and 5 are configured",
              refusal(run))
        << "4 alone";
  }
}

// Refused, and switched off and on meanwhile: its explicit connection is gone, which is noticed without anybody asking.
TEST(Refusals, PowerCycleWhileRefused) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->produced = 8;
  refusal(run);
  run.devices[0]->powerOff();
  run.run(milliseconds{100});
  run.devices[0]->powerOn();
  run.devices[0]->produced = 5;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  EXPECT_EQ(0u, run.devices[0]->io_before_explicit);
}

// Refused for its sizes it keeps the explicit connection alone, and that is what is let go at the end.
TEST(Refusals, ReleasesTheExplicitConnectionOfARefusedDevice) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->produced = 8;
  refusal(run, seconds{4});
  EXPECT_EQ(0x01, run.devices[0]->held);
  EXPECT_EQ(0x02, run.devices[0]->released_last);
  run.scanner.releaseAll(run.now);
  EXPECT_TRUE(run.runUntil([&] { return run.scanner.released(); }, seconds{1}));
  EXPECT_EQ(0x01, run.devices[0]->released_last);
  EXPECT_EQ(0x00, run.devices[0]->held);
}

TEST(Refusals, NoSuchConnection) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.kind = IoKind::kStrobe;
  ScannerRun run{config};
  run.loses = [&](const CanFrame& frame) {
    if (frame.id != 0x42E || frame.size != 6 || frame.data[4] != 0x06) return false;
    run.devices[0]->say(dataFrame(0x42B, FixedBytes<8>{static_cast<std::uint8_t>(frame.data[0]), 0x94, 0x20, 0x02}));
    return true;
  };
  EXPECT_EQ(
      "does not exchange process data by bit strobe: refuses: a parameter of the request is invalid (20h): invalid "
      "allocation "
      "choice, it does not have these connections (additional code 02h)",
      refusal(run));
  EXPECT_LE(run.scanner.status(0).counters.refusals, 10u) << "tried again once a second, in 8 s";
  // What was refused is not held: only the explicit connection is let go.
  run.scanner.releaseAll(run.now);
  EXPECT_TRUE(run.runUntil([&] { return run.scanner.released(); }, seconds{1}));
  EXPECT_EQ(0x01, run.devices[0]->released_last);
  EXPECT_EQ(0x00, run.devices[0]->held);
}

// The device belongs to another master: named where it tells, asked again, never disturbed otherwise.
TEST(Refusals, AnothersDevice) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(17, 0x03, run.now);
  run.devices[0]->explicit_rate = 60000;
  EXPECT_EQ("is allocated to another master, MAC id 17", refusal(run));
  EXPECT_EQ(std::uint8_t{17}, run.scanner.status(0).owner);
  EXPECT_EQ(0x03, run.devices[0]->held);
  EXPECT_EQ(0u, run.sentTo("42C")) << "its explicit connection is the other's";
  EXPECT_EQ(0, run.devices[0]->released_last);
  run.devices[0]->held = 0;
  run.devices[0]->master = 0xFF;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
  EXPECT_FALSE(run.scanner.status(0).owner);
}

TEST(Refusals, AnothersDeviceThatDoesNotTell) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(17, 0x03, run.now);
  run.devices[0]->explicit_rate = 60000;
  run.devices[0]->tells_owner = false;
  EXPECT_EQ("is allocated to another master and does not tell to which", refusal(run));
  EXPECT_EQ(0x03, run.devices[0]->held);
}

// The other master was heard to ask it: then its name is known without a question.
TEST(Refusals, AnothersDeviceWhoseMasterIsHeard) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(17, 0x03, run.now);
  run.devices[0]->explicit_rate = 60000;
  run.devices[0]->tells_owner = false;
  run.before_cycle = [&] { run.say("42C#110E010101"); };
  EXPECT_EQ("is allocated to another master, MAC id 17", refusal(run));
  EXPECT_THAT(run.eventText(DevicenetEventKind::kSecondScanner),
              testing::HasSubstr("another master, MAC id 17, is on the bus: it sends an explicit request to MAC id 5"));
}

TEST(Refusals, BodyFormatNobodySpeaks) {
  ScannerRun run{busConfig(1)};
  run.loses = [&](const CanFrame& frame) {
    if (frame.id != 0x42B || frame.size != 3 || frame.data[1] != 0xCB) return false;
    CanFrame changed = frame;
    changed.data[2] = 4;
    run.scanner.handleFrame(changed, run.now);
    return true;
  };
  EXPECT_EQ("wants explicit messages of body format 4 in 1 bytes; 0 to 3 in one byte is spoken here", refusal(run));
}

TEST(Refusals, BodyFormatNobodyTells) {
  ScannerRun run{busConfig(1)};
  run.loses = [&](const CanFrame& frame) {
    if (frame.id != 0x42B || frame.size != 3 || frame.data[1] != 0xCB) return false;
    CanFrame changed = frame;
    changed.size = 2;
    run.scanner.handleFrame(changed, run.now);
    return true;
  };
  EXPECT_EQ("wants explicit messages of body format 0 in 0 bytes; 0 to 3 in one byte is spoken here", refusal(run));
}

/// The device's answer tells another expected packet rate, in ms.
void answersRate(ScannerRun& run, std::uint8_t rate) {
  run.loses = [&run, rate](const CanFrame& frame) {
    if (frame.id != 0x42B || frame.size != 4 || frame.data[1] != 0x90) return false;
    CanFrame changed = frame;
    changed.data[2] = rate;
    changed.data[3] = 0;
    run.scanner.handleFrame(changed, run.now);
    return true;
  };
}

// A device that would never notice that we are gone is not driven.
TEST(Refusals, RatesThatDoNotProtect) {
  {
    ScannerRun run{busConfig(1)};
    answersRate(run, 0);
    EXPECT_EQ("answers an expected packet rate of 0: it would never notice that we are gone", refusal(run));
  }
  ScannerConfig config = busConfig(1);
  config.cycle_time = milliseconds{100};
  ScannerRun run{config};
  answersRate(run, 40);
  EXPECT_EQ(
      "answers an expected packet rate of 40 ms: it gives up after four times that, less than two of our cycles of "
      "100.0 ms",
      refusal(run));
}

TEST(Refusals, RateThatIsNoRounding) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->rate_step = 1000;
  EXPECT_EQ(
      "answers an expected packet rate of 1000 ms where 25 ms was asked for: it would stop only 4000 ms after we are "
      "gone",
      refusal(run));
  run.devices[0]->rate_step = 100;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{2}));
}

TEST(Refusals, NoRateAtAll) {
  ScannerRun run{busConfig(1)};
  run.loses = [&](const CanFrame& frame) {
    if (frame.id != 0x42B || frame.size != 4 || frame.data[1] != 0x90) return false;
    CanFrame changed = frame;
    changed.data[1] = 0x94;
    changed.data[2] = 0x0E;
    changed.data[3] = 0xFF;
    run.scanner.handleFrame(changed, run.now);
    return true;
  };
  EXPECT_EQ("does not take its expected packet rate: refuses: the attribute cannot be set (0Eh)", refusal(run));
}

// A request without a header names nobody: that it is none of MAC id 0, which is ours here, is not known.
TEST(Refusals, AnEmptyRequestNamesNoMaster) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->belongsTo(17, 0x03, run.now);
  run.devices[0]->explicit_rate = 60000;
  run.devices[0]->tells_owner = false;
  run.before_cycle = [&] { run.say("42C#"); };
  EXPECT_EQ("is allocated to another master and does not tell to which", refusal(run));
  EXPECT_EQ("another master is on the bus: it sends an explicit request to MAC id 5 (42Ch), which only we should",
            run.eventText(DevicenetEventKind::kSecondScanner));
}

// 100 ms more than was asked for, and a time-out of two of our cycles, are within what is taken.
TEST(Refusals, RatesJustWithinTheirBounds) {
  ScannerRun coarse{busConfig(1)};
  coarse.devices[0]->rate_step = 126;
  EXPECT_EQ(
      "answers an expected packet rate of 126 ms where 25 ms was asked for: it would stop only 504 ms after we are "
      "gone",
      refusal(coarse));
  coarse.devices[0]->rate_step = 125;
  EXPECT_TRUE(coarse.reaches(NodeState::kExchanging, seconds{2}));
  ScannerConfig config = busConfig(1);
  config.cycle_time = milliseconds{100};
  ScannerRun run{config};
  answersRate(run, 50);
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{4}));
  EXPECT_EQ(milliseconds{50}, run.scanner.status(0).packet_rate);
}

}  // namespace
}  // namespace nord_driver::devicenet
