// A node that left operation without a reset: what goes on while it is configured again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::IsEmpty;

MasterConfig guardedFor(Duration guard_time, std::uint8_t life_time_factor) {
  MasterConfig config = busConfig(1, 0x32);
  ErrorControl& control = config.nodes[0].error_control;
  control.mode = ErrorControlMode::kGuarding;
  control.guard_time = guard_time;
  control.life_time_factor = life_time_factor;
  return config;
}

// Its life time runs on in pre-operational (CiA 301 7.2.8.3.2): without a question for so long it trips E10, by our doing.
TEST(LeftOperational, IsGuardedWhileItIsConfiguredAgain) {
  MasterRun run{guardedFor(milliseconds{250}, 3)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  run.run(seconds{1});
  ScriptedNode& node = *run.nodes[0];
  node.sdo_delay = milliseconds{60};
  Instant asked_at = run.now;
  node.receive(frame("000#8032"), run.now);
  run.say("000#8032");
  ASSERT_EQ(NodeState::kBooting, run.master.status(0).state);
  const Instant begin = run.now;
  Duration longest{};
  int guards = node.guards;
  const bool started = run.runUntil(
      [&] {
        longest = std::max<Duration>(longest, run.now - asked_at);
        if (node.guards != guards) asked_at = run.now;
        guards = node.guards;
        return run.master.status(0).state == NodeState::kOperational;
      },
      seconds{4});
  ASSERT_TRUE(started) << run.master.status(0).reason.c_str();
  ASSERT_GT(run.now - begin, milliseconds{750}) << "longer than its life time";
  EXPECT_LT(longest, milliseconds{250});
  EXPECT_EQ(0u, run.master.status(0).counters.toggle_errors);
  EXPECT_THAT(run.violations(), IsEmpty());
}

// The first question after a reset begins a life time, which nobody may keep up when the start-up fails.
TEST(LeftOperational, IsNotAskedAfterAReset) {
  MasterRun run{guardedFor(milliseconds{250}, 3)};
  run.begin();
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{2}));
  ScriptedNode& node = *run.nodes[0];
  node.boot_time = milliseconds{5};
  node.receive(frame("000#8232"), run.now);  // its communication, by another master
  run.say("000#8232");
  run.run(milliseconds{10});
  EXPECT_EQ(0, node.guards);
  EXPECT_TRUE(run.reaches(NodeState::kOperational, seconds{2})) << run.master.status(0).reason.c_str();
  EXPECT_EQ(0u, run.master.status(0).counters.toggle_errors);
}

/// Without error control, operational, and sends a TPDO with each SYNC.
struct Unwatched : MasterRun {
  Unwatched() : MasterRun{config()} {
    begin();
    EXPECT_TRUE(reaches(NodeState::kOperational, seconds{1}));
    run(seconds{3});
    EXPECT_EQ(0u, master.status(0).counters.losses) << "its process data comes";
  }
  static MasterConfig config() {
    MasterConfig config = busConfig(1);
    config.sync_cob_id = 0x80;
    config.nodes[0].transmit_pdos[0].transmission_type = 1;
    config.nodes[0].error_control.mode = ErrorControlMode::kNone;
    config.nodes[0].silence = seconds{1};
    return config;
  }
};

// Nobody tells that it left operation, but its process data ends.
TEST(LeftOperational, WithoutErrorControlIsSeenByItsProcessData) {
  Unwatched run;
  run.nodes[0]->state = 0x7F;
  run.run(milliseconds{980});
  EXPECT_EQ(NodeState::kOperational, run.master.status(0).state);
  ASSERT_TRUE(run.reaches(NodeState::kLost, milliseconds{40}));
  EXPECT_EQ("sent no process data for 1000 ms", run.eventText(CanopenEventKind::kNodeLost));
  ASSERT_TRUE(run.reaches(NodeState::kOperational, seconds{1})) << run.master.status(0).reason.c_str();
  EXPECT_EQ(0x05, run.nodes[0]->state);
  run.run(seconds{3});
  EXPECT_EQ(1u, run.master.status(0).counters.losses);
}

// It may be only unheard: what stops its drive goes out before anything that makes it deaf to that.
TEST(LeftOperational, WithoutErrorControlIsToldFirst) {
  Unwatched run;
  run.loses = [](const CanFrame& frame) { return frame.id == 0x181; };
  ASSERT_TRUE(run.reaches(NodeState::kLost, seconds{2}));
  run.sent.clear();
  EXPECT_TRUE(run.master.status(0).fellSilent());
  run.run(milliseconds{95});
  EXPECT_THAT(run.sent, testing::Each("080#")) << "which makes an RPDO act";
}

}  // namespace
}  // namespace nord_driver::canopen
