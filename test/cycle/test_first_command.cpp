// Right after start no command has been heard yet, and that is no command of zero: a commander that is talking already
// is heard 0.1 to 0.25 s later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

Request enableRequest(double patience) {
  Request request;
  request.id = 7;
  request.kind = RequestKind::kEnable;
  request.patience = seconds(patience);
  return request;
}

class FirstCommand : public ::testing::Test {
 protected:
  static CycleConfig config(Duration cmd_vel_timeout) {
    CycleConfig config = CycleBench::config();
    config.cmd_vel_timeout = cmd_vel_timeout;
    return config;
  }
  /// A commander at 50 Hz that is heard for the first time `from` after start, to `to`.
  static void live(CycleBench& robot, double velocity, Duration from, Duration to) {
    for (Duration age{}; age < to; age += CycleBench::kCycle) {
      if (age >= from && age.count() % (2 * CycleBench::kCycle.count()) == 0) robot.commandBase(velocity);
      robot.step();
    }
  }
  static bool everMoved(CycleBench& robot) {
    for (const auto& inverter : robot.transport.inverters) {
      if (inverter.frequency() != 0) return true;
    }
    return robot.snapshot().base.pose.x != 0.0;
  }
};

TEST_F(FirstCommand, AutoEnableNeverStartsUnderACommanderThatIsTalkingAlready) {
  for (const double from : {0.0, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4}) {
    CycleBench robot{config(seconds(0.5)), true};
    live(robot, 0.2, seconds(from), seconds(20.0));
    EXPECT_FALSE(everMoved(robot)) << "first heard after " << from << " s";
    EXPECT_FALSE(robot.snapshot().base.enabled);
    robot.run(49);
    EXPECT_FALSE(robot.snapshot().base.enabled);
    robot.run(20);
    EXPECT_TRUE(robot.snapshot().base.enabled) << "it has been quiet for cmd_vel_timeout";
    EXPECT_FALSE(everMoved(robot));
  }
}

// An enabling that nobody has asked for is answered to nobody: the log tells why there was none.
TEST_F(FirstCommand, AutoEnableThatEnablesNobodySaysWhy) {
  CycleBench robot{config(seconds(0.5)), true};
  robot.transport.inverters[CycleBench::kLift].stuck = true;
  robot.run(1000);
  EXPECT_FALSE(robot.snapshot().base.enabled);
  const std::vector<std::string> told = robot.events();
  EXPECT_EQ(1, std::count_if(told.begin(), told.end(), [](const std::string& line) {
              return line.find(
                         "warning: auto_enable has enabled nobody, and does not try again: drive lift: the inverter "
                         "did not reach \"operation enabled\" in time") == 0;
            }));
}

// Refused, it has not begun anything: what is to happen once by itself is still to come.
TEST_F(FirstCommand, ARefusedEnableLeavesAutoEnableWhatItWas) {
  CycleBench robot{config(seconds(0.5)), true};
  for (auto& inverter : robot.transport.inverters) inverter.silent = true;
  robot.run(60);
  EXPECT_FALSE(robot.ask(RequestKind::kEnable).success);
  for (auto& inverter : robot.transport.inverters) inverter.silent = false;
  robot.run(200);
  EXPECT_TRUE(robot.snapshot().base.enabled);
  CycleBench stopped{config(seconds(0.5)), true};
  for (auto& inverter : stopped.transport.inverters) inverter.silent = true;
  stopped.run(60);
  stopped.ask(RequestKind::kDisable);
  for (auto& inverter : stopped.transport.inverters) inverter.silent = false;
  stopped.run(200);
  EXPECT_FALSE(stopped.snapshot().base.enabled) << "a stop is another thing";
}

// Neither when it had to wait before it was refused: right after the start, or after a publisher was connected.
TEST_F(FirstCommand, AnEnableThatIsRefusedAfterWaitingLeavesAutoEnableWhatItWas) {
  for (const bool at_start : {true, false}) {
    CycleBench robot{config(seconds(0.5)), true};
    for (auto& inverter : robot.transport.inverters) inverter.silent = true;
    robot.run(at_start ? 5 : 100);
    if (!at_start) robot.ports.commanderConnected(robot.transport.time);
    robot.ports.submit(enableRequest(3.0));
    robot.run(10);
    ASSERT_EQ(0u, robot.completions.count(7)) << "it waits";
    robot.run(60);
    ASSERT_EQ(1u, robot.completions.count(7));
    EXPECT_THAT(robot.completions[7].message.str(), HasSubstr("the inverter does not answer"));
    for (auto& inverter : robot.transport.inverters) inverter.silent = false;
    robot.run(200);
    EXPECT_TRUE(robot.snapshot().base.enabled) << at_start;
  }
}

// Whoever says stop meanwhile does not want it later either.
TEST_F(FirstCommand, AStopWhileAnEnableWaitsIsTheEndOfAutoEnable) {
  for (const RequestKind stop : {RequestKind::kDisable, RequestKind::kQuickStop}) {
    CycleBench robot{config(seconds(0.5)), true};
    robot.run(5);
    robot.ports.submit(enableRequest(3.0));
    robot.run(10);
    ASSERT_EQ(0u, robot.completions.count(7)) << "it waits";
    ASSERT_TRUE(robot.ask(stop).success);
    EXPECT_FALSE(robot.completions[7].success);
    robot.run(300);
    EXPECT_FALSE(robot.snapshot().base.enabled);
    EXPECT_FALSE(robot.snapshot().drives[CycleBench::kLift].enabled);
  }
}

// It takes the place of what was to happen by itself: of one drive alone the others stay disabled.
TEST_F(FirstCommand, AnEnableThatIsGrantedAfterWaitingIsTheEndOfAutoEnable) {
  CycleBench robot{config(seconds(0.5)), true};
  robot.run(5);
  Request lift = enableRequest(3.0);
  lift.drive = CycleBench::kLift;
  robot.ports.submit(lift);
  robot.run(10);
  ASSERT_EQ(0u, robot.completions.count(7)) << "it waits";
  robot.run(300);
  EXPECT_STREQ("enabled", robot.completions[7].message.c_str());
  EXPECT_TRUE(robot.snapshot().drives[CycleBench::kLift].enabled);
  EXPECT_FALSE(robot.snapshot().base.enabled);
}

// Two publishers: nobody is followed; but it would be as soon as the other one is gone.
TEST_F(FirstCommand, OneThatIsOnlyHeldIsACommandForWhoeverEnables) {
  CycleBench robot{config(seconds(0.5)), true};
  for (int i = 0; i < 300; ++i) {
    TwistCommand command{{0.25, 0.0}, robot.transport.time, true};
    command.held = true;
    robot.ports.commandBase(command);
    robot.step();
  }
  EXPECT_FALSE(robot.snapshot().base.enabled) << "auto_enable";
  const Completion answer = robot.ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("the newest cmd_vel is not zero"));
}

TEST_F(FirstCommand, AutoEnableActsUnderZerosAndUnderNothing) {
  for (const bool zeros : {true, false}) {
    CycleBench robot{config(seconds(0.5)), true};
    live(robot, 0.0, zeros ? seconds(0.2) : seconds(9.0), seconds(0.49));
    EXPECT_FALSE(robot.snapshot().base.enabled) << zeros;
    live(robot, 0.0, zeros ? Duration::zero() : seconds(9.0), seconds(0.2));
    EXPECT_TRUE(robot.snapshot().base.enabled) << zeros;
    live(robot, 0.2, Duration::zero(), seconds(2.0));
    EXPECT_TRUE(everMoved(robot)) << "a command that begins after the start is followed";
  }
}

// One command that moves within the time begins it anew, though a zero followed.
TEST_F(FirstCommand, AutoEnableWantsZeroOrNothingInAllOfTheTime) {
  CycleBench robot{config(seconds(1.0)), true};
  live(robot, 0.0, Duration::zero(), seconds(0.8));
  robot.commandBase(0.2);
  robot.commandBase(0.0);
  live(robot, 0.0, Duration::zero(), seconds(0.99));
  EXPECT_FALSE(robot.snapshot().base.enabled);
  live(robot, 0.0, Duration::zero(), seconds(0.2));
  EXPECT_TRUE(robot.snapshot().base.enabled);
}

TEST_F(FirstCommand, AutoEnableHearsTheCommandsOfSingleDrivesToo) {
  CycleBench robot{config(seconds(0.5)), true};
  robot.run(20);
  for (int i = 0; i < 200; ++i) {
    robot.commandLift(1.0);
    robot.step();
  }
  EXPECT_FALSE(everMoved(robot));
  EXPECT_FALSE(robot.snapshot().drives[CycleBench::kLift].enabled);
}

// However short or endless cmd_vel_timeout is, half a second is listened.
TEST_F(FirstCommand, HalfASecondIsTheLeast) {
  for (const double timeout : {0.0, 0.1}) {
    CycleBench robot{config(seconds(timeout)), true};
    robot.run(49);
    EXPECT_FALSE(robot.snapshot().base.enabled) << timeout;
    robot.run(20);
    EXPECT_TRUE(robot.snapshot().base.enabled) << timeout;
  }
}

TEST_F(FirstCommand, EnableRightAfterStartWaitsAndIsGranted) {
  CycleBench robot{config(seconds(0.5)), false};
  robot.run(10);
  robot.ports.submit(enableRequest(3.0));
  robot.run(39);
  EXPECT_EQ(0u, robot.completions.count(7));
  EXPECT_EQ(0x047E, robot.controlWord(CycleBench::kLeft));
  robot.run(20);
  ASSERT_EQ(1u, robot.completions.count(7));
  EXPECT_STREQ("enabled", robot.completions[7].message.c_str());
}

TEST_F(FirstCommand, EnableRightAfterStartIsRefusedWhenTheFirstCommandMoves) {
  CycleBench robot{config(seconds(0.5)), false};
  robot.run(10);
  robot.ports.submit(enableRequest(3.0));
  live(robot, 0.2, seconds(0.15), seconds(3.0));
  ASSERT_EQ(1u, robot.completions.count(7));
  EXPECT_THAT(robot.completions[7].message.c_str(), HasSubstr("the newest cmd_vel is not zero (0.200 m/s"));
  EXPECT_FALSE(everMoved(robot));
}

// What a publisher has to say that was connected a moment ago has not been heard yet either.
TEST_F(FirstCommand, APublisherThatHasJustBeenConnectedIsListenedToFirst) {
  for (const bool by_itself : {true, false}) {
    CycleBench robot{config(seconds(0.5)), by_itself};
    robot.transport.inverters[CycleBench::kLift].silent = true;
    robot.run(100);
    robot.ports.commanderConnected(robot.transport.time);
    robot.transport.inverters[CycleBench::kLift].silent = false;
    robot.run(5);
    if (!by_itself) robot.ports.submit(enableRequest(3.0));
    robot.run(44);
    EXPECT_EQ(0x047E, robot.controlWord(CycleBench::kLeft)) << by_itself;
    robot.run(20);
    EXPECT_TRUE(robot.snapshot().base.enabled) << by_itself;
    robot.ports.commanderConnected(robot.transport.time);
    robot.run(20);
    EXPECT_TRUE(robot.snapshot().base.enabled) << "what is enabled stays so";
  }
}

TEST_F(FirstCommand, AStopEndsTheWaiting) {
  CycleBench robot{config(seconds(0.5)), false};
  robot.run(10);
  robot.ports.submit(enableRequest(3.0));
  robot.run(5);
  Request stop = enableRequest(3.0);
  stop.id = 8;
  stop.kind = RequestKind::kQuickStop;
  robot.ports.submit(stop);
  robot.run(200);
  EXPECT_FALSE(robot.snapshot().base.enabled);
  EXPECT_STREQ("disabled again before all drives were enabled", robot.completions[7].message.c_str());
  EXPECT_TRUE(robot.completions[8].success);
}

// Who cannot wait so long is told at once, with the time.
TEST_F(FirstCommand, EnableIsRefusedAtOnceWhenTheTimeIsLongerThanItsPatience) {
  CycleBench robot{config(seconds(10.0)), false};
  robot.run(30);  // all that decides motion was read
  robot.ports.submit(enableRequest(3.0));
  robot.step();
  ASSERT_EQ(1u, robot.completions.count(7));
  EXPECT_FALSE(robot.completions[7].success);
  EXPECT_STREQ("cmd_vel has been listened to for 0.3 s only: ask again in 9.7 s", robot.completions[7].message.c_str());
}

}  // namespace
}  // namespace nord_driver::cycle
