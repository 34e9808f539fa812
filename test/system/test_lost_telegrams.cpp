// Telegrams lost on the line, at the defaults of a user: how much a base drives through, and what it then does.
#include <gtest/gtest.h>

#include <cmath>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;

struct Line {
  const char* name;
  double slot_time;  ///< s
  int stations;
};

void PrintTo(const Line& line, std::ostream* out) {
  *out << line.name;
}

class LostTelegrams : public ::testing::TestWithParam<Line> {
 protected:
  static SimulatedRobot::Options options() {
    SimulatedRobot::Options options;
    options.bus["slot_time"] = GetParam().slot_time;
    options.wheels_a_side = GetParam().stations / 2;
    return options;
  }
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.drive(kHalfSpeed, 0.0, seconds{3});
  }
  void step() {
    robot_.command(kHalfSpeed);
    robot_.step();
  }
  void expectDrivesOn() {
    for (int i = 0; i < 100; ++i) {
      step();
      ASSERT_TRUE(robot_.snapshot().base.enabled) << i << ": " << robot_.snapshot().base.text.c_str();
    }
    EXPECT_EQ(0x2000, robot_.setpoint(0));
    EXPECT_EQ("no rule broken", robot_.segment().referee().report());
  }

  SimulatedRobot robot_{options()};
};

// A native UART, and what a USB adapter has without being asked.
INSTANTIATE_TEST_SUITE_P(Behind, LostTelegrams,
                         ::testing::Values(Line{"Uart", 0.0005, 2}, Line{"UartFourStations", 0.0005, 4},
                                           Line{"Adapter", 0.02, 2}, Line{"AdapterFourStations", 0.02, 4}),
                         [](const auto& test) { return std::string{test.param.name}; });

// It hears us and is not heard, and its watchdog is long: the stop word reaches it, as no silence limit of the bus may
// keep it from (What stops what), and the wheel comes down by its ramp instead of turning on until E10.2.
TEST(ALongWatchdog, AStationThatHearsIsToldToStop) {
  constexpr DriveIndex kMuted = 1;
  for (const double slot_time : {0.0005, 0.02}) {
    SimulatedRobot::Options options;
    options.bus["slot_time"] = slot_time;
    options.bus["watchdog"] = 3.0;
    SimulatedRobot robot{options};
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.drive(kHalfSpeed, 0.0, seconds{3});
    robot.unit(kMuted).setMute(true);
    const Instant muted = robot.transport().now();
    const Duration drive_timeout = robot.config().drives[kMuted].drive.drive_timeout;
    const sim::InverterModel& inverter = robot.unit(kMuted).inverter();
    while (robot.transport().now() - muted < drive_timeout + seconds{2}) {
      robot.command(kHalfSpeed);
      robot.step();
      ASSERT_EQ(0u, inverter.faultNumber()) << toSeconds(robot.transport().now() - muted) << " s after it fell silent";
    }
    EXPECT_NE(sim::InverterState::kOperationEnabled, inverter.state()) << slot_time;
    EXPECT_LT(std::fabs(inverter.frequency()), 0.1) << slot_time;
  }
}

// The answers of one station, all retries included, in two cycles running.
TEST_P(LostTelegrams, TheAnswersOfTwoCyclesStopNothing) {
  robot_.unit(1).setMute(true);
  step();
  step();
  robot_.unit(1).setMute(false);
  expectDrivesOn();
  EXPECT_EQ(0u, robot_.unit(1).counters().watchdog_trips);
}

/// Two cycles in which nothing of the line's one direction arrives, at both stations.
class WholeLine : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Loses, WholeLine, ::testing::Bool(),
                         [](const auto& test) { return std::string{test.param ? "Requests" : "Answers"}; });

TEST_P(WholeLine, ForTwoCyclesStopsNothing) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  for (int i = 0; i < 2; ++i) {
    robot.command(kHalfSpeed);
    if (GetParam()) {
      robot.segment().loseRequests(4);  // two stations, a repetition for each
    } else {
      robot.segment().loseAnswers(4);
    }
    robot.step();
  }
  for (int i = 0; i < 100; ++i) {
    robot.command(kHalfSpeed);
    robot.step();
    ASSERT_TRUE(robot.snapshot().base.enabled) << i << ": " << robot.snapshot().base.text.c_str();
    ASSERT_EQ(0x2000, robot.setpoint(0)) << i;
  }
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

}  // namespace
}  // namespace nord_driver::test
