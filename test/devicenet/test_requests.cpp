#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

std::vector<NodeAnswer> answers(ScannerRun& run, Duration span) {
  std::vector<NodeAnswer> all;
  for (const Instant end = run.now + span; run.now < end;) {
    run.step();
    while (const auto answer = run.scanner.pollAnswer()) all.push_back(*answer);
  }
  return all;
}

// Class and instance of one byte go up to FFh.
TEST(Requests, OneByteReachesTo255) {
  ExplicitBody body;
  EXPECT_TRUE(encode(getAttribute(1, 0xFF, 0xFF, 5), BodyFormat::k8Over8, body));
  EXPECT_EQ((std::vector<std::uint8_t>{0x0E, 0xFF, 0xFF, 5}), std::vector<std::uint8_t>(body.begin(), body.end()));
  EXPECT_FALSE(encode(getAttribute(1, 0x100, 1, 5), BodyFormat::k8Over8, body));
  EXPECT_FALSE(encode(getAttribute(1, 1, 0x100, 5), BodyFormat::k8Over8, body));
  EXPECT_TRUE(encode(getAttribute(1, 0x100, 1, 5), BodyFormat::k16Over8, body));
  EXPECT_TRUE(encode(getAttribute(1, 1, 0x100, 5), BodyFormat::k8Over16, body));
}

// One queue per device, first in, first out; each request has one answer with its number.
TEST(Requests, InTheirOrder) {
  ScannerRun run{busConfig(2)};
  for (unsigned i = 1; i <= 8; ++i) {
    run.devices[0]->attributes[{101, 1, i}] = {static_cast<std::uint8_t>(i), 0};
    run.devices[1]->attributes[{101, 1, i}] = {static_cast<std::uint8_t>(0x10 + i), 0};
  }
  ASSERT_TRUE(run.starts());
  for (std::uint8_t i = 1; i <= 8; ++i) {
    ASSERT_TRUE(run.scanner.submit(0, getAttribute(i, 101, 1, i)));
    ASSERT_TRUE(run.scanner.submit(1, getAttribute(i, 101, 1, i)));
  }
  EXPECT_FALSE(run.scanner.submit(0, getAttribute(9, 101, 1, 1))) << "eight are under way";
  std::array<std::uint32_t, 2> next{1, 1};
  for (const NodeAnswer& answer : answers(run, milliseconds{100})) {
    EXPECT_EQ(next[answer.node], answer.answer.id);
    EXPECT_EQ(next[answer.node] + 0x10 * answer.node, answer.answer.number());
    ++next[answer.node];
  }
  EXPECT_EQ((std::array<std::uint32_t, 2>{9, 9}), next);
}

// Written and read back, longer than a frame both ways.
TEST(Requests, LongData) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->attributes[{4, 100, 3}] = {};
  ASSERT_TRUE(run.starts());
  std::vector<std::uint8_t> data;
  for (std::uint8_t i = 0; i < 33; ++i) data.push_back(i);
  ASSERT_TRUE(run.scanner.submit(0, setAttribute(1, 4, 100, 3, ByteView{data})));
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(2, 4, 100, 3)));
  const auto all = answers(run, milliseconds{200});
  ASSERT_EQ(2u, all.size());
  EXPECT_TRUE(all[0].answer.ok());
  EXPECT_EQ(data, run.devices[0]->attributes.at({4, 100, 3}));
  EXPECT_EQ(ByteView{data}, ByteView{all[1].answer.data});
}

// BU 0280 4.1.1: parameters of an inverter that is not there answer "resource unavailable".
TEST(Requests, Refused) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->error = 0x02;
  ASSERT_TRUE(run.starts());
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 111, 1, 3)));
  const auto all = answers(run, milliseconds{50});
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ(ExplicitEnd::kRefused, all[0].answer.end);
  EXPECT_EQ(0x02, all[0].answer.general);
  EXPECT_EQ(1u, run.scanner.counters().request_errors);
  EXPECT_TRUE(run.allExchanging());
}

// A device that is not connected is answered for at once; a request under way ends when the connection does.
TEST(Requests, NotConnected) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 101, 1, 1)));
  auto answer = run.scanner.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(ExplicitEnd::kNotConnected, answer->answer.end);
  ASSERT_TRUE(run.starts());
  run.devices[0]->powerOff();
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(2, 101, 1, 1)));
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(3, 101, 1, 1)));
  const auto all = answers(run, seconds{1});
  ASSERT_EQ(2u, all.size());
  EXPECT_EQ(ExplicitEnd::kNotConnected, all[0].answer.end);
  EXPECT_EQ(3u, all[1].answer.id);
}

// Explicit messages fail while process data go on: each request times out, the device is not lost.
TEST(Requests, TimeOutBesideProcessData) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(0u, run.scanner.status(0).counters.repeated);
  run.devices[0]->deaf_to_explicit = true;
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 101, 1, 1)));
  const auto all = answers(run, seconds{9});
  EXPECT_GE(run.scanner.status(0).counters.repeated, 1u) << "counted, as whatever is repeated";
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ(ExplicitEnd::kTimedOut, all[0].answer.end);
  EXPECT_TRUE(run.allExchanging());
  EXPECT_EQ(0u, run.scanner.status(0).counters.losses);
  run.devices[0]->deaf_to_explicit = false;
  run.run(seconds{3});
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(2, 1, 1, 1)));
  const auto again = answers(run, seconds{1});
  ASSERT_EQ(1u, again.size());
  EXPECT_EQ(389u, again[0].answer.number());
}

// Two are given up, and their answers may be late: the third waits where the explicit connection is that of before, and not
// where the device had lost it.
TEST(Requests, WaitForLateAnswersOnlyOfTheConnectionOfBefore) {
  for (const bool survives : {false, true}) {
    ScannerRun run{busConfig(1)};
    run.devices[0]->attributes[{101, 1, 1}] = {1, 0};
    ASSERT_TRUE(run.starts());
    const std::size_t allocations = run.sentTo("42E");
    run.loses = [](const CanFrame& frame) { return frame.id == 0x42C; };
    for (std::uint8_t i = 1; i <= 3; ++i) ASSERT_TRUE(run.scanner.submit(0, getAttribute(i, 101, 1, 1)));
    if (!survives) run.devices[0]->held &= 0xFE;
    ASSERT_TRUE(run.runUntil([&] { return run.sentTo("42E") > allocations; }, seconds{4}));
    run.loses = nullptr;
    EXPECT_EQ(survives ? 2u : 3u, answers(run, milliseconds{100}).size()) << survives;
    EXPECT_EQ(survives ? 1u : 0u, answers(run, seconds{5}).size()) << survives;
    EXPECT_TRUE(run.allExchanging());
  }
}

// Requests without end do not starve the keep-alive of process data, nor the other way round.
TEST(Requests, BesideTheEngine) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->attributes[{101, 1, 1}] = {1, 0};
  ASSERT_TRUE(run.starts());
  std::size_t good = 0;
  for (int i = 0; i < 20000; ++i) {
    run.scanner.submit(0, getAttribute(1, 101, 1, 1));
    run.step();
    while (const auto answer = run.scanner.pollAnswer()) good += answer->answer.ok() ? 1 : 0;
    if (i == 10000) run.devices[0]->powerOff();
    if (i == 10200) run.devices[0]->powerOn();
  }
  EXPECT_LT(15000u, good);
  EXPECT_TRUE(run.allExchanging());
  EXPECT_EQ(1u, run.scanner.status(0).counters.losses);
}

}  // namespace
}  // namespace nord_driver::devicenet
