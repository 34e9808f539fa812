// What a master counts, and what becomes of a frame the link did not take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::IsEmpty;

std::string nextFrame(Master& master) {
  CanFrame frame;
  return master.pollTransmit(frame) ? text(frame) : "";
}

std::uint64_t sum(const Counters& c) {
  return c.cycles + c.frames_sent + c.frames_received + c.syncs + c.not_sent + c.superseded + c.malformed + c.foreign +
         c.second_master + c.own_id_used + c.sdo_timeouts + c.sdo_aborts + c.stray_sdo;
}

std::uint64_t sum(const NodeCounters& c) {
  return c.boot_ups + c.boots + c.losses + c.refusals + c.receive_pdos + c.transmit_pdos + c.foreign_receive_pdos +
         c.emergencies + c.heartbeats + c.sdo_timeouts + c.sdo_aborts + c.toggle_errors + c.missed_guards +
         c.malformed + c.superseded;
}

TEST(MasterCounters, NothingHasHappenedYet) {
  const Master master{busConfig(2)};
  EXPECT_EQ(0u, sum(master.counters()));
  const NodeStatus& node = master.status(1);
  EXPECT_EQ(0u, sum(node.counters));
  EXPECT_EQ(NodeState::kAbsent, node.state);
  EXPECT_EQ(0u, node.device_type | node.vendor_id | node.product_code | node.revision_number | node.serial_number);
  EXPECT_FALSE(node.doubled || node.fellSilent());
  EXPECT_EQ(0u, node.emergencies.count());
}

TEST(MasterCounters, OfANodeThatRuns) {
  MasterConfig config = busConfig(1);
  config.nodes[0].device_type = 0x00010192;
  MasterRun run{config};
  run.nodes[0]->object(0x1000, 0).value = 0x00010192;
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  const NodeStatus& node = run.master.status(0);
  EXPECT_EQ(0x00010192u, node.device_type);
  EXPECT_EQ(1u, node.counters.boot_ups) << "the reset came before that of its supply";
  ASSERT_TRUE(node.booted_up_at);
  EXPECT_LT(run.now - *node.booted_up_at, milliseconds{200});
  run.run(seconds{1});
  EXPECT_THAT(node.counters.heartbeats, testing::AllOf(testing::Ge(10u), testing::Le(13u)));
  EXPECT_LE(run.now - node.heard_at, milliseconds{101});
  EXPECT_EQ(1u, node.counters.boots);
  EXPECT_EQ(1u, node.counters.transmit_pdos) << "what it sends at its start";
  const Counters before = run.master.counters();
  run.say("181#310B0000");
  run.say("081#0081010000000000");
  EXPECT_EQ(2u, node.counters.transmit_pdos);
  EXPECT_EQ(1u, node.counters.emergencies);
  EXPECT_EQ(before.frames_received + 2, run.master.counters().frames_received);
  EXPECT_EQ(0u, before.malformed + before.foreign + before.second_master + before.sdo_timeouts + before.sdo_aborts);
  EXPECT_EQ(run.sent.size(), before.frames_sent);
}

// Frames with 29 bits are nobody's of ours, whatever stands in them.
TEST(MasterCounters, OfExtendedFrames) {
  Master master{busConfig(1)};
  const Instant now{std::chrono::hours{1}};
  master.restart(now);
  CanFrame extended = frame("000#8101");
  extended.extended = true;
  master.handleFrame(extended, now);
  EXPECT_EQ(1u, master.counters().frames_received);
  EXPECT_EQ(1u, master.counters().foreign);
  EXPECT_FALSE(master.noteOtherMaster(extended, now));
  EXPECT_EQ(2u, master.counters().frames_received);
  EXPECT_EQ(0u, master.counters().second_master);
}

TEST(MasterCounters, OfAccessesThatCameToNothing) {
  MasterRun run{busConfig(1)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  const auto ends = [&run](const SdoRequest& request) {
    EXPECT_TRUE(run.master.submitSdo(0, 0, request));
    std::optional<NodeSdoAnswer> answer;
    EXPECT_TRUE(run.runUntil([&] { return answer || (answer = run.master.pollSdo()).has_value(); }, seconds{1}));
    return answer ? answer->answer.end : SdoEnd::kDone;
  };
  EXPECT_EQ(SdoEnd::kDone, ends(sdoRead(1, 0x1000, 0)));
  EXPECT_EQ(0u, run.master.counters().sdo_timeouts + run.master.counters().sdo_aborts);
  EXPECT_EQ(SdoEnd::kAbortedByServer, ends(sdoRead(2, 0x5FFF, 0)));
  EXPECT_EQ(1u, run.master.counters().sdo_aborts);
  run.nodes[0]->hears_sdo = false;
  EXPECT_EQ(SdoEnd::kTimedOut, ends(sdoRead(3, 0x1000, 0)));
  EXPECT_EQ(1u, run.master.counters().sdo_timeouts);
  EXPECT_EQ(1u, run.master.counters().sdo_aborts);
}

// --- The link had no room ---

// Our boot-up and our heartbeat come again as what they were.
TEST(NotSent, OurBootUpAndHeartbeatAreGivenOutAgain) {
  MasterConfig config = busConfig(1);
  config.own_id = 127;
  config.heartbeat_time = milliseconds{100};
  config.nodes[0].reset = BootReset::kNone;
  Master master{config};
  Instant now{std::chrono::hours{1}};
  master.restart(now);
  ASSERT_EQ("77F#00", nextFrame(master));
  master.notSent();
  ASSERT_EQ("77F#00", nextFrame(master));
  EXPECT_EQ("601#4000100000000000", nextFrame(master));
  EXPECT_EQ("", nextFrame(master));
  now += milliseconds{100};
  master.poll(now);
  ASSERT_EQ("77F#05", nextFrame(master));
  master.notSent();
  ASSERT_EQ("77F#05", nextFrame(master));
  EXPECT_EQ("", nextFrame(master));
  EXPECT_EQ(2u, master.counters().not_sent);
  EXPECT_EQ(3u, master.counters().frames_sent) << "boot-up, question, heartbeat: each once";
}

// A command, a question and an access are given out again at once, before anything else has happened.
TEST(NotSent, CommandsAndAccessesAreGivenOutAgain) {
  Master master{busConfig(1)};
  Instant now{std::chrono::hours{1}};
  master.restart(now);
  ASSERT_EQ("000#8201", nextFrame(master));
  master.notSent();
  ASSERT_EQ("000#8201", nextFrame(master));
  EXPECT_EQ("", nextFrame(master));
  master.handleFrame(frame("701#00"), now);
  ASSERT_EQ("601#4000100000000000", nextFrame(master));
  master.notSent();
  ASSERT_EQ("601#4000100000000000", nextFrame(master));
  EXPECT_EQ("", nextFrame(master));
}

TEST(NotSent, QuestionsOfGuardingAreGivenOutAgain) {
  MasterConfig config = busConfig(1);
  config.nodes[0].error_control.mode = ErrorControlMode::kGuarding;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  std::string given;
  while (given != "701#R1") {
    run.now += milliseconds{1};
    run.master.poll(run.now);
    given = nextFrame(run.master);
  }
  run.master.notSent();
  EXPECT_EQ("701#R1", nextFrame(run.master));
  run.say("701#85");
  run.say("701#05");
  EXPECT_EQ(0u, run.master.status(0).counters.missed_guards);
}

// Nothing was given out, or the same frame is returned twice: nothing comes of it.
TEST(NotSent, OnlyWhatWasGivenOutComesBack) {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1}));
  run.run(milliseconds{20});
  const Counters before = run.master.counters();
  const NodeCounters node = run.master.status(0).counters;
  run.master.notSent();
  EXPECT_EQ(sum(before), sum(run.master.counters()));
  EXPECT_EQ(sum(node), sum(run.master.status(0).counters));
  run.master.startCycle(run.now);
  ASSERT_EQ("201#7E040000", nextFrame(run.master));
  ASSERT_EQ("080#", nextFrame(run.master));
  run.master.notSent();
  run.master.notSent();
  EXPECT_EQ(before.not_sent + 1, run.master.counters().not_sent);
  EXPECT_EQ(before.syncs, run.master.counters().syncs) << "the SYNC did not go out";
  EXPECT_EQ(before.superseded + 1, run.master.counters().superseded);
  EXPECT_EQ(before.frames_sent + 1, run.master.counters().frames_sent);
  EXPECT_EQ(node.receive_pdos + 1, run.master.status(0).counters.receive_pdos);
  EXPECT_EQ("", nextFrame(run.master));
  run.master.startCycle(run.now);
  ASSERT_EQ("080#", nextFrame(run.master)) << "it found no place";
  ASSERT_EQ("201#7E040000", nextFrame(run.master));
  EXPECT_EQ(before.syncs + 1, run.master.counters().syncs);
}

// What was due when a cycle began is not sent to a node that has left the exchange since, and not behind a restart.
TEST(NotSent, NothingOfACycleGoesOutBehindALoss) {
  MasterConfig config = busConfig(2);
  config.sync_cob_id = 0x80;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.runUntil([&run] { return run.allOperational(); }, seconds{1}));
  run.run(milliseconds{20});
  run.master.startCycle(run.now);
  run.say("701#7F");
  run.master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));  // by one who has not learned of it yet
  std::vector<std::string> sent;
  for (std::string next = nextFrame(run.master); !next.empty(); next = nextFrame(run.master)) sent.push_back(next);
  EXPECT_THAT(sent, testing::ElementsAre("202#7E040000", "080#", "601#4000100000000000"));
  run.master.startCycle(run.now);
  run.master.restart(run.now);
  sent.clear();
  for (std::string next = nextFrame(run.master); !next.empty(); next = nextFrame(run.master)) sent.push_back(next);
  EXPECT_THAT(sent, testing::Not(testing::Contains("202#7E040000")));
  EXPECT_THAT(sent, testing::Not(testing::Contains("080#")));
}

// With the first RPDO that finds no room the rest of its cycle is dropped, SYNC included: it would make the others act
// without it.
TEST(NotSent, TheRestOfTheCycleIsDropped) {
  MasterConfig config = busConfig(2);
  config.sync_cob_id = 0x80;
  MasterRun run{config};
  run.begin();
  ASSERT_TRUE(run.runUntil([&run] { return run.allOperational(); }, seconds{1}));
  run.run(milliseconds{20});
  const Counters before = run.master.counters();
  run.master.startCycle(run.now);
  ASSERT_EQ("201#7E040000", nextFrame(run.master));
  run.master.notSent();
  EXPECT_EQ("", nextFrame(run.master));
  EXPECT_EQ(before.superseded + 3, run.master.counters().superseded) << "two RPDOs and the SYNC";
  EXPECT_EQ(before.frames_sent, run.master.counters().frames_sent);
  EXPECT_EQ(before.syncs, run.master.counters().syncs);
}

}  // namespace
}  // namespace nord_driver::canopen
