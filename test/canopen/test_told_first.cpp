// A node that falls silent, or comes back with the interface, may still hear what stops its drive: that goes out before
// anything that makes it deaf to it.
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

/// One node, operational, that answers SDO and sends no heartbeat any more.
class ToldFirst : public ::testing::Test {
 protected:
  void start(const MasterConfig& config) {
    run_ = std::make_unique<MasterRun>(config);
    run_->begin();
    ASSERT_TRUE(run_->reaches(NodeState::kOperational, seconds{2}));
    run_->loses = [](const CanFrame& frame) { return frame.id == 0x701; };
  }
  void lose() {
    ASSERT_TRUE(run_->reaches(NodeState::kLost, seconds{1}));
    run_->sent.clear();
  }
  bool hasSent(const std::string& begin) const {
    return std::any_of(run_->sent.begin(), run_->sent.end(),
                       [&begin](const std::string& frame) { return frame.compare(0, begin.size(), begin) == 0; });
  }

  std::unique_ptr<MasterRun> run_;
};

TEST_F(ToldFirst, IsNeitherAskedNorResetInTheFirstTenthOfASecond) {
  for (const BootReset reset : {BootReset::kResetCommunication, BootReset::kNone}) {
    MasterConfig config = busConfig(1);
    config.nodes[0].reset = reset;
    start(config);
    lose();
    run_->run(milliseconds{99});
    EXPECT_FALSE(hasSent("000#") || hasSent("601#"));
    EXPECT_EQ(NmtState::kOperational, run_->master.status(0).nmt) << "as far as anybody knows";
    run_->run(milliseconds{30});
    EXPECT_TRUE(hasSent("601#"));
    EXPECT_TRUE(hasSent("000#"));
  }
}

// A heartbeat that comes late is a sign of life, and no reason to reset it at once.
TEST_F(ToldFirst, AlsoWhereItsHeartbeatComesBackAtOnce) {
  start(busConfig(1));
  lose();
  run_->say("701#05");
  run_->run(milliseconds{95});
  EXPECT_FALSE(hasSent("000#") || hasSent("601#"));
  run_->run(milliseconds{30});
  EXPECT_TRUE(hasSent("000#"));
}

// Its heartbeat crosses the reset: what it says is over when that has left.
TEST_F(ToldFirst, ANodeThatWasResetIsNotOperationalWhateverItHasSaidBefore) {
  start(busConfig(1));
  lose();
  run_->loses = [this](const CanFrame& frame) {
    if (frame.id != 0x581) return false;
    run_->master.handleFrame(frame, run_->now);
    run_->say("701#05");
    return true;
  };
  ASSERT_TRUE(run_->runUntil([this] { return hasSent("000#8201"); }, seconds{1}));
  EXPECT_EQ(NmtState::kUnknown, run_->master.status(0).nmt);
}

// Cycles of the bus, however long they are: in the first the drive layer learns of the loss, in the two after it its word
// that stops goes out.
TEST_F(ToldFirst, WaitsForTwoWordsThatStop) {
  start(busConfig(1));
  Master& master = run_->master;
  lose();
  std::size_t words = 0;
  const auto asks = [&] {
    bool asked = false;
    for (int i = 0; i < 300; ++i) {
      run_->now += milliseconds{1};
      master.poll(run_->now);
      CanFrame frame;
      while (master.pollTransmit(frame)) {
        words += frame.id == 0x201 ? 1 : 0;
        asked = asked || frame.id == 0x601;
      }
    }
    return asked;
  };
  const auto cycle = [&](bool knows) {
    if (knows) {
      master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
      master.tellUnheard(0, 0);
    }
    master.startCycle(run_->now);
    return asks();
  };
  EXPECT_FALSE(asks());
  EXPECT_FALSE(cycle(false));
  EXPECT_FALSE(cycle(true));
  EXPECT_EQ(1u, words);
  EXPECT_TRUE(cycle(true));
  EXPECT_EQ(2u, words);
}

// Cycles that come one right after the other count as well, but a tenth of a second is left to it all the same.
TEST_F(ToldFirst, WaitsForATenthOfASecondToo) {
  start(busConfig(1));
  Master& master = run_->master;
  lose();
  const Instant lost = run_->now;
  for (int i = 0; i < 4; ++i) master.startCycle(run_->now);
  bool asked = false;
  while (!asked && run_->now < lost + seconds{1}) {
    master.poll(run_->now);
    CanFrame frame;
    while (master.pollTransmit(frame)) asked = asked || frame.id == 0x601 || frame.id == 0x000;
    if (!asked) run_->now += milliseconds{1};
  }
  EXPECT_TRUE(asked);
  EXPECT_GE(run_->now - lost, milliseconds{99});
}

// A word that the link did not take is not said: the cycles begin anew.
TEST_F(ToldFirst, WaitsUntilItsWordsLeave) {
  start(busConfig(1));
  lose();
  run_->before_cycle = [](Master& master) {
    master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
    master.tellUnheard(0, 0);
  };
  run_->refuses = [](const CanFrame& frame) { return frame.id == 0x201; };
  run_->run(seconds{2});
  EXPECT_FALSE(hasSent("000#") || hasSent("601#"));
  run_->runToNextCycle();
  run_->refuses = nullptr;
  run_->run(milliseconds{20});
  EXPECT_TRUE(hasSent("201#7E04"));
  EXPECT_FALSE(hasSent("000#") || hasSent("601#")) << "two cycles";
  run_->run(milliseconds{120});
  EXPECT_TRUE(hasSent("601#"));
  EXPECT_TRUE(hasSent("000#"));
}

// Said for a cycle, it does not count for those after it.
TEST_F(ToldFirst, OnlyWhatIsSaidForTheCycle) {
  start(busConfig(1));
  run_->before_cycle = [](Master& master) { master.setReceivePdo(0, 0, fromHex("7F 04 00 10")); };
  run_->runToNextCycle();
  run_->master.tellUnheard(0, 0);  // heard as yet
  lose();
  run_->run(milliseconds{30});
  EXPECT_FALSE(hasSent("201#"));
  run_->runToNextCycle();
  run_->sent.clear();
  run_->master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
  run_->before_cycle = [](Master&) {};
  run_->master.tellUnheard(0, 0);
  run_->run(milliseconds{30});
  EXPECT_EQ(1, std::count(run_->sent.begin(), run_->sent.end(), "201#7E040000"));
}

// The adapter was unplugged and is back: the node has gone on meanwhile.
TEST_F(ToldFirst, AsThereAfterTheInterfaceWasAway) {
  start(busConfig(1));
  run_->loses = nullptr;
  for (int i = 0; i < 2; ++i) run_->master.restart(run_->now);  // gone, and back
  run_->sent.clear();
  EXPECT_EQ(NodeState::kLost, run_->master.status(0).state);
  EXPECT_EQ(NmtState::kOperational, run_->master.status(0).nmt);
  run_->run(milliseconds{95});
  EXPECT_FALSE(hasSent("000#") || hasSent("601#"));
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{2})) << run_->master.status(0).reason.c_str();
}

// Also where nothing would ever tell that it is gone.
TEST_F(ToldFirst, AsThereAfterTheInterfaceWasAwayWithoutErrorControl) {
  MasterConfig config = busConfig(1);
  config.nodes[0].error_control.mode = ErrorControlMode::kNone;
  ASSERT_EQ(Duration::zero(), config.nodes[0].silence);
  start(config);
  run_->loses = nullptr;
  for (int i = 0; i < 2; ++i) run_->master.restart(run_->now);  // gone, and back
  run_->sent.clear();
  EXPECT_TRUE(run_->master.status(0).fellSilent());
  run_->before_cycle = [](Master& master) {
    master.setReceivePdo(0, 0, fromHex("7E 04 00 00"));
    master.tellUnheard(0, 0);
  };
  run_->run(milliseconds{95});
  EXPECT_FALSE(hasSent("000#") || hasSent("601#"));
  EXPECT_TRUE(hasSent("201#7E04"));
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{2})) << run_->master.status(0).reason.c_str();
}

// One that was not in operation hears no RPDO: it is led up at once.
TEST_F(ToldFirst, NotWhatWasNotInOperation) {
  MasterRun run{busConfig(1)};
  run.begin();
  run.master.restart(run.now);
  run.run(milliseconds{5});
  EXPECT_THAT(run.sent, Contains("000#8201"));
}

// An RPDO of type 1 acts with the next SYNC, which nobody else waits for.
TEST_F(ToldFirst, WithTheSyncThatMakesItAct) {
  MasterConfig config = busConfig(1);
  config.sync_cob_id = 0x80;
  start(config);
  lose();
  run_->run(milliseconds{95});
  EXPECT_GE(std::count(run_->sent.begin(), run_->sent.end(), "080#"), 9);
  run_->nodes[0]->powerOff();
  run_->run(seconds{30});
  run_->sent.clear();
  run_->run(seconds{1});
  EXPECT_THAT(run_->sent, Not(Contains("080#"))) << "it was reset, and hears no RPDO";
}

}  // namespace
}  // namespace nord_driver::canopen
