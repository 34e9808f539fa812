// Change of state and cyclic: by which connection object (class 5) a device takes our data, 2 or 4, is what it answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

ScannerConfig oneOf(IoKind kind, std::size_t bytes = 5) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, kind, bytes, bytes)};
  return config;
}

/// Explicit messages from the allocation of the process data on, with their answers; the transaction bit is left out.
std::vector<std::string> connecting(const ScannerRun& run) {
  std::vector<std::string> found;
  for (std::string line : run.seen) {
    if (line.rfind("> 42E#", 0) == 0 && line.size() > 14) found.clear();
    const bool is_explicit = line.find(" 42E#") == 1 || line.find(" 42C#") == 1 || line.find(" 42B#") == 1;
    if (!is_explicit) continue;
    if (line[6] == '4') line[6] = '0';
    found.push_back(line);
  }
  return found;
}

/// Answers the question for the state of instance 2 with these bytes behind the header.
void answersState(ScannerRun& run, const FixedBytes<8>& body) {
  run.loses = [&run, body](const CanFrame& frame) {
    const bool asks =
        frame.id == 0x42C && frame.size == 5 && frame.data[2] == 5 && frame.data[3] == 2 && frame.data[4] == 1;
    if (!asks) return false;
    FixedBytes<8> answer{static_cast<std::uint8_t>(frame.data[0])};
    for (const std::uint8_t byte : body) answer.push_back(byte);
    run.devices[0]->say(dataFrame(0x42B, answer));
    return true;
  };
}

// Object 4 produces the inputs, object 2 consumes the outputs: the sizes are read where they are, and each gets its rate,
// 2 last, whose time-out stops the device.
TEST(ChangeConnections, ObjectTwoTakesOurData) {
  for (const IoKind kind : {IoKind::kChangeOfState, IoKind::kCyclic}) {
    ScannerRun run{oneOf(kind)};
    ASSERT_TRUE(run.starts()) << run.scanner.status(0).reason.str();
    EXPECT_THAT(connecting(run),
                ElementsAre(kind == IoKind::kCyclic ? "> 42E#004B03012000" : "> 42E#004B03011000", "< 42B#00CB00",
                            "> 42C#000E050407", "< 42B#008E0500",      // object 4: produced size
                            "> 42C#000E050201", "< 42B#008E01",        // object 2: its state is "configuring"
                            "> 42C#000E050208", "< 42B#008E0500",      // its consumed size
                            "> 42C#00100504091900", "< 42B#00901E00",  // the rate of 4
                            "> 42C#00100502091900", "< 42B#00901E00"))
        << "and that of 2, last";
    EXPECT_EQ(5, run.scanner.status(0).produced_size);
    EXPECT_EQ(5, run.scanner.status(0).consumed_size);
    run.run(seconds{1});
    EXPECT_TRUE(run.allExchanging());
    EXPECT_EQ(run.output, run.devices[0]->output);
    EXPECT_EQ(0u, run.devices[0]->io_deaths);
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// Without object 2, which a device says in three ways, 4 does both.
TEST(ChangeConnections, ObjectFourAlone) {
  const std::pair<const char*, FixedBytes<8>> answers[]{{"it does not exist", {0x94, 0x16, 0xFF}},
                                                        {"state 0", {0x8E, 0x00}},
                                                        {"it has no such attribute", {0x94, 0x14, 0xFF}},
                                                        {"no state in the answer", {0x8E}}};
  for (const auto& [what, answer] : answers) {
    ScannerRun run{oneOf(IoKind::kChangeOfState)};
    run.devices[0]->consumes_at_2 = false;
    answersState(run, answer);
    ASSERT_TRUE(run.starts()) << what << ": " << run.scanner.status(0).reason.str();
    std::vector<std::string> all = connecting(run);
    ASSERT_EQ(10u, all.size()) << what;
    all.erase(all.begin(), all.begin() + 4);
    EXPECT_EQ("> 42C#000E050201", all[0]) << what;
    all.erase(all.begin(), all.begin() + 2);
    EXPECT_THAT(all, ElementsAre("> 42C#000E050408", "< 42B#008E0500", "> 42C#00100504091900", "< 42B#00901E00"))
        << what;
    run.run(seconds{1});
    EXPECT_TRUE(run.allExchanging());
    EXPECT_EQ(run.output, run.devices[0]->output);
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// What it does is asked at each connection: another device may stand there.
TEST(ChangeConnections, AskedAnewAtEachConnection) {
  ScannerRun run{oneOf(IoKind::kChangeOfState)};
  for (const bool at_2 : {true, false, true}) {
    run.devices[0]->consumes_at_2 = at_2;
    if (run.scanner.status(0).counters.connections == 0) {
      ASSERT_TRUE(run.starts());
    } else {
      run.devices[0]->powerOff();
      ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
      run.devices[0]->powerOn();
      ASSERT_TRUE(run.reaches(NodeState::kExchanging, seconds{3})) << run.scanner.status(0).reason.str();
    }
    const std::vector<std::string> all = connecting(run);
    EXPECT_EQ(at_2 ? 1 : 0, std::count(all.begin(), all.end(), "> 42C#00100502091900"));
  }
}

// Is it still there? Asked of the one that takes our data.
TEST(ChangeConnections, TheStateIsAskedOfTheObjectThatTakesOurData) {
  for (const bool at_2 : {true, false}) {
    ScannerRun run{oneOf(IoKind::kCyclic)};
    run.devices[0]->consumes_at_2 = at_2;
    ASSERT_TRUE(run.starts());
    run.seen.clear();
    run.run(seconds{3});
    EXPECT_EQ(at_2 ? "> 42C#000E050201" : "> 42C#000E050401", connecting(run).front());
    EXPECT_TRUE(run.allExchanging());
  }
}

// No answer to the question is no answer "4 alone": the try has failed, and the next one begins with a release.
TEST(ChangeConnections, NoAnswerAboutObjectTwo) {
  ScannerRun run{oneOf(IoKind::kChangeOfState)};
  bool lost = true;
  run.loses = [&lost](const CanFrame& frame) {
    return lost && frame.id == 0x42C && frame.size == 5 && frame.data[2] == 5 && frame.data[3] == 2;
  };
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{4}));
  EXPECT_EQ("does not tell whether it takes process data by connection object 2", run.scanner.status(0).reason.str());
  run.run(milliseconds{50});
  EXPECT_EQ(0x11, run.devices[0]->released_last);
  EXPECT_EQ(0u, run.sentTo("42D"));
  lost = false;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{3}));
}

// Either one without a time-out would be a connection that outlives us.
TEST(ChangeConnections, TheRatesOfBothAreJudged) {
  for (const std::uint8_t instance : {std::uint8_t{4}, std::uint8_t{2}}) {
    ScannerRun run{oneOf(IoKind::kChangeOfState)};
    std::uint8_t written = 0;
    run.on_sent = [&written](const CanFrame& frame) {
      if (frame.id == 0x42C && frame.size == 7 && frame.data[1] == 0x10) written = frame.data[3];
    };
    run.loses = [&](const CanFrame& frame) {
      if (frame.id != 0x42B || frame.size != 4 || frame.data[1] != 0x90 || written != instance) return false;
      CanFrame changed = frame;
      changed.data[2] = changed.data[3] = 0;
      run.scanner.handleFrame(changed, run.now);
      return true;
    };
    run.begin();
    ASSERT_TRUE(run.reaches(NodeState::kRefused, seconds{4})) << unsigned{instance};
    EXPECT_EQ("answers an expected packet rate of 0: it would never notice that we are gone",
              run.scanner.status(0).reason.str());
    EXPECT_EQ(0u, run.sentTo("42D"));
  }
}

// Inputs alone have one connection object, and nothing is asked of another.
TEST(ChangeConnections, WithoutOutputsObjectTwoIsNotAskedFor) {
  ScannerConfig config = busConfig(0);
  config.nodes = {nodeConfig(5, IoKind::kCyclic, 5, 0)};
  ScannerRun run{config};
  run.devices[0]->consumes_at_2 = false;
  run.output.clear();
  ASSERT_TRUE(run.starts()) << run.scanner.status(0).reason.str();
  EXPECT_THAT(run.seen, testing::Not(testing::Contains(testing::HasSubstr("0E0502"))));
}

}  // namespace
}  // namespace nord_driver::devicenet
