#include <gtest/gtest.h>

#include <utility>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

std::size_t sentInAll(const ScannerRun& run) {
  std::size_t found = 0;
  for (const std::string& line : run.seen) found += line[0] == '>' ? 1 : 0;
  return found;
}

// Facts 3.2: request or response with our MAC id within the check is a communication fault, named, and silence.
TEST(DuplicateMac, DuringTheCheck) {
  for (const char* other : {"407#00850178563412", "407#80850178563412"}) {
    ScannerRun run{busConfig(1)};
    run.begin();
    run.run(milliseconds{500});
    run.say(other);
    const std::size_t sent = sentInAll(run);
    EXPECT_EQ(BusState::kCommunicationFault, run.scanner.busState());
    EXPECT_STREQ("communication fault: another device has our MAC id 0, vendor 389, serial number 12345678h",
                 run.scanner.busReason().c_str());
    run.run(milliseconds{900});
    EXPECT_EQ(sent, sentInAll(run)) << "silent";
    EXPECT_EQ(1u, run.count(DevicenetEventKind::kCommunicationFault));
  }
}

// It is asked again; when the other one is gone we come back by ourselves.
TEST(DuplicateMac, ComesBackWhenTheOtherIsGone) {
  ScannerRun run{busConfig(1)};
  bool other = true;
  run.on_sent = [&](const CanFrame& sent) {
    if (other && sent.id == 0x407 && sent.data[0] == 0) run.devices[0]->say(frame("407#80850178563412"));
  };
  run.begin();
  run.run(seconds{20});
  EXPECT_EQ(0u, run.count(DevicenetEventKind::kOnline));
  EXPECT_LT(8u, run.scanner.counters().own_mac_used);
  other = false;
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{4}));
}

// On-line every request is answered, and goes on undisturbed.
TEST(DuplicateMac, AnswersRequestsOfOthers) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.say("407#00850178563412");
  run.step();
  EXPECT_EQ(1u, run.scanner.counters().mac_answers);
  bool answered = false;
  for (const std::string& line : run.seen) answered = answered || line == "> 407#80341244332211";
  EXPECT_TRUE(answered);
  run.run(seconds{1});
  EXPECT_TRUE(run.allExchanging());
  EXPECT_EQ(0u, run.count(DevicenetEventKind::kNodeLost));
}

// A response for our own MAC id while on-line: somebody else has it. Everything stops at once.
TEST(DuplicateMac, ResponseWhileOnline) {
  ScannerRun run{busConfig(2)};
  ASSERT_TRUE(run.starts());
  const ExplicitRequest request = getAttribute(7, 101, 1, 2);
  ASSERT_TRUE(run.scanner.submit(0, request));
  run.say("407#80850178563412");
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  EXPECT_EQ(NodeState::kLost, run.scanner.status(1).state);
  CanFrame frame;
  EXPECT_FALSE(run.scanner.pollTransmit(frame));
  const auto answer = run.scanner.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(7u, answer->answer.id);
  EXPECT_EQ(ExplicitEnd::kNotConnected, answer->answer.end);
  run.step();
  EXPECT_EQ(2u, run.count(DevicenetEventKind::kNodeLost));
  EXPECT_TRUE(run.runUntil([&] { return run.allExchanging(); }, seconds{5}));
}

// Not even an acknowledge that was due, nor one for a fragment that comes again, now or when we are back.
TEST(DuplicateMac, SilenceIsWhole) {
  ScannerRun run{busConfig(1)};
  run.devices[0]->attributes[{1, 1, 7}] = std::vector<std::uint8_t>(20, 0x41);
  ASSERT_TRUE(run.starts());
  ASSERT_TRUE(run.scanner.submit(0, getAttribute(1, 1, 1, 7)));
  CanFrame sent, fragment;
  for (bool answered = false; !answered; answered = run.scanner.pollAnswer().has_value()) {
    while (run.scanner.pollTransmit(sent)) run.devices[0]->receive(sent, run.now);
    while (run.devices[0]->next(fragment)) run.scanner.handleFrame(fragment, run.now);
  }
  ASSERT_EQ("42B#", text(fragment).substr(0, 4));
  ASSERT_EQ(0x80, fragment.data[0] & 0x80) << "the last fragment: its acknowledge is due";
  run.say("407#80850178563412");
  EXPECT_FALSE(run.scanner.pollTransmit(sent));
  run.scanner.handleFrame(fragment, run.now);
  EXPECT_FALSE(run.scanner.pollTransmit(sent));
  run.seen.clear();
  run.devices[0]->powerOff();
  run.run(seconds{4});
  for (const std::string& line : run.seen) EXPECT_NE("> 42C#", line.substr(0, 6)) << line;
}

// The second of silence begins when the link has taken the request, not before.
TEST(DuplicateMac, WaitsForTheLink) {
  ScannerRun run{busConfig(1)};
  run.link_full = true;
  run.begin();
  run.run(seconds{10});
  EXPECT_EQ(BusState::kCheckingMac, run.scanner.busState());
  run.link_full = false;
  run.run(milliseconds{1990});
  EXPECT_EQ(BusState::kCheckingMac, run.scanner.busState());
  run.run(milliseconds{20});
  EXPECT_EQ(BusState::kOnline, run.scanner.busState());
}

TEST(DuplicateMac, ARequestThatWasNotSentDoesNotCount) {
  DuplicateMacCheck check{0, {1, 2}, seconds{1}};
  Instant now{std::chrono::hours{1}};
  check.restart();
  CanFrame frame;
  ASSERT_TRUE(check.pollTransmit(frame, now));
  check.notSent(frame);
  now += seconds{5};
  check.poll(now);
  EXPECT_EQ(DuplicateMacCheck::State::kFirst, check.state());
  EXPECT_TRUE(check.pollTransmit(frame, now)) << "it comes again";
}

// Messages of a wrong length say nothing about whose MAC id it is.
TEST(DuplicateMac, MalformedIsNoFault) {
  ScannerRun run{busConfig(1)};
  run.begin();
  for (const char* bad : {"407#", "407#00", "407#008501785634", "407#0085017856341200", "407#R7"}) run.say(bad);
  run.step();
  EXPECT_EQ(BusState::kCheckingMac, run.scanner.busState());
  EXPECT_EQ(5u, run.scanner.counters().malformed);
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kMalformed));
}

// Two devices with one MAC id: the one that is on-line tells the other.
TEST(DuplicateMac, OfADevice) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.say("42F#80850178563412");
  run.step();
  EXPECT_EQ("a second device with MAC id 5 was told that it is taken, by vendor 389, serial number 12345678h",
            run.eventText(DevicenetEventKind::kDoubleMac));
  run.say("437#00850178563412");
  run.say("437#00850178563412");
  run.step();
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kForeignNode)) << "told once";
}

// Bus-off, or the interface is gone: every device is lost, nothing is sent; who was off the bus checks its MAC id again.
TEST(DuplicateMac, AgainAfterTheBusWasLost) {
  ScannerRun run{busConfig(1)};
  ASSERT_TRUE(run.starts());
  run.scanner.handleBusLost("can0: bus-off", run.now);
  EXPECT_EQ(NodeState::kLost, run.scanner.status(0).state);
  EXPECT_STREQ("can0: bus-off", run.scanner.status(0).reason.c_str());
  EXPECT_EQ(BusState::kLost, run.scanner.busState());
  const std::size_t sent = sentInAll(run);
  run.run(seconds{5});
  EXPECT_EQ(sent, sentInAll(run));
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kBusLost));
  const Instant again = run.now;
  run.begin();
  EXPECT_TRUE(run.reaches(NodeState::kExchanging, seconds{4}));
  EXPECT_GE(run.now - again, seconds{2});
  EXPECT_LE(run.now - again, milliseconds{2500});
}

// Off the bus nobody's message says anything to us; the check begins when the bus is opened.
TEST(DuplicateMac, OffTheBusNobodyIsHeard) {
  const Instant now{std::chrono::hours{1}};
  for (const bool stopped : {false, true}) {
    for (const bool response : {false, true}) {
      DuplicateMacCheck check{0, {1, 2}, seconds{1}};
      if (stopped) check.restart();
      if (stopped) check.stop();
      check.handle({response, {389, 7}}, now);
      EXPECT_EQ(DuplicateMacCheck::State::kOff, check.state());
      EXPECT_FALSE(check.nextDeadline());
      CanFrame sent;
      EXPECT_FALSE(check.pollTransmit(sent, now));
    }
  }
}

// In a communication fault the pause runs from the first message, and the sender of that one is named.
TEST(DuplicateMac, TheFirstRivalCounts) {
  DuplicateMacCheck check{0, {1, 2}, seconds{1}};
  Instant now{std::chrono::hours{1}};
  CanFrame sent;
  check.restart();
  ASSERT_TRUE(check.pollTransmit(sent, now));
  check.handle({false, {389, 0x12345678}}, now);
  ASSERT_EQ(DuplicateMacCheck::State::kCommFault, check.state());
  now += milliseconds{600};
  check.handle({true, {7, 8}}, now);
  EXPECT_EQ(389, check.rival().vendor_id);
  EXPECT_EQ(0x12345678u, check.rival().serial_number);
  now += milliseconds{399};
  check.poll(now);
  EXPECT_EQ(DuplicateMacCheck::State::kCommFault, check.state());
  EXPECT_FALSE(check.pollTransmit(sent, now));
  now += milliseconds{1};
  check.poll(now);
  EXPECT_EQ(DuplicateMacCheck::State::kFirst, check.state());
  EXPECT_TRUE(check.pollTransmit(sent, now));
}

// An answer on-line is followed by nothing: nobody is to wake up for it.
TEST(DuplicateMac, AnAnswerIsNoDeadline) {
  DuplicateMacCheck check{0, {0x1234, 0x11223344}, seconds{1}};
  Instant now{std::chrono::hours{1}};
  CanFrame sent;
  check.restart();
  for (int i = 0; i < 2; ++i) {
    ASSERT_FALSE(check.online());
    ASSERT_TRUE(check.pollTransmit(sent, now));
    EXPECT_EQ(now + seconds{1}, check.nextDeadline());
    now += seconds{1};
    check.poll(now);
  }
  ASSERT_TRUE(check.online());
  check.handle({false, {389, 7}}, now);
  ASSERT_TRUE(check.pollTransmit(sent, now));
  EXPECT_EQ("407#80341244332211", text(sent));
  EXPECT_FALSE(check.nextDeadline());
  EXPECT_FALSE(check.pollTransmit(sent, now)) << "once";
}

TEST(DuplicateMac, AMalformedMessageIsToldAsItWas) {
  for (const auto& [said, told] :
       {std::pair{"407#00", "somebody sent a malformed duplicate-MAC message 407h (1 bytes, expected 7)"},
        std::pair{"407#R7", "somebody sent a malformed duplicate-MAC message 407h (7 bytes, remote, expected 7)"}}) {
    ScannerRun run{busConfig(1)};
    run.begin();
    run.say(said);
    run.step();
    EXPECT_EQ(told, run.eventText(DevicenetEventKind::kMalformed));
  }
}

// A bus that was never opened is not lost, and one that is lost is told once, with the first reason.
TEST(DuplicateMac, ABusIsLostOnce) {
  ScannerRun run{busConfig(1)};
  run.scanner.handleBusLost("can0: no such device", run.now);
  run.step();
  EXPECT_EQ(BusState::kOff, run.scanner.busState());
  EXPECT_EQ(0u, run.count(DevicenetEventKind::kBusLost));
  ASSERT_TRUE(run.starts());
  run.scanner.handleBusLost("can0: bus-off", run.now);
  run.scanner.handleBusLost("can0: network is down", run.now);
  run.step();
  EXPECT_EQ(1u, run.count(DevicenetEventKind::kBusLost));
  EXPECT_STREQ("can0: bus-off", run.scanner.busReason().c_str());
  EXPECT_STREQ("can0: bus-off", run.scanner.status(0).reason.c_str());
}

}  // namespace
}  // namespace nord_driver::devicenet
