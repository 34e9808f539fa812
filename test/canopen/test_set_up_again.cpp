// A node that begins anew in the middle of its set-up, and whose boot-up is lost, has forgotten what it was given: without
// a look at all of it again it would run as it was delivered, guarded by nobody.
#include <gtest/gtest.h>

#include <algorithm>

#include "canopen/master_run.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kDelivered = 103, kWanted = 7;  // of 2066h:01

class SetUpAgain : public ::testing::Test {
 protected:
  void begin(ErrorControlMode mode = ErrorControlMode::kHeartbeat) {
    MasterConfig config = busConfig(1);
    config.nodes[0].setup.push_back({0x2066, 1, kWanted, 2});
    config.nodes[0].error_control.mode = mode;
    run_ = std::make_unique<MasterRun>(config);
    run_->begin();
  }
  bool isSetUp() { return node().object(0x2066, 1).value == kWanted; }
  /// Its supply breaks down for a moment, and its boot-up is not heard.
  void blink() {
    node().powerOff();
    run_->run(milliseconds{5});
    node().object(0x2066, 1).value = kDelivered;
    node().object(0x100C, 0).value = 0;
    node().object(0x100D, 0).value = 0;
    node().object(0x1017, 0).value = 0;
    node().sends_boot_up = false;
    node().powerOn(run_->now);
  }
  ScriptedNode& node() { return *run_->nodes[0]; }

  std::unique_ptr<MasterRun> run_;
};

TEST_F(SetUpAgain, AfterAnAnswerThatIsMissing) {
  begin();
  ASSERT_TRUE(run_->runUntil([this] { return isSetUp(); }, seconds{1}));
  run_->run(milliseconds{3});
  blink();
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{3})) << run_->master.status(0).reason.c_str();
  EXPECT_TRUE(isSetUp());
  EXPECT_TRUE(run_->violations().empty());
}

// The command to start is lost, and the node begins anew before the next one.
TEST_F(SetUpAgain, BeforeASecondStart) {
  for (const ErrorControlMode mode : {ErrorControlMode::kHeartbeat, ErrorControlMode::kGuarding}) {
    begin(mode);
    bool lost = false;
    run_->loses = [&lost](const CanFrame& frame) { return !lost && frame.id == 0x000 && (lost = frame.data[0] == 1); };
    ASSERT_TRUE(run_->runUntil([&lost] { return lost; }, seconds{1}));
    ASSERT_TRUE(isSetUp());
    blink();
    EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{3})) << run_->master.status(0).reason.c_str();
    EXPECT_TRUE(isSetUp());
    EXPECT_TRUE(run_->violations().empty());
  }
}

// One that has been asked for its state counts from there: it is asked on while it is looked at again.
TEST_F(SetUpAgain, TheLifeTimeGoesOnBeforeASecondStart) {
  begin(ErrorControlMode::kGuarding);
  node().answers_guarding = false;
  node().sdo_delay = milliseconds{20};
  ASSERT_TRUE(run_->runUntil([this] { return node().guards > 0; }, seconds{5}));
  const int before = node().reads;
  ASSERT_TRUE(run_->runUntil([&] { return node().reads > before + 1; }, seconds{5}));
  const int guards = node().guards;
  run_->run(milliseconds{100});
  EXPECT_GT(node().guards, guards);
  node().answers_guarding = true;
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{5}));
}

// On a line that loses one answer in ten each set-up has some that are missing.
TEST_F(SetUpAgain, NotForEver) {
  begin();
  int answers = 0;
  run_->loses = [&answers](const CanFrame& frame) { return frame.id == 0x581 && ++answers % 10 == 0; };
  EXPECT_TRUE(run_->reaches(NodeState::kOperational, seconds{10})) << run_->master.status(0).reason.c_str();
  EXPECT_EQ(1u, run_->count(CanopenEventKind::kNodeOperational));
  EXPECT_GE(answers, 30) << "and not at once either";
}

// Nothing is missing: it goes through its steps once.
TEST_F(SetUpAgain, NotWithoutACause) {
  begin();
  ASSERT_TRUE(run_->reaches(NodeState::kOperational, seconds{1}));
  EXPECT_EQ(1, std::count(run_->sent.begin(), run_->sent.end(), "601#4000100000000000"));
}

}  // namespace
}  // namespace nord_driver::canopen
