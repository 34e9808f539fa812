#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

MasterConfig guarded() {
  MasterConfig config = busConfig(1, 0x32);
  ErrorControl& control = config.nodes[0].error_control;
  control.mode = ErrorControlMode::kGuarding;
  control.guard_time = milliseconds{250};  // the example of BU 0260 p. 50
  control.life_time_factor = 3;
  return config;
}

/// One node, or those of `config`, operational.
struct Operational : MasterRun {
  explicit Operational(const MasterConfig& config = busConfig(1)) : MasterRun{config} {
    begin();
    EXPECT_TRUE(runUntil([this] { return allOperational(); }, seconds{2}));
    sent.clear();
  }
  std::size_t guardingQuestions() const {
    return static_cast<std::size_t>(std::count(sent.begin(), sent.end(), "732#R1"));
  }
};

// No heartbeat for its time-out: lost, told, counted, and not one RPDO more.
TEST(NodeLoss, HeartbeatLost) {
  Operational run;
  run.nodes[0]->powerOff();
  run.run(milliseconds{199});
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  ASSERT_TRUE(run.reaches(NodeState::kLost, milliseconds{120}));
  EXPECT_EQ("sent no heartbeat for 300 ms", run.eventText(CanopenEventKind::kNodeLost));
  EXPECT_EQ(1u, run.master.status(0).counters.losses);
  run.sent.clear();
  run.run(seconds{1});
  EXPECT_THAT(run.sent, testing::Not(Contains(HasSubstr("201#"))));
  // It comes back: running within 2 s.
  run.nodes[0]->powerOn(run.now);
  EXPECT_TRUE(run.reaches(NodeState::kOperational, milliseconds{200}));
  EXPECT_EQ(2u, run.master.status(0).counters.boots);
  EXPECT_THAT(run.violations(), IsEmpty());
}

// The cable was off: the node goes on by itself and has no boot-up to send. It is found, reset and started.
TEST(NodeLoss, ComesBackWithoutABootUp) {
  Operational run;
  bool cut = true;
  run.loses = [&cut](const CanFrame&) { return cut; };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.run(seconds{3});
  EXPECT_EQ(NodeState::kLost, run.master.status(0).state);
  const int resets = run.nodes[0]->resets;
  cut = false;
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_EQ(resets + 1, run.nodes[0]->resets);
}

// A node that is being reset hears no RPDO: it does not count as operational until it says so.
TEST(NodeLoss, ANodeThatIsResetIsNotOperational) {
  Operational run;
  bool cut = true;
  run.loses = [&cut](const CanFrame& frame) { return cut || frame.id == 0x701; };  // its boot-up takes its time
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  EXPECT_EQ(NmtState::kOperational, run.master.status(0).nmt);
  const int resets = run.nodes[0]->resets;
  cut = false;
  ASSERT_TRUE(run.runUntil([&] { return run.nodes[0]->resets > resets; }, seconds{2}));
  EXPECT_EQ(NmtState::kUnknown, run.master.status(0).nmt);
}

// What a node said before it was lost says nothing of it when it is back: another state, another set, another speed.
TEST(NodeLoss, ItsLastWordsAreForgotten) {
  Operational run;
  run.say("181#370B0020");
  ASSERT_EQ("37 0B 00 20", toHex(run.master.transmitPdo(0, 0).bytes));
  run.nodes[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.loses = [](const CanFrame& frame) { return frame.id == 0x181; };
  run.nodes[0]->powerOn(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.run(milliseconds{50});
  EXPECT_EQ(0u, run.master.transmitPdo(0, 0).count);
}

// What was noticed first is what a technician needs to know, however long the node has been asked in vain since.
TEST(NodeLoss, WhatWasLostIsStillToldAfterAWhile) {
  Operational run;
  run.nodes[0]->powerOff();
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{1}));
  run.run(seconds{5});
  EXPECT_STREQ("sent no heartbeat for 300 ms; since then it does not answer: is it powered and connected?",
               run.master.status(0).reason.c_str());
  run.nodes[0]->powerOn(run.now);
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  EXPECT_STREQ("", run.master.status(0).reason.c_str());
}

// A short break of the supply shows only as a boot-up in the middle of the exchange.
TEST(NodeLoss, RestartedByItself) {
  Operational run;
  run.nodes[0]->powerOff();
  run.nodes[0]->powerOn(run.now);
  run.run(milliseconds{25});
  EXPECT_EQ("has restarted by itself: it sent its boot-up", run.eventText(CanopenEventKind::kNodeLost));
  EXPECT_TRUE(run.reaches(NodeState::kOperational, milliseconds{300}));
  EXPECT_EQ(1, run.nodes[0]->resets) << "it need not be reset";
}

TEST(NodeLoss, LeftOperationalByItself) {
  Operational run;
  run.nodes[0]->state = 0x7F;
  run.run(milliseconds{101});
  EXPECT_EQ("is pre-operational now, which we did not tell it", run.eventText(CanopenEventKind::kNodeLost));
  EXPECT_TRUE(run.reaches(NodeState::kOperational, milliseconds{300}));
  EXPECT_EQ(1u, run.master.status(0).counters.losses);
}

// Guarding: 1017h off, 100Ch and 100Dh set, a remote frame per guard time, answered with a toggling bit 7.
TEST(NodeLoss, GuardsByRemoteFrames) {
  MasterRun run{guarded()};
  run.nodes[0]->object(0x1017, 0).value = 100;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  EXPECT_THAT(run.nodes[0]->writes, testing::ElementsAre("1017:00=0", "100C:00=FA", "100D:00=3"));
  const int before = run.nodes[0]->guards;
  run.run(seconds{10});
  EXPECT_EQ(before + 40, run.nodes[0]->guards);
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  EXPECT_EQ(0u, run.master.status(0).counters.toggle_errors);
}

TEST(NodeLoss, GuardingLost) {
  Operational run{guarded()};
  run.run(milliseconds{100});
  run.nodes[0]->answers_guarding = false;
  ASSERT_TRUE(run.runUntil([&] { return run.master.status(0).counters.losses == 1; }, milliseconds{760}));
  EXPECT_GE(run.guardingQuestions(), 2u);
  EXPECT_EQ("gave no good answer to guarding for 750 ms", run.eventText(CanopenEventKind::kNodeLost));
  run.nodes[0]->answers_guarding = true;
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{3}));
}

// An answer with the toggle bit of the one before counts as none (CiA 301 7.2.8.3.2.1): told once, lost in the end.
TEST(NodeLoss, ToggleBitStandsStill) {
  Operational run{guarded()};
  run.nodes[0]->toggles = false;
  ASSERT_TRUE(run.runUntil([&] { return run.master.status(0).counters.losses == 1; }, seconds{2}));
  EXPECT_EQ(1u, run.count(CanopenEventKind::kToggleError));
  EXPECT_GE(run.master.status(0).counters.toggle_errors, 2u);
}

// Another master that guards the same node makes it toggle between our questions: the node is well.
TEST(NodeLoss, AnotherMasterGuardsTheSameNode) {
  for (const bool is_seen : {true, false}) {
    Operational run{guarded()};
    for (int i = 0; i < 20; ++i) {
      run.nodes[0]->receive(frame("732#R1"), run.now);
      if (is_seen) run.say("732#R1");
      run.run(milliseconds{250});
    }
    EXPECT_EQ(0u, run.master.status(0).counters.losses + run.master.status(0).counters.toggle_errors);
    EXPECT_EQ(is_seen ? 20u : 0u, run.master.counters().second_master);
  }
}

// One answer that did not reach us leaves the toggle bit unknown, not wrong.
TEST(NodeLoss, OneLostAnswerToGuardingIsForgiven) {
  Operational run{guarded()};
  bool lost = false;
  run.loses = [&lost](const CanFrame& frame) {
    const bool first = !lost && frame.id == 0x732 && !frame.remote;
    lost = lost || first;
    return first;
  };
  run.run(seconds{3});
  EXPECT_TRUE(lost);
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  EXPECT_EQ(0u, run.master.status(0).counters.toggle_errors);
  EXPECT_EQ(1u, run.master.status(0).counters.missed_guards);
}

// A life time of three guard times has time for three questions: two of them lost one after the other on a bad line, and
// the third one too late, would end a node that is well.
TEST(NodeLoss, TwoLostAnswersToGuardingAreForgiven) {
  Operational run{guarded()};
  int lost = 0;
  run.loses = [&lost](const CanFrame& frame) {
    const bool loses = lost < 3 && frame.id == 0x732 && !frame.remote;
    lost += loses ? 1 : 0;
    return loses;
  };
  run.run(seconds{3});
  EXPECT_EQ(3, lost);
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  EXPECT_EQ(0u, run.master.status(0).counters.losses);
  EXPECT_EQ(3u, run.master.status(0).counters.missed_guards);
}

// A master that looks late, because its machine stood still, asks once, not once for every time it missed.
TEST(NodeLoss, NoBurstOfQuestionsAfterAStandstill) {
  Operational run{guarded()};
  run.now += milliseconds{700};
  run.run(milliseconds{100});
  EXPECT_LE(run.guardingQuestions(), 2u);
}

// Our own heartbeat, and the node told to watch it (1016h:1 = our id, time).
TEST(NodeLoss, SendsItsOwnHeartbeat) {
  MasterConfig config = busConfig(1);
  config.own_id = 127;
  config.heartbeat_time = milliseconds{100};
  config.nodes[0].error_control.master_timeout = milliseconds{300};
  MasterRun run{config};
  run.begin();
  run.run(seconds{1});
  EXPECT_EQ(1, std::count(run.sent.begin(), run.sent.end(), "77F#00"));
  EXPECT_EQ(10, std::count(run.sent.begin(), run.sent.end(), "77F#05"));
  EXPECT_THAT(run.nodes[0]->writes, Contains("1016:01=7F012C"));
}

// The first heartbeat follows our boot-up after its period, and a late look sends one for all that were missed.
TEST(NodeLoss, OurHeartbeatKeepsItsPeriod) {
  MasterConfig config = busConfig(1);
  config.own_id = 127;
  config.heartbeat_time = milliseconds{100};
  MasterRun run{config};
  run.master.restart(run.now);
  const auto heartbeats = [&run] { return std::count(run.sent.begin(), run.sent.end(), "77F#05"); };
  run.run(milliseconds{99});
  EXPECT_EQ(1, std::count(run.sent.begin(), run.sent.end(), "77F#00"));
  EXPECT_EQ(0, heartbeats());
  run.run(milliseconds{1});
  EXPECT_EQ(1, heartbeats());
  run.run(milliseconds{100});
  EXPECT_EQ(2, heartbeats());
  run.now += milliseconds{102};  // a little late, which the next one does not inherit
  run.step();
  EXPECT_EQ(3, heartbeats());
  run.run(milliseconds{96});
  EXPECT_EQ(3, heartbeats());
  run.run(milliseconds{1});
  EXPECT_EQ(4, heartbeats());
  run.now += milliseconds{1049};
  run.step();
  EXPECT_EQ(5, heartbeats());
  run.run(milliseconds{99});
  EXPECT_EQ(5, heartbeats()) << "a whole period after one that was that late";
  run.run(milliseconds{1});
  EXPECT_EQ(6, heartbeats());
}

// Who sleeps until the next deadline is not woken up for one that is over.
TEST(NodeLoss, TheNextDeadlineLiesAhead) {
  MasterConfig config = guarded();
  config.own_id = 127;
  config.heartbeat_time = milliseconds{100};
  Operational run{config};
  for (int i = 0; i < 1000; ++i) {
    if (i == 500) run.nodes[0]->powerOff();
    run.step();
    ASSERT_TRUE(run.master.nextDeadline());
    ASSERT_GT(*run.master.nextDeadline(), run.now) << "after " << i << " ms";
  }
}

// What a node was told by somebody else it does: known when the command is on the bus, with any error control.
TEST(NodeLoss, ToldSomethingByAnotherMaster) {
  for (const auto& [command, name] : {std::make_pair("82", "reset communication"), std::make_pair("81", "reset node"),
                                      std::make_pair("80", "enter pre-operational"), std::make_pair("02", "stop")}) {
    Operational run;
    run.say(std::string{"000#"} + command + "01");
    EXPECT_EQ(NodeState::kBooting, run.master.status(0).state) << name;
    EXPECT_EQ(std::string{"was told \""} + name + "\" by another master", run.master.status(0).reason.str());
  }
  Operational both{busConfig(2)};
  both.say("000#8002");
  EXPECT_EQ(NodeState::kOperational, both.master.status(0).state);
  EXPECT_EQ(NodeState::kBooting, both.master.status(1).state);
  Operational all{busConfig(2)};
  all.say("000#8000");
  for (const std::size_t node : {0u, 1u}) EXPECT_EQ(NodeState::kBooting, all.master.status(node).state) << node;
  Operational run;
  run.say("000#0101");
  run.say("000#8202");
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state) << "start, or another node";
}

// A stopped node answers no SDO: it is led back, also when its command was missed.
TEST(NodeLoss, AStoppedNodeIsLedBack) {
  Operational run;
  run.sent.clear();
  run.nodes[0]->state = 0x04;
  run.run(milliseconds{101});
  EXPECT_EQ("is stopped now, which we did not tell it", run.eventText(CanopenEventKind::kNodeLost));
  EXPECT_THAT(run.sent, Contains("000#8001"));
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
}

// The command that leads it back is not confirmed, and may be lost: it goes out again with each question, as long as
// nobody answers. (Found by the fault campaign: canopen:4.)
TEST(NodeLoss, AStoppedNodeIsLedBackWhenThatCommandWasLost) {
  Operational run{guarded()};
  run.say("000#0232");
  run.run(milliseconds{5});
  EXPECT_THAT(run.sent, Contains("000#8032"));
  run.nodes[0]->state = 0x04;  // it has heard the other master, and not us
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{5})) << run.master.status(0).reason.c_str();
}

// Stopped by somebody while the line was cut: it answers no SDO, but tells its state when it is asked for that.
TEST(NodeLoss, AStopThatWasNotHeardIsSeen) {
  for (const BootReset reset : {BootReset::kResetCommunication, BootReset::kNone}) {
    MasterConfig config = guarded();
    config.nodes[0].reset = reset;
    Operational run{config};
    bool cut = true;
    run.loses = [&cut](const CanFrame&) { return cut; };
    ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{2}));
    run.nodes[0]->state = 0x04;
    cut = false;
    EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{4})) << run.master.status(0).reason.c_str();
  }
}

// Stopped before we came, by a master that is gone. (Found by the fault campaign: canopen:1239.)
TEST(NodeLoss, AStopBeforeWeCameIsNotForEver) {
  for (const bool answers_guarding : {true, false}) {
    MasterConfig config = guarded();
    config.nodes[0].reset = BootReset::kNone;
    MasterRun run{config};
    run.powerAll();
    run.run(seconds{1});
    run.nodes[0]->state = 0x04;
    run.nodes[0]->answers_guarding = answers_guarding;
    run.master.restart(run.now);
    run.run(seconds{3});
    run.nodes[0]->answers_guarding = true;
    EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{3})) << run.master.status(0).reason.c_str();
  }
}

// The same of a node that does not tell its state: asking for it would find it never.
TEST(NodeLoss, AStopThatWasNotHeardIsNotForEver) {
  for (const BootReset reset : {BootReset::kResetCommunication, BootReset::kNone}) {
    MasterConfig config = guarded();
    config.nodes[0].reset = reset;
    Operational run{config};
    run.nodes[0]->answers_guarding = false;
    bool cut = true;
    run.loses = [&cut](const CanFrame&) { return cut; };
    ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{2}));
    run.nodes[0]->state = 0x04;
    cut = false;
    run.sent.clear();
    run.run(seconds{10});
    EXPECT_THAT(run.sent, testing::Not(Contains(HasSubstr("000#")))) << "it may hear what stops its drive";
    run.nodes[0]->answers_guarding = true;
    EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{10})) << run.master.status(0).reason.c_str();
  }
}

// A stop that takes longer than usual: it is not made deaf to it.
TEST(NodeLoss, ASilentNodeIsLeftAloneForAsLongAsAStopMayTake) {
  Operational run{guarded()};
  run.master.setOnlyAsked(seconds{65});
  run.nodes[0]->answers_guarding = false;
  bool cut = true;
  run.loses = [&cut](const CanFrame&) { return cut; };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{2}));
  run.nodes[0]->state = 0x04;
  cut = false;
  run.sent.clear();
  run.run(seconds{60});
  EXPECT_THAT(run.sent, testing::Not(Contains(HasSubstr("000#"))));
  run.run(seconds{10});
  EXPECT_THAT(run.sent, Contains("000#8232")) << "reset communication";
}

// The answer to another master's guarding is none to ours, but the state in it is the node's.
TEST(NodeLoss, AStateInAnAnswerToSomebodyElseCounts) {
  Operational run{guarded()};
  run.run(milliseconds{50});
  run.say("732#FF");  // toggle bit as it may be, pre-operational
  EXPECT_EQ(NodeState::kBooting, run.master.status(0).state);
  EXPECT_EQ("is pre-operational now, which we did not tell it", run.master.status(0).reason.str());
}

}  // namespace
}  // namespace nord_driver::canopen
