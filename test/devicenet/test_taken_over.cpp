// Modules that a killed driver has left with a turning motor, and a driver that starts behind it: process data of before are
// let go after the module's own time-out, and never before. What comes of the start then, or when it is broken off, is no
// matter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr std::uint8_t kExplicitAndPoll = 0x03, kPollAlone = 0x02;

ScannerConfig slowConfig(IoKind kind = IoKind::kPoll) {
  ScannerConfig config = busConfig(1);
  config.nodes[0] = nodeConfig(5, kind);
  config.nodes[0].io.expected_packet_rate = seconds{1};
  return config;
}

/// The time-out of a second's rate begins when the driver does: it is over two seconds after the check for its MAC id. The module
/// does not take a shorter one.
void beginsBehind(ScannerRun& run) {
  run.begin();
  run.devices[0]->keeps_rate = true;
  run.devices[0]->wasPolledBy(0, 1000, run.now);
}

/// Bits of connections for process data that were released before it stopped.
std::uint8_t releasedBeforeItStopped(ScannerRun& run, Duration span) {
  std::uint8_t released = 0;
  run.on_sent = [&](const CanFrame& frame) {
    const bool releases = frame.id == 0x42E && frame.size == 5 && frame.data[1] == 0x4C;
    if (releases && run.devices[0]->io_deaths == 0)
      released = static_cast<std::uint8_t>(released | (frame.data[4] & 0x3E));
  };
  run.run(span);
  run.on_sent = nullptr;
  return released;
}

bool asks(const CanFrame& frame, std::uint8_t class_id, std::uint8_t instance, std::uint8_t attribute) {
  return frame.id == 0x42C && frame.size == 5 && frame.data[1] == 0x0E && frame.data[2] == class_id &&
         frame.data[3] == instance && frame.data[4] == attribute;
}

// However much of it the module tells.
TEST(TakenOver, ItsOwnTimeOutStopsItFirst) {
  struct Told {
    bool owner, choice;
  };
  for (const Told tells : {Told{true, true}, Told{false, true}, Told{true, false}}) {
    ScannerRun run{slowConfig()};
    FakeDevice& device = *run.devices[0];
    device.tells_owner = tells.owner;
    device.tells_choice = tells.choice;
    device.timeout_step = milliseconds{100};
    beginsBehind(run);
    EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{4050}));
    EXPECT_EQ(NodeState::kAbsent, run.scanner.status(0).state);
    EXPECT_STREQ(
        "has process data of ours from before, with a time-out of 4.0 s: they are not released before that has run "
        "out, "
        "since it may be all that stops the motor",
        run.scanner.status(0).reason.c_str());
    EXPECT_TRUE(run.scanner.isLeftAlone(0));
    ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{500})) << run.scanner.status(0).reason.c_str();
    EXPECT_EQ(1u, device.io_deaths);
    EXPECT_EQ(kExplicitAndPoll, device.released_last);
    EXPECT_FALSE(run.scanner.isLeftAlone(0));
    EXPECT_STREQ("", run.scanner.status(0).reason.c_str());
    EXPECT_EQ(0u, run.scanner.status(0).counters.refusals + run.scanner.status(0).counters.losses);
    run.run(seconds{10});
    EXPECT_TRUE(run.allExchanging());
    EXPECT_EQ(1u, device.io_deaths);
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// A long time-out, or none, is brought forward: the motor does not turn for as long as the driver before was allowed to be silent.
TEST(TakenOver, ItsOwnTimeOutIsBroughtForward) {
  for (const unsigned before : {0u, 1000u, 65535u}) {
    for (const std::uint8_t held : {kExplicitAndPoll, kPollAlone}) {
      ScannerRun run{slowConfig()};
      FakeDevice& device = *run.devices[0];
      run.begin();
      device.wasPolledBy(0, before, run.now);
      device.held = held;
      EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{2800})) << before;
      EXPECT_EQ(1u, device.io_deaths) << before;
      ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{200})) << run.scanner.status(0).reason.c_str();
      run.run(seconds{10});
      EXPECT_EQ(1u, device.io_deaths) << before;
      EXPECT_TRUE(run.allExchanging());
      EXPECT_THAT(run.violations(), testing::IsEmpty());
    }
  }
}

// Each writing begins the time-out anew: a module that makes a long one of a short one would never stop.
TEST(TakenOver, ItIsWrittenOnce) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  device.rate_step = 1000;
  run.begin();
  device.wasPolledBy(0, 10000, run.now);
  EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{6300}));
  EXPECT_EQ(1u, device.io_deaths);
}

// The answers to two writings are lost, and so is what they were to bring about.
TEST(TakenOver, AWritingThatIsLostIsRepeated) {
  for (const unsigned before : {0u, 65535u}) {
    ScannerRun run{slowConfig()};
    FakeDevice& device = *run.devices[0];
    run.begin();
    device.wasPolledBy(0, before, run.now);
    int writings = 0;
    run.loses = [&](const CanFrame& frame) {
      const bool writes = frame.id == 0x42C && frame.size == 7 && frame.data[1] == 0x10 && frame.data[2] == 5;
      return writes && ++writings <= 2;
    };
    EXPECT_EQ(0, releasedBeforeItStopped(run, seconds{5})) << before;
    EXPECT_EQ(1u, device.io_deaths) << before;
    EXPECT_TRUE(run.allExchanging()) << run.scanner.status(0).reason.c_str();
  }
}

// As by a bit strobe for others, or by itself: its time-out never comes, and is not waited for without an end.
TEST(TakenOver, OneThatIsFed) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  run.begin();
  device.wasPolledBy(0, 1000, run.now);
  run.before_cycle = [&] {
    const bool is_of_before = device.released_last == 0;
    if (is_of_before) device.receive(frame("42D#007E040000"), run.now);
  };
  run.run(milliseconds{2600});
  EXPECT_EQ(0, device.released_last);
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{600})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(0u, device.io_deaths);
}

// Another device than configured, other sizes, a rate that does not protect: said when it has stopped.
TEST(TakenOver, ARefusalDoesNotLetItRunOn) {
  ScannerConfig identity = slowConfig(), sizes = slowConfig(), rate = slowConfig();
  identity.nodes[0].product_code = std::uint16_t{4711};
  sizes.nodes[0].io.input_bytes = 8;
  rate.nodes[0].io.expected_packet_rate = milliseconds{50};
  for (const ScannerConfig& config : {identity, sizes, rate}) {
    ScannerRun run{config};
    FakeDevice& device = *run.devices[0];
    device.produced = 5;
    device.rate_step = 1000;
    beginsBehind(run);
    EXPECT_EQ(0, releasedBeforeItStopped(run, seconds{6}));
    EXPECT_EQ(1u, device.io_deaths);
    EXPECT_EQ(NodeState::kRefused, run.scanner.status(0).state) << run.scanner.status(0).reason.c_str();
  }
}

// A clean exit, at whatever moment of the start.
TEST(TakenOver, AnExitDoesNotLetItRunOn) {
  for (int after = 1990; after < 4300; after += after < 2040 || after > 3990 ? 1 : 51) {
    ScannerRun run{slowConfig()};
    FakeDevice& device = *run.devices[0];
    beginsBehind(run);
    run.run(milliseconds{after});
    run.scanner.releaseAll(run.now);
    run.runUntil([&] { return run.scanner.released(); }, seconds{1});
    EXPECT_TRUE(run.scanner.released()) << after;
    run.run(seconds{4});
    EXPECT_EQ(1u, device.io_deaths) << after;
  }
}

// The explicit connection has died of idleness, the process data run: then a new one is there to ask by.
TEST(TakenOver, WhatIsLeftOfIt) {
  for (const bool exits : {false, true}) {
    ScannerRun run{slowConfig()};
    FakeDevice& device = *run.devices[0];
    beginsBehind(run);
    device.held = kPollAlone;
    EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{3990}));
    EXPECT_EQ(0x03, device.held) << "a new explicit connection";
    EXPECT_THAT(run.scanner.status(0).reason.str(), HasSubstr("has process data of ours from before"));
    EXPECT_TRUE(run.scanner.isLeftAlone(0));
    if (!exits) {
      ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{400})) << run.scanner.status(0).reason.c_str();
      EXPECT_EQ(1u, device.io_deaths);
      EXPECT_EQ(kPollAlone, device.released_last);
      EXPECT_STREQ("", run.scanner.status(0).reason.c_str());
    } else {
      run.scanner.releaseAll(run.now);
      ASSERT_TRUE(run.runUntil([&] { return run.scanner.released(); }, seconds{1}));
      EXPECT_EQ(0x01, device.released_last);
      run.run(seconds{1});
      EXPECT_EQ(1u, device.io_deaths);
    }
    EXPECT_THAT(run.violations(), testing::IsEmpty());
  }
}

// Nobody answers the allocation that would tell that they are there: what was not granted is not released.
TEST(TakenOver, WhatIsLeftOfItAndDoesNotAnswer) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  beginsBehind(run);
  device.held = kPollAlone;
  run.loses = [](const CanFrame& frame) {
    return frame.id == 0x42E && frame.size == 6 && frame.data[1] == 0x4B && frame.data[4] == kPollAlone;
  };
  EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{4050}));
  EXPECT_EQ(1u, device.io_deaths);
  run.loses = nullptr;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{3})) << run.scanner.status(0).reason.c_str();
}

// The driver before exchanged otherwise: all that was its is gone before ours begins, and no time-out of it comes later.
TEST(TakenOver, AnotherKindOfBefore) {
  struct Case {
    std::uint8_t before;
    IoKind now;
  };
  for (const Case& each :
       {Case{0x03, IoKind::kChangeOfState}, Case{0x21, IoKind::kPoll}, Case{0x21, IoKind::kChangeOfState},
        Case{0x03, IoKind::kStrobe}, Case{0x51, IoKind::kCyclic}}) {
    ScannerRun run{slowConfig(each.now)};
    FakeDevice& device = *run.devices[0];
    beginsBehind(run);
    device.held = each.before;
    EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{3990})) << toText(each.now);
    ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{600})) << run.scanner.status(0).reason.c_str();
    EXPECT_EQ(1u, device.io_deaths) << toText(each.now);
    EXPECT_EQ(each.before & 0x3F, device.released_last) << toText(each.now);
    EXPECT_EQ(ioChoice(slowConfig(each.now).nodes[0].io) | 0x01, device.held) << toText(each.now);
  }
}

// It does not answer on the explicit connection of before: a new one is allocated, and it is asked by that.
TEST(TakenOver, AnExplicitConnectionOfBeforeThatDoesNotAnswer) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  beginsBehind(run);
  run.loses = [&](const CanFrame& frame) { return frame.id == 0x42C && device.allocated_last == 0; };
  EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{3990}));
  EXPECT_EQ(0x01, device.released_last);
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{400})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(1u, device.io_deaths);
  EXPECT_THAT(run.violations(), testing::IsEmpty());
}

// An answer may be one to an earlier request, and tell of another connection: it is asked by a new explicit connection, which
// owes none.
TEST(TakenOver, AnswersThatMayBeLate) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  beginsBehind(run);
  // Of two requests the first answer is lost: with both transaction ids one is owed.
  std::array<std::size_t, 10> answers{};
  std::uint8_t asked = 0;
  run.loses = [&](const CanFrame& frame) {
    for (const std::uint8_t attribute : {std::uint8_t{1}, std::uint8_t{9}}) {
      if (asks(frame, 5, 2, attribute)) asked = attribute;
    }
    return frame.id == 0x42B && asked != 0 && answers[asked]++ == 0;
  };
  EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{3990}));
  EXPECT_EQ(0x01, device.released_last);
  EXPECT_EQ(1u, run.scanner.status(0).counters.allocations);
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{400})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(1u, device.io_deaths);
}

// One that runs has a time-out, whether or not it tells how long that is.
TEST(TakenOver, OneThatDoesNotTellItsTimeOut) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  beginsBehind(run);
  run.loses = [&](const CanFrame& frame) {
    if (!asks(frame, 5, 2, 9)) return false;
    device.say(dataFrame(0x42B, FixedBytes<8>{static_cast<std::uint8_t>(frame.data[0]), 0x94, 0x14, 0xFF}));
    return true;
  };
  EXPECT_EQ(0, releasedBeforeItStopped(run, milliseconds{3990}));
  ASSERT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{400})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(1u, device.io_deaths);
}

// Neither does it tell whether they run, nor is anything else to be had: words stop it then.
TEST(TakenOver, OneThatDoesNotTellTheStateOfItsConnections) {
  ScannerRun run{slowConfig()};
  FakeDevice& device = *run.devices[0];
  beginsBehind(run);
  run.loses = [&](const CanFrame& frame) {
    if (!asks(frame, 5, 2, 1)) return false;
    device.say(dataFrame(0x42B, FixedBytes<8>{static_cast<std::uint8_t>(frame.data[0]), 0x94, 0x14, 0xFF}));
    return true;
  };
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{2300})) << run.scanner.status(0).reason.c_str();
  EXPECT_EQ(kPollAlone, device.released_last);
}

// One without a time-out is not waited for: words are all that stops it.
TEST(TakenOver, OneThatHasNoTimeOut) {
  ScannerRun run{slowConfig()};
  beginsBehind(run);  // and takes none
  run.devices[0]->rate = 0;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{2300})) << run.scanner.status(0).reason.c_str();
}

// It is granted to another while its time-out is awaited: nothing of it is ours any more.
TEST(TakenOver, OneThatAnotherIsGrantedMeanwhile) {
  for (const std::uint8_t held : {kExplicitAndPoll, kPollAlone}) {
    ScannerRun run{slowConfig()};
    FakeDevice& device = *run.devices[0];
    beginsBehind(run);
    device.held = held;
    run.run(milliseconds{3000});
    device.powerOn();
    device.obeys_anybody = true;
    device.explicit_rate = 60000;
    device.released_last = 0;
    device.belongsTo(17, 0x03, run.now);
    run.say("42E#114B03010311");
    run.say("42B#11CB00");
    run.run(seconds{3});
    EXPECT_EQ(0, device.released_last);
    EXPECT_STREQ("is allocated to another master, MAC id 17", run.scanner.status(0).reason.c_str());
  }
}

// By the defaults its time-out is over before the check for our MAC id is: nothing more is waited for.
TEST(TakenOver, AShortTimeOutDelaysNothing) {
  ScannerRun run{busConfig(1)};
  run.begin();
  run.devices[0]->wasPolledBy(0, 100, run.now);
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, milliseconds{2100}));
  EXPECT_EQ(1u, run.devices[0]->io_deaths);
}

}  // namespace
}  // namespace nord_driver::devicenet
