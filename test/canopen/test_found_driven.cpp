// A node whose drive was left turning by somebody who is gone is given what stops it before it is made deaf to that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Node 1 was operational before the bus is opened; its words that stop are given as the transport gives them.
class FoundDriven : public ::testing::Test {
 protected:
  void open(const MasterConfig& config, FoundMotion motion = FoundMotion::kDriven) {
    run_ = std::make_unique<MasterRun>(config);
    run_->powerAll();
    run_->run(milliseconds{50});
    run_->nodes[0]->state = 0x05;
    run_->before_cycle = [](Master& master) {
      master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
      if (master.status(0).stops_first) master.tellUnheard(0, 0);
    };
    run_->master.restart(run_->now);
    run_->master.setMotion(0, motion);
    run_->master.restart(run_->now);
    run_->sent.clear();
  }
  long count(const std::string& begin) const {
    return std::count_if(run_->sent.begin(), run_->sent.end(),
                         [&begin](const std::string& frame) { return frame.compare(0, begin.size(), begin) == 0; });
  }
  long resets() const { return count("000#8"); }

  std::unique_ptr<MasterRun> run_;
};

TEST_F(FoundDriven, IsNeitherResetNorAskedUntilItRests) {
  for (const BootReset reset : {BootReset::kResetCommunication, BootReset::kResetNode, BootReset::kNone}) {
    MasterConfig config = busConfig(1);
    config.nodes[0].reset = reset;
    open(config);
    run_->run(seconds{3});
    EXPECT_EQ(0, resets() + count("601#"));
    EXPECT_GT(count("201#7E04"), 290);
    EXPECT_TRUE(run_->master.status(0).stops_first);
    EXPECT_THAT(run_->master.status(0).reason.c_str(), HasSubstr("stopped before it is set up"));
    run_->master.setMotion(0, FoundMotion::kRests);
    EXPECT_FALSE(run_->master.status(0).reason.empty()) << "until it is begun with";
    ASSERT_TRUE(run_->reaches(NodeState::kOperational, seconds{2})) << run_->master.status(0).reason.c_str();
    EXPECT_FALSE(run_->master.status(0).stops_first);
    EXPECT_THAT(run_->violations(), testing::IsEmpty());
  }
}

// Terminals may keep it enabled: its node is begun with all the same, and its life time set.
TEST_F(FoundDriven, OneThatDoesNotObeyKeepsItsNodeForABoundedTime) {
  open(busConfig(1));
  run_->run(NodeConfig{}.only_asked - milliseconds{100});
  EXPECT_EQ(0, resets());
  run_->run(milliseconds{300});
  EXPECT_EQ(1, resets());
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{2}));
}

TEST_F(FoundDriven, AHeartbeatIsNoReasonToBegin) {
  open(busConfig(1));
  run_->say("701#05");
  run_->run(milliseconds{300});
  run_->say("701#05");
  run_->run(milliseconds{300});
  EXPECT_EQ(0, resets() + count("601#"));
}

// It hears no RPDO any more.
TEST_F(FoundDriven, OneThatIsNotOperationalAnyMoreIsBegunWith) {
  for (const char* const said : {"701#7F", "701#00"}) {
    open(busConfig(1));
    run_->run(milliseconds{300});
    run_->say(said);
    run_->run(milliseconds{150});
    EXPECT_FALSE(run_->master.status(0).stops_first) << said;
    EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{3}));
  }
}

TEST_F(FoundDriven, TheInterfaceMayGoAndComeBackMeanwhile) {
  open(busConfig(1));
  run_->run(milliseconds{300});
  run_->master.restart(run_->now);
  run_->run(seconds{1});
  EXPECT_EQ(0, resets());
  EXPECT_GT(count("201#7E04"), 120);
}

// What it was set to by somebody else goes on watching it, and its drive has the word that stops.
TEST_F(FoundDriven, IsLeftAsItIsWhenTheStartIsInterrupted) {
  for (const BootReset reset : {BootReset::kResetCommunication, BootReset::kNone}) {
    MasterConfig config = busConfig(1);
    config.nodes[0].reset = reset;
    open(config);
    run_->run(milliseconds{15});
    run_->sent.clear();
    run_->master.releaseAll(run_->now);
    EXPECT_FALSE(run_->master.released()) << "its last word is to leave";
    CanFrame frame;
    ASSERT_TRUE(run_->master.pollTransmit(frame));
    EXPECT_EQ("201#7E040000", text(frame));
    EXPECT_FALSE(run_->master.pollTransmit(frame));
    EXPECT_TRUE(run_->master.released());
  }
}

TEST_F(FoundDriven, OnAFullQueueTheEndComesAllTheSame) {
  open(busConfig(1));
  run_->run(milliseconds{15});
  run_->master.releaseAll(run_->now);
  CanFrame frame;
  ASSERT_TRUE(run_->master.pollTransmit(frame));
  run_->master.notSent();
  EXPECT_FALSE(run_->master.pollTransmit(frame));
  EXPECT_TRUE(run_->master.released());
}

// One that answers SYNC only is silent while nobody sends any.
TEST_F(FoundDriven, AskedBySync) {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  open(config, FoundMotion::kUnknown);
  run_->run(milliseconds{95});
  EXPECT_GE(count("080#"), 9);
  EXPECT_EQ(0, resets());
  EXPECT_THAT(run_->master.status(0).reason.c_str(), HasSubstr("is asked by SYNC"));
  run_->say("181#370B0020");
  EXPECT_EQ(1u, run_->master.transmitPdo(0, 0).count);
  run_->master.setMotion(0, FoundMotion::kDriven);
  EXPECT_THAT(run_->master.status(0).reason.c_str(), HasSubstr("its drives are stopped before it is set up"));
  run_->run(seconds{1});
  EXPECT_EQ(0, resets());

  open(config, FoundMotion::kUnknown);
  run_->run(milliseconds{150});
  EXPECT_EQ(1, resets()) << "nobody there";
}

TEST_F(FoundDriven, WhatWasHeardBeforeTheFirstFrameIsKept) {
  MasterRun run{busConfig(1)};
  run.master.restart(run.now);
  EXPECT_FALSE(run.master.noteOtherMaster(frame("181#370B0020"), run.now));
  ASSERT_EQ(1u, run.master.transmitPdo(0, 0).count);
  EXPECT_EQ(0x37, run.master.transmitPdo(0, 0).bytes[0]);
}

TEST_F(FoundDriven, OneAtRestIsResetAtOnce) {
  open(busConfig(1), FoundMotion::kRests);
  run_->run(milliseconds{5});
  EXPECT_EQ(1, resets());
  EXPECT_THAT(run_->sent, Not(Contains(HasSubstr("201#"))));
}

}  // namespace
}  // namespace nord_driver::canopen
