// What must not hold up a stop: other services that wait for their answers, and a clock that stands still.
#include <gmock/gmock.h>
#include <std_srvs/SetBool.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "nord_driver/ReadParameter.h"
#include "nord_driver/SimParameterChannel.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

constexpr double kSpeed = 0.4;     // m/s
constexpr double kAnswered = 1.0;  // s; a parameter nobody answers for takes longer
constexpr Seconds kLate{0.3};      // together with the ramp to zero it is not answered in time

class Undisturbed : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    // The watchdog that expired after the test before has left E10.2.
    ASSERT_NO_FATAL_FAILURE(switchDrivesOffAndOn());
    robot().drive(0.0);
  }
  void TearDown() override {
    spoilParameterChannels(false);
    RobotTest::TearDown();
  }
  /// The newest of our commands is always heard, for three seconds.
  static void expectSteadySpeed() {
    bool steady = false;
    const auto attempt = [&] {
      const std::size_t from = robot().left.status.mark();
      ASSERT_TRUE(eventually([&] { return robot().left.status.mark() >= from + 150; }));
      steady = true;
      for (const auto& status : robot().left.status.since(from)) {
        steady = steady && std::fabs(status->velocity_command - kSpeed / 0.1) < 0.01;
      }
    };
    const auto prepare = [] {
      ASSERT_TRUE(robot().left.status.waitNext(
          [](const DriveStatus& status) { return status.velocity_command > 0.999 * kSpeed / 0.1; }));
    };
    tryAgainOnlyIfStoodStill(
        0.8 * commandTimeout(), attempt, [&] { return steady; }, prepare);
    EXPECT_TRUE(steady) << "the newest command is not heard";
  }
  static void stopQuickly(double& took) {
    const std::size_t from = robot().left.truth.mark();
    const ros::WallTime asked = ros::WallTime::now();
    const Answer answer = robot().trigger("quick_stop");
    took = (ros::WallTime::now() - asked).toSec();
    EXPECT_TRUE(answer.success) << answer;
    EXPECT_TRUE(robot().left.truth.waitFrom(
        from, [](const SimDrive& truth) { return truth.control_word == 0x047B || !truth.operation_enabled; }));
  }
  /// Of both drives: no parameter order is answered any more.
  static void spoilParameterChannels(bool silent) {
    for (const char* drive : {"left", "right"}) {
      SimParameterChannel service;
      service.request.silent = silent;
      EXPECT_TRUE(callService(std::string("nord_sim/") + drive + "/parameter_channel", service).success);
    }
  }
};

/// Clients that ask for parameters without end, more than the node serves at a time.
class Askers {
 public:
  Askers() {
    for (int i = 0; i < 12; ++i) {
      threads_.emplace_back([this, i] {
        while (!stop_) {
          ReadParameter service;
          service.request.number = 102;
          carryOut(std::string("nord_driver/") + (i % 2 == 0 ? "left" : "right") + "/read_parameter", service);
          ++answered_;
        }
      });
    }
  }
  ~Askers() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  int answered() const { return answered_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<int> answered_{0};
  std::vector<std::thread> threads_;
};

TEST_F(Undisturbed, CommandsAndStopsPassServicesThatWait) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(kSpeed));
  spoilParameterChannels(true);
  {
    Askers askers;
    ASSERT_TRUE(eventually([&] { return askers.answered() > 0; }));
    ASSERT_NO_FATAL_FAILURE(expectSteadySpeed());
    double took = 0.0;
    const auto prepare = [this] {
      robot().drive(0.0);
      enableAndDrive(kSpeed);
    };
    tryAgainOnlyIfStoodStill(
        kLate, [&] { stopQuickly(took); }, [&] { return took < kAnswered; }, prepare);
    EXPECT_LT(took, kAnswered) << "it waited behind others";
  }
}

// Gazebo stands still, a bag has ended, NTP sets the clock back: times of the bus and of commands run on, and
// /diagnostics goes on telling.
TEST_F(Undisturbed, RunsOnWhileTheClockOfRosStandsStill) {
  ros::param::set("/use_sim_time", true);  // nobody publishes /clock
  startDriver();
  ros::param::set("/use_sim_time", false);
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(kSpeed));
  robot().silence();
  EXPECT_TRUE(robot().waitForStandstill()) << "cmd_vel_timeout";
  const auto status = robot().left.status.next();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->header.stamp, ros::Time());
  EXPECT_EQ(status->state, DriveStatus::OPERATION_ENABLED);
  ASSERT_TRUE(robot().trigger("quick_stop").success);
  EXPECT_NE(
      robot().waitForDiagnostics(
          "base", [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; }),
      "")
      << "nothing was told of the stop";
}

}  // namespace
}  // namespace nord_driver::test
