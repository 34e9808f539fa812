// The clean exit: every node is let go so that it does not miss us, in the way its configuration allows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

MasterConfig guardedBus(std::size_t nodes, BootReset reset) {
  MasterConfig config = busConfig(nodes);
  for (NodeConfig& node : config.nodes) {
    node.reset = reset;
    node.error_control.mode = ErrorControlMode::kGuarding;
  }
  return config;
}

/// All nodes operational, then released; `sent` and the nodes' `writes` are what came of that.
struct Released : MasterRun {
  explicit Released(const MasterConfig& config) : MasterRun{config} {
    begin();
    EXPECT_TRUE(runUntil([this] { return allOperational(); }, seconds{2}));
    run(milliseconds{250});
    sent.clear();
    for (auto& node : nodes) node->writes.clear();
  }
  void release() { master.releaseAll(now); }
  bool ends(Duration limit) {
    return runUntil([this] { return master.released(); }, limit);
  }
};

// Power-on values watch nobody.
TEST(Release, ANodeThatMayBeResetIsReset) {
  Released run{guardedBus(2, BootReset::kResetNode)};
  run.release();
  EXPECT_EQ(NodeState::kReleased, run.master.status(0).state);
  run.run(seconds{2});
  EXPECT_THAT(run.sent, ElementsAre("000#8201", "000#8202"));
  EXPECT_TRUE(run.master.released());
  EXPECT_EQ(0u, run.count(CanopenEventKind::kNodeLost));
  run.master.restart(run.now);
  EXPECT_TRUE(run.runUntil([&] { return run.allOperational(); }, seconds{1}));
}

// 100Ch and 100Dh are 0 before the questions end, and only then it is led out of operational.
TEST(Release, AGuardedNodeIsToldNotToWatchUs) {
  Released run{guardedBus(1, BootReset::kNone)};
  run.release();
  EXPECT_FALSE(run.master.released());
  ASSERT_TRUE(run.ends(milliseconds{200}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("100C:00=0", "100D:00=0"));
  EXPECT_EQ("000#8001", run.sent.back());
  run.sent.clear();
  run.run(seconds{2});
  EXPECT_THAT(run.sent, IsEmpty());
  EXPECT_EQ(0x7F, run.nodes[0]->state);
  EXPECT_THAT(run.violations(), IsEmpty());
}

// It may count from its last question on, which was long ago: it is asked before it gets a life time again.
TEST(Release, TheNextStartAsksBeforeItSetsALifeTime) {
  Released run{guardedBus(1, BootReset::kNone)};
  run.release();
  ASSERT_TRUE(run.ends(milliseconds{200}));
  run.run(seconds{5});
  run.sent.clear();
  run.master.restart(run.now);
  ASSERT_TRUE(run.runUntil([&] { return run.allOperational(); }, seconds{2}));
  const auto question = std::find(run.sent.begin(), run.sent.end(), "701#R1");
  const auto write = std::find(run.sent.begin(), run.sent.end(), "601#2B0C100064000000");
  ASSERT_NE(run.sent.end(), write);
  EXPECT_LT(question, write);
  EXPECT_THAT(run.violations(), IsEmpty());
}

TEST(Release, ANodeThatWatchesOurHeartbeatIsToldNotTo) {
  MasterConfig config = busConfig(1);
  config.own_id = 127;
  config.heartbeat_time = milliseconds{100};
  config.nodes[0].reset = BootReset::kNone;
  config.nodes[0].error_control.master_timeout = milliseconds{300};
  Released run{config};
  run.release();
  ASSERT_TRUE(run.ends(milliseconds{200}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("1016:01=0"));
  EXPECT_EQ("000#8001", run.sent.back());
}

// Nothing watches us: nothing is written.
TEST(Release, ANodeWithoutErrorControlIsOnlyLedBack) {
  MasterConfig config = busConfig(1);
  config.nodes[0].reset = BootReset::kNone;
  config.nodes[0].error_control.mode = ErrorControlMode::kNone;
  Released run{config};
  run.release();
  run.run(milliseconds{100});
  EXPECT_THAT(run.sent, ElementsAre("000#8001"));
}

// Each in its way: one node that may not be reset does not keep the others from it.
TEST(Release, EachNodeInItsWay) {
  MasterConfig config = guardedBus(2, BootReset::kNone);
  config.nodes[0].reset = BootReset::kResetCommunication;
  Released run{config};
  run.release();
  ASSERT_TRUE(run.ends(milliseconds{200}));
  EXPECT_THAT(run.sent, Contains("000#8201"));
  EXPECT_THAT(run.sent, Contains("000#8002"));
  EXPECT_THAT(run.nodes[0]->writes, IsEmpty());
  EXPECT_THAT(run.nodes[1]->writes, ElementsAre("100C:00=0", "100D:00=0"));
}

// While it answers slowly it is guarded on, and gets no RPDO.
TEST(Release, GuardingGoesOnUntilTheNodeIsTold) {
  Released run{guardedBus(1, BootReset::kNone)};
  run.nodes[0]->sdo_delay = milliseconds{250};
  const int guards = run.nodes[0]->guards;
  run.release();
  ASSERT_TRUE(run.ends(seconds{1}));
  EXPECT_GE(run.nodes[0]->guards - guards, 4);
  EXPECT_THAT(run.sent, Not(Contains(HasSubstr("201#"))));
}

// One that does not answer costs a second at most, and is let go all the same.
TEST(Release, ANodeThatDoesNotAnswerIsNotWaitedForLong) {
  Released run{guardedBus(1, BootReset::kNone)};
  run.nodes[0]->hears_sdo = false;
  const Instant start = run.now;
  run.release();
  ASSERT_TRUE(run.ends(seconds{3}));
  EXPECT_LE(run.now - start, milliseconds{1001});
  EXPECT_THAT(run.sent, Contains("000#8001"));
}

// One lost answer is forgiven.
TEST(Release, ALostAnswerIsAskedForAgain) {
  Released run{guardedBus(1, BootReset::kNone)};
  int lost = 0;
  run.loses = [&](const CanFrame& frame) { return frame.id == 0x581 && lost++ == 0; };
  run.release();
  ASSERT_TRUE(run.ends(seconds{1}));
  EXPECT_THAT(run.nodes[0]->writes, ElementsAre("100C:00=0", "100C:00=0", "100D:00=0"));
}

// A node that was never there, and one that is not started yet: no question begins a guarding that nobody would end.
TEST(Release, ANodeThatIsNotThereYet) {
  MasterRun run{guardedBus(1, BootReset::kNone)};
  run.master.restart(run.now);
  run.run(milliseconds{50});
  run.sent.clear();
  run.master.releaseAll(run.now);
  run.run(milliseconds{50});
  EXPECT_THAT(run.sent, ElementsAre("000#8001", "601#8000100000000008")) << "the question under way is given up";

  MasterRun starting{guardedBus(1, BootReset::kNone)};
  starting.begin();
  ASSERT_TRUE(starting.reaches(NodeState::kBooting, seconds{1}));
  starting.master.releaseAll(starting.now);
  ASSERT_TRUE(starting.runUntil([&] { return starting.master.released(); }, seconds{1}));
  EXPECT_EQ(0, starting.nodes[0]->guards);
}

TEST(Release, ABootUpEndsIt) {
  Released run{guardedBus(1, BootReset::kNone)};
  run.nodes[0]->hears_sdo = false;
  run.release();
  run.say("701#00");
  run.run(milliseconds{5});
  EXPECT_TRUE(run.master.released());
}

}  // namespace
}  // namespace nord_driver::canopen
