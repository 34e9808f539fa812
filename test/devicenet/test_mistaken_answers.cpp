// Answers that are not to what was asked last: no loss of a connection is taken from them.
#include <gtest/gtest.h>

#include <string>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::seconds;

/// The beginning of a response of MAC id 5, under the transaction id of the request.
std::string responseTo(const CanFrame& request) {
  return (request.data[0] & 0x40u) != 0 ? "42B#40" : "42B#00";
}

// Two parameters were given up, so a keep-alive shares its transaction id with one of them, whose answer comes late. It is not
// the state of the connection: neither a value nor a state of another object, nor the refusal.
TEST(MistakenAnswers, ALateAnswerToAnotherRequestIsNoLoss) {
  for (const char* late : {"8EC800", "8E04", "9416FF"}) {
    ScannerRun run{busConfig(1)};
    ASSERT_TRUE(run.starts());
    run.loses = [](const CanFrame& frame) { return frame.id == 0x42C && frame.data[2] != 5; };
    for (std::uint8_t i = 1; i <= 2; ++i) ASSERT_TRUE(run.scanner.submit(0, getAttribute(i, 101, 1, i)));
    bool said = false;
    run.on_sent = [&](const CanFrame& frame) {
      if (said || frame.id != 0x42C || frame.data[2] != 5) return;
      said = true;
      run.devices[0]->say(nord_driver::frame(responseTo(frame) + late));
    };
    run.run(seconds{6});
    EXPECT_TRUE(said) << late;
    EXPECT_EQ(0u, run.scanner.status(0).counters.losses) << late;
    EXPECT_EQ(0x00, run.devices[0]->released_last) << late;
  }
}

// The same of a device without process data, which is asked for its explicit connection anew: the refusal is not of that.
TEST(MistakenAnswers, ALateRefusalIsNoneOfTheNewConnection) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.kind = IoKind::kNone;
  ScannerRun run{config};
  run.no_inputs = true;
  ASSERT_TRUE(run.starts());
  bool said = false;
  run.loses = [&said](const CanFrame& frame) { return !said && (frame.id == 0x42C || frame.id == 0x42E); };
  run.on_sent = [&](const CanFrame& frame) {
    if (said || frame.id != 0x42E) return;
    said = true;
    run.devices[0]->say(nord_driver::frame(responseTo(frame) + "9416FF"));
  };
  for (std::uint8_t i = 1; i <= 2; ++i) ASSERT_TRUE(run.scanner.submit(0, getAttribute(i, 101, 1, i)));
  run.run(seconds{6});
  EXPECT_TRUE(said);
  EXPECT_EQ(0u, run.scanner.status(0).counters.losses) << run.eventText(DevicenetEventKind::kNodeLost);
}

// What is no state of a connection is no answer to the question for it, whatever is owed.
TEST(MistakenAnswers, WhatIsNoStateOfAConnectionIsNoLoss) {
  for (const char* odd : {"8E", "8E06", "8E0400"}) {
    ScannerRun run{busConfig(1)};
    ASSERT_TRUE(run.starts());
    run.on_sent = [&](const CanFrame& frame) {
      if (frame.id == 0x42C) run.devices[0]->say(nord_driver::frame(responseTo(frame) + odd));
    };
    run.run(seconds{6});
    EXPECT_LT(1u, run.scanner.status(0).counters.keep_alives) << odd;
    EXPECT_EQ(0u, run.scanner.status(0).counters.losses) << odd;
  }
}

}  // namespace
}  // namespace nord_driver::devicenet
