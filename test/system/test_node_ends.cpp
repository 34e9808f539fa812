#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "system/node_ends.h"

namespace nord_driver::test {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

void submitTo(DrivenRobot& robot, cycle::RequestKind kind, DriveIndex drive = cycle::kAllDrives) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.parameter_set = 2;
  request.patience = seconds{3};
  robot.ports().submit(request);
}

void comeToRest(DrivenRobot& robot) {
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(milliseconds{600});  // the last command is too old by then
}

void steps(DrivenRobot& robot, int count) {
  for (int i = 0; i < count; ++i) robot.step();
}

bool standsStill(StopRig& rig) {
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    if (std::abs(rig.unit(i).shaftSpeed()) >= 0.1) return false;
  }
  return true;
}

}  // namespace

const std::vector<EndMoment>& endMoments() {
  static const std::vector<EndMoment> moments{{"Enabling",
                                               [](StopRig& rig) {
                                                 comeToRest(rig.robot());
                                                 submitTo(rig.robot(), cycle::RequestKind::kEnable);
                                                 steps(rig.robot(), 1);
                                               }},
                                              {"Disabling",
                                               [](StopRig& rig) {
                                                 submitTo(rig.robot(), cycle::RequestKind::kDisable);
                                                 steps(rig.robot(), 5);
                                               }},
                                              {"QuickStopping",
                                               [](StopRig& rig) {
                                                 submitTo(rig.robot(), cycle::RequestKind::kQuickStop);
                                                 steps(rig.robot(), 2);
                                               }},
                                              {"AFaultHasStoppedOne",
                                               [](StopRig& rig) {
                                                 rig.unit(1).inverter().trip(30, true);
                                                 steps(rig.robot(), 3);
                                               }},
                                              {"Acknowledging",
                                               [](StopRig& rig) {
                                                 rig.unit(1).inverter().trip(30, true);
                                                 rig.robot().run(seconds{3});
                                                 submitTo(rig.robot(), cycle::RequestKind::kAcknowledge);
                                                 steps(rig.robot(), 12);
                                               }},
                                              {"SwitchingTheSet",
                                               [](StopRig& rig) {
                                                 comeToRest(rig.robot());
                                                 submitTo(rig.robot(), cycle::RequestKind::kSelectParameterSet, 1);
                                                 steps(rig.robot(), 1);
                                               }},
                                              {"LocalControl",
                                               [](StopRig& rig) {
                                                 rig.unit(1).inverter().setLocalControl(true, 0.0);
                                                 steps(rig.robot(), 3);
                                               }},
                                              {"OneIsSilentAndNobodyKnows",
                                               [](StopRig& rig) {
                                                 rig.unit(1).setMute(true);
                                                 steps(rig.robot(), 1);
                                               },
                                               false},
                                              {"OneIsSilent",
                                               [](StopRig& rig) {
                                                 rig.unit(1).setMute(true);
                                                 steps(rig.robot(), 10);
                                               },
                                               false},
                                              {"TheBusIsLost",
                                               [](StopRig& rig) {
                                                 rig.setBusPresent(false);
                                                 steps(rig.robot(), 10);
                                               },
                                               false}};
  return moments;
}

void PrintTo(const EndMoment& moment, std::ostream* out) {
  *out << moment.name;
}

std::string nameOfEnd(const ::testing::TestParamInfo<std::tuple<StopBus, EndMoment>>& info) {
  return std::string(std::get<EndMoment>(info.param).name) + "At" + std::get<StopBus>(info.param).name;
}

void NodeEnds::SetUp() {
  rig_ = std::get<StopBus>(GetParam()).make();
  ASSERT_TRUE(rig_->robot().bringUpAndEnable());
  rig_->robot().drive(kHalfSpeed, 0.0, seconds{2});
  ASSERT_NO_FATAL_FAILURE(std::get<EndMoment>(GetParam()).bring(*rig_));
}

// Whenever it comes: nothing runs up any more, the idle word is the last one, and nobody is called at rest unseen.
TEST_P(NodeEnds, WithTheDrivesAtRest) {
  DrivenRobot& robot = rig_->robot();
  cycle::Request request;
  request.kind = cycle::RequestKind::kShutDown;
  request.id = 4711;
  request.patience = seconds{13};
  robot.ports().submit(request);
  const Instant asked = robot.transport().now();
  std::optional<cycle::Completion> answer;
  bool left[StopRig::kDrives] = {};
  while (!answer && robot.transport().now() - asked < seconds{12}) {
    robot.command(kHalfSpeed);  // somebody goes on commanding
    robot.step();
    for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
      const bool enabled = (robot.controlWord(i) & 0x3FFF) == 0x047F;
      EXPECT_FALSE(enabled && left[i]) << "enabled again, drive " << i;
      left[i] = left[i] || !enabled;
    }
    for (const auto& completion : robot.completions()) {
      if (completion.id == request.id) answer = completion;
    }
  }
  ASSERT_TRUE(answer) << "it does not end";
  EXPECT_EQ(std::get<EndMoment>(GetParam()).all_seen, answer->success) << answer->message.c_str();
  robot.step();  // before the node has heard of it
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) {
    if (!robot.snapshot().drives[i].online) continue;
    EXPECT_EQ(0x047E, robot.controlWord(i) & 0x3FFF) << i;
    EXPECT_EQ(0, robot.statusWord(i) & 0x0004) << i << " is enabled";
  }
  robot.transport().close();
  rig_->passWithoutTheDriver(seconds{20});  // who coasts, coasts long
  EXPECT_TRUE(standsStill(*rig_));
}

}  // namespace nord_driver::test
