// The node is asked to end while the robot drives: ramp, OFF1 until "ready to switch on" is seen, then the end.
#include <gmock/gmock.h>
#include <ros/network.h>
#include <signal.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "rostest/robot_under_test.h"
#include "support/machine_watch.h"

namespace nord_driver::test {
namespace {

constexpr double kSpeed = 0.4, kDeceleration = 0.8;  // m/s, m/s^2: robot.yaml
constexpr Seconds kShutdownTimeout{10.0};            // the default
constexpr double kLate = 0.04;                       // s: two periods of the truth
constexpr int kRosnodeKill = 0;                      // in place of a signal
/// Messages of the truth, one each 20 ms that the simulator lived, until a drive is told of the end. For a signal the
/// node looks every half cycle, then come two cycles. What rosnode asks is looked at by roscpp every 100 ms only.
constexpr int kHeardSignal = 3, kHeardShutdown = 9;

/// What the truth about a drive says of a ramp.
struct RampSeen {
  ros::Time begin;       ///< of the first message with a setpoint below the one before the end was asked for
  double held_up = 0.0;  ///< s in which the simulator stood still
};

RampSeen rampIn(const std::vector<Topic<SimDrive>::Pointer>& truths) {
  RampSeen ramp;
  const int full = std::abs(int{truths.front()->setpoint_1});
  for (std::size_t i = 1; i < truths.size() && truths[i]->operation_enabled; ++i) {
    if (std::abs(int{truths[i]->setpoint_1}) >= full) continue;
    if (ramp.begin.isZero()) ramp.begin = truths[i]->header.stamp;
    const double step = (truths[i]->header.stamp - truths[i - 1]->header.stamp).toSec();
    if (step > kLate) ramp.held_up += step;
  }
  return ramp;
}

/// Around `begin`: x of the last message before it and of the first one from it on.
std::pair<double, double> placesAround(ros::Time begin, const std::vector<Topic<nav_msgs::Odometry>::Pointer>& odom) {
  std::size_t i = 1;
  while (i + 1 < odom.size() && odom[i]->header.stamp < begin) ++i;
  return {odom[i - 1]->pose.pose.position.x, odom[i]->pose.pose.position.x};
}

/// The last words there were between a drive and a driver that has ended.
struct LastWords {
  std::uint16_t control = 0, status = 0;
  std::uint64_t zeros = 0;  ///< control words without bit 10
};

LastWords lastWords(DriveTopics& drive, std::size_t from, std::uint64_t trips_before) {
  // The watchdog keeps what was said last. Who is let go does not miss anybody. A ring that goes on says zeros in the
  // end.
  const auto left_alone = [&](const SimDrive& truth) {
    if (bus().goes_on) return truth.control_word == 0;
    return bus().lets_go ? !truth.in_data_exchange : truth.watchdog_trips == trips_before + 1;
  };
  const auto last = drive.truth.waitFrom(from, left_alone);
  EXPECT_TRUE(last);
  if (!last) return {};
  if (bus().goes_on) {
    const auto truths = drive.truth.since(from);
    for (std::size_t i = 1; i < truths.size(); ++i) {
      const SimDrive &before = *truths[i - 1], &here = *truths[i];
      if (here.control_word == 0) return {before.control_word, before.status_word, here.zero_control_words};
    }
    return {};
  }
  if (!bus().lets_go) return {last->last_control_word_before_loss, last->status_word_at_loss, last->zero_control_words};
  EXPECT_EQ(last->fault_number, 0);
  return {last->control_word, last->status_word, last->zero_control_words};
}

class CleanExit : public RobotTest, public ::testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    // The watchdog that expired after the last clean exit has left E10.2.
    ASSERT_NO_FATAL_FAILURE(switchDrivesOffAndOn());
    robot().drive(0.0);
    ASSERT_NO_FATAL_FAILURE(startDriver());
  }
  void askToEnd() {
    if (GetParam() != kRosnodeKill) return driver_->signal(GetParam());
    XmlRpc::XmlRpcValue arguments, result, uri;
    arguments[0] = ros::this_node::getName();
    arguments[1] = "/nord_driver";
    ASSERT_TRUE(ros::master::execute("lookupNode", arguments, result, uri, false));
    std::string host;
    std::uint32_t port = 0;
    ASSERT_TRUE(ros::network::splitURI(uri, host, port));
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
    arguments[1] = "a test";
    EXPECT_TRUE(client.execute("shutdown", arguments, result));
  }
};

TEST_P(CleanExit, RampsDownAndLeavesDrivesReadyToSwitchOn) {
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(kSpeed));
  const std::uint64_t trips_before = robot().left.truth.next()->watchdog_trips;
  // From the message that is there, with the whole speed, on.
  ASSERT_TRUE(robot().right.truth.next() && robot().true_odom.next());
  const std::size_t left_from = robot().left.truth.mark() - 1;
  const std::size_t right_from = robot().right.truth.mark() - 1;
  const std::size_t odom_from = robot().true_odom.mark() - 1;
  const MachineWatch watch;
  const ros::Time asked = ros::Time::now();
  ASSERT_NO_FATAL_FAILURE(askToEnd());
  const auto end = driver_->waitEnd(kShutdownTimeout);
  ASSERT_TRUE(end) << "still runs after shutdown_timeout";
  EXPECT_EQ(end->exit_code, 0) << driver_->errorText();

  RampSeen ramp;
  for (const auto& [drive, from] :
       {std::make_pair(&robot().left, left_from), std::make_pair(&robot().right, right_from)}) {
    const LastWords last = lastWords(*drive, from, trips_before);
    EXPECT_EQ(last.zeros, 0u) << "bit 10 was set to the last telegram";
    EXPECT_EQ(last.control, 0x047E);
    EXPECT_TRUE(isReadyToSwitchOn(last.status)) << std::hex << last.status;

    std::set<int> steps;
    int before = 1 << 15;
    for (const auto& truth : drive->truth.since(from)) {
      const int setpoint = std::abs(int{truth->setpoint_1});
      EXPECT_LE(setpoint, before) << "the command still stands, but nobody listens";
      before = setpoint;
      steps.insert(setpoint);
      if (!truth->operation_enabled) break;
    }
    EXPECT_EQ(before, 0);
    EXPECT_GE(steps.size(), 5u) << "a step, no ramp";
    const RampSeen seen = rampIn(drive->truth.since(from));
    ASSERT_FALSE(seen.begin.isZero());
    int unheard = 0;
    for (const auto& truth : drive->truth.since(from)) {
      unheard += truth->header.stamp >= asked && truth->header.stamp < seen.begin ? 1 : 0;
    }
    EXPECT_LE(unheard, GetParam() == kRosnodeKill ? kHeardShutdown : kHeardSignal);
    if (ramp.begin.isZero() || seen.begin < ramp.begin) ramp.begin = seen.begin;
    ramp.held_up = std::max(ramp.held_up, seen.held_up);
  }
  ramp.held_up += watch.longest().length.count();
  // v^2 / 2a along the deceleration limit, from the first smaller setpoint on: how long the signal took to be heard
  // does not count. While the driver is held up by the machine the wheels go on, while the simulator is the body stands
  // still: measured, not taken from what the driver said or did not say.
  const auto odom = robot().true_odom.since(odom_from);
  ASSERT_GE(odom.size(), 2u);
  const auto [before, begun] = placesAround(ramp.begin, odom);
  const double end_x = robot().true_odom.next()->pose.pose.position.x;
  const double way = kSpeed * kSpeed / (2.0 * kDeceleration);
  EXPECT_GT(end_x - before, 0.9 * way - kSpeed * ramp.held_up);
  EXPECT_LT(end_x - begun, 1.5 * way + kSpeed * ramp.held_up) << ramp.held_up << " s held up";
}

std::string signalName(const ::testing::TestParamInfo<int>& info) {
  if (info.param == kRosnodeKill) return "ByRosnodeKill";
  return info.param == SIGINT ? "BySigint" : "BySigterm";
}

INSTANTIATE_TEST_SUITE_P(Ended, CleanExit, ::testing::Values(SIGINT, SIGTERM, kRosnodeKill), signalName);

}  // namespace
}  // namespace nord_driver::test
