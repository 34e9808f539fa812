// A queue that takes few frames: what moves and stops drives goes first, of one node as of another, and nothing that would
// keep a node content takes its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

/// Nodes in operation, and a link that takes `room` frames a cycle.
class FullQueue : public ::testing::Test {
 protected:
  void start(const MasterConfig& config) {
    run_ = std::make_unique<MasterRun>(config);
    run_->begin();
    ASSERT_TRUE(run_->runUntil([this] { return run_->allOperational(); }, seconds{2}));
    run_->runToNextCycle();
  }
  /// What leaves in a cycle of 10 ms.
  std::vector<std::string> cycle(std::optional<std::size_t> room) {
    run_->room = room;
    run_->sent.clear();
    run_->step();
    run_->runToNextCycle();
    return run_->sent;
  }

  std::unique_ptr<MasterRun> run_;
};

MasterConfig guarded(std::size_t nodes) {
  MasterConfig config = busConfig(nodes);
  for (NodeConfig& node : config.nodes) node.error_control.mode = ErrorControlMode::kGuarding;
  return config;
}

// The first to find no place is the first of the next cycle: with one place each of them gets its turn.
TEST_F(FullQueue, EachNodeGetsItsTurn) {
  ASSERT_NO_FATAL_FAILURE(start(guarded(3)));
  EXPECT_THAT(cycle(1), ElementsAre("201#7E040000"));
  EXPECT_THAT(cycle(1), ElementsAre("202#7E040000"));
  EXPECT_THAT(cycle(1), ElementsAre("203#7E040000"));
  EXPECT_THAT(cycle(2), ElementsAre("201#7E040000", "202#7E040000"));
  EXPECT_THAT(cycle(3), ElementsAre("203#7E040000", "201#7E040000", "202#7E040000"));
}

// What stops a drive that is not heard has its turn as well, and takes none from those that are heard.
TEST_F(FullQueue, ANodeThatFellSilentGetsItsTurn) {
  ASSERT_NO_FATAL_FAILURE(start(busConfig(3)));
  run_->loses = [](const CanFrame& frame) { return frame.id == 0x701; };
  ASSERT_TRUE(run_->reaches(NodeState::kLost, seconds{1}));
  ASSERT_TRUE(run_->master.status(0).fellSilent());
  run_->before_cycle = [](Master& master) {
    for (std::size_t node = 0; node < 3; ++node) {
      master.setReceivePdo(node, 0, fromHex("7E 04 00 00"));
      master.tellUnheard(node, 0);
    }
  };
  run_->runToNextCycle();
  const std::uint64_t superseded = run_->master.status(0).counters.superseded;
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(cycle(1), ElementsAre("201#7E040000")) << i;
    EXPECT_THAT(cycle(1), ElementsAre("202#7E040000")) << i;
    EXPECT_THAT(cycle(1), ElementsAre("203#7E040000")) << i;
  }
  EXPECT_EQ(superseded + 6, run_->master.status(0).counters.superseded);
  EXPECT_EQ(NodeState::kLost, run_->master.status(0).state) << "nor asked as long as its words find no place";
}

// In place of the second PDO of a node the first would go out for ever.
TEST_F(FullQueue, EachPdoOfANodeGetsItsTurn) {
  MasterConfig config = guarded(1);
  PdoConfig second = config.nodes[0].receive_pdos[0];
  second.number = 2;
  second.cob_id = 0x301;
  config.nodes[0].receive_pdos.push_back(second);
  ASSERT_NO_FATAL_FAILURE(start(config));
  run_->before_cycle = [](Master& master) {
    for (const std::size_t pdo : {std::size_t{0}, std::size_t{1}}) master.setReceivePdo(0, pdo, fromHex("7E 04 00 00"));
  };
  EXPECT_THAT(cycle(1), ElementsAre("201#7E040000"));
  EXPECT_THAT(cycle(1), ElementsAre("301#7E040000"));
  EXPECT_THAT(cycle(1), ElementsAre("201#7E040000"));
}

// Guarding says "your master works": a node that hears it, and no process data, would turn its motor for ever.
TEST_F(FullQueue, NobodyIsGuardedWhileSomebodyHearsNoProcessData) {
  ASSERT_NO_FATAL_FAILURE(start(guarded(2)));
  for (int i = 0; i < 25; ++i) EXPECT_THAT(cycle(1), Not(Contains(testing::HasSubstr("#R"))));
  EXPECT_TRUE(run_->allOperational()) << "nothing of this is a loss yet";
  std::vector<std::string> left;
  for (int i = 0; i < 20; ++i) {
    for (const std::string& frame : cycle(std::nullopt)) left.push_back(frame);
  }
  EXPECT_THAT(left, Contains("701#R1"));
  EXPECT_THAT(left, Contains("702#R1"));
}

TEST_F(FullQueue, NeitherDoesOurHeartbeatGoOut) {
  MasterConfig config = busConfig(2);
  config.own_id = 127;
  config.heartbeat_time = milliseconds{50};
  ASSERT_NO_FATAL_FAILURE(start(config));
  for (int i = 0; i < 25; ++i) EXPECT_THAT(cycle(1), Not(Contains("77F#05")));
  EXPECT_THAT(cycle(std::nullopt), Contains("77F#05"));
}

// A synchronous RPDO acts with SYNC alone.
TEST_F(FullQueue, ASyncWithoutAPlaceIsProcessDataLost) {
  MasterConfig config = guarded(1);
  config.sync_cob_id = 0x80;
  ASSERT_NO_FATAL_FAILURE(start(config));
  for (int i = 0; i < 25; ++i) EXPECT_THAT(cycle(1), Not(Contains(testing::HasSubstr("#R"))));
  cycle(2);
  EXPECT_THAT(cycle(2), ElementsAre("201#7E040000", "080#"));
}

// Behind the RPDOs it would find no place for ever, and none of them would act: it has its turn as each of them has.
TEST_F(FullQueue, SyncGetsItsTurn) {
  MasterConfig config = guarded(2);
  config.sync_cob_id = 0x80;
  ASSERT_NO_FATAL_FAILURE(start(config));
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(cycle(1), ElementsAre("201#7E040000")) << i;
    EXPECT_THAT(cycle(1), ElementsAre("202#7E040000")) << i;
    EXPECT_THAT(cycle(1), ElementsAre("080#")) << i;
  }
  EXPECT_THAT(cycle(2), ElementsAre("201#7E040000", "202#7E040000"));
  EXPECT_THAT(cycle(2), ElementsAre("080#", "201#7E040000"));
  EXPECT_THAT(cycle(2), ElementsAre("202#7E040000", "080#"));
  EXPECT_THAT(cycle(2), ElementsAre("201#7E040000", "202#7E040000"));
  EXPECT_THAT(cycle(3), ElementsAre("080#", "201#7E040000", "202#7E040000"));
  EXPECT_THAT(cycle(3), ElementsAre("201#7E040000", "202#7E040000", "080#")) << "behind what it makes act";
}

// A cycle without any place, which they all miss, takes nobody's turn.
TEST_F(FullQueue, WithLessThanOnePlaceInACycleEachGetsItsTurn) {
  MasterConfig config = guarded(2);
  config.sync_cob_id = 0x80;
  ASSERT_NO_FATAL_FAILURE(start(config));
  for (const char* const next : {"201#7E040000", "202#7E040000", "080#", "201#7E040000", "202#7E040000", "080#"}) {
    EXPECT_THAT(cycle(0), IsEmpty());
    EXPECT_THAT(cycle(1), ElementsAre(next));
  }
}

// Also where something else found no place and process data were dropped for its sake.
TEST_F(FullQueue, WhatWasDroppedForACommandGoesFirst) {
  ASSERT_NO_FATAL_FAILURE(start(guarded(3)));
  EXPECT_THAT(cycle(1), ElementsAre("201#7E040000"));
  run_->say("000#0203");  // another master stops the third: it is to be led back
  EXPECT_THAT(cycle(0), IsEmpty());
  EXPECT_THAT(cycle(1), ElementsAre("000#8003"));
  EXPECT_THAT(cycle(1), ElementsAre("202#7E040000"));
  EXPECT_THAT(cycle(1), ElementsAre("201#7E040000"));
}

// A bus that is ended, or begun anew, waits for nobody.
TEST_F(FullQueue, AnEndIsSaidInTheMiddleOfACycle) {
  ASSERT_NO_FATAL_FAILURE(start(guarded(1)));
  EXPECT_THAT(cycle(0), IsEmpty());
  run_->room.reset();
  run_->master.releaseAll(run_->now);
  CanFrame frame;
  ASSERT_TRUE(run_->master.pollTransmit(frame));
  EXPECT_EQ("000#8201", text(frame));
}

TEST_F(FullQueue, ABusThatIsBegunAnewWaitsForNobody) {
  MasterConfig config = busConfig(2);
  ASSERT_NO_FATAL_FAILURE(start(config));
  run_->nodes[1]->powerOff();
  run_->run(seconds{60});  // it was given up, and reset
  run_->runToNextCycle();
  EXPECT_THAT(cycle(0), IsEmpty());
  run_->master.restart(run_->now);
  run_->room.reset();
  run_->sent.clear();
  run_->run(milliseconds{9});
  EXPECT_THAT(run_->sent, Contains("000#8202"));
}

}  // namespace
}  // namespace nord_driver::canopen
