// Bases of four drives: skid steer configured by the files of two robots that had diff_drive_controller, and mecanum.
#include <gmock/gmock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <cmath>

#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using XmlRpc::XmlRpcValue;

const std::array<std::string, 4> kWheels{"front_left", "rear_left", "front_right", "rear_right"};

/// What the robots' own URDF says of their wheels.
struct Sizes {
  double radius, separation, base;  ///< m
};

std::string urdf(const Sizes& sizes) {
  std::string text = "<robot name=\"robot\"><link name=\"base_link\"/>";
  for (const std::string& name : kWheels) {
    const double x = (name.substr(0, 5) == "front" ? 0.5 : -0.5) * sizes.base;
    const double y = (name.find("left") != std::string::npos ? 0.5 : -0.5) * sizes.separation;
    text += "<link name=\"" + name + "_link\"><collision><geometry><cylinder length=\"0.05\" radius=\"" +
            std::to_string(sizes.radius) + "\"/></geometry></collision></link><joint name=\"" + name +
            "_wheel\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"" + name +
            "_link\"/><origin xyz=\"" + std::to_string(x) + " " + std::to_string(y) +
            " 0\"/><axis xyz=\"0 1 0\"/></joint>";
  }
  return text + "</robot>";
}

/// m, m, rad
struct Pose {
  double x = 0.0, y = 0.0, heading = 0.0;
};

Pose poseOf(const nav_msgs::Odometry& odom) {
  const auto& pose = odom.pose.pose;
  return {pose.position.x, pose.position.y, 2.0 * std::atan2(pose.orientation.z, pose.orientation.w)};
}

/// `to` as seen from `from`.
Pose seenFrom(const Pose& from, const Pose& to) {
  const double x = to.x - from.x, y = to.y - from.y, c = std::cos(from.heading), s = std::sin(from.heading);
  return {c * x + s * y, c * y - s * x, std::remainder(to.heading - from.heading, 2.0 * M_PI)};
}

/// From rest to rest.
struct Leg {
  Pose told, is;                   ///< the end, seen from the beginning
  std::array<double, 4> turned{};  ///< rad, of the wheels
};

class FourWheels : public ::testing::Test {
 protected:
  /// Driver and simulator with the parameters of /four_wheels laid over those of /`node`. The simulated body turns as
  /// if its wheels stood `true_separation` apart.
  void start(const std::string& node, const Sizes& sizes, double true_separation) {
    name_ = node;
    XmlRpcValue drives, own;
    ASSERT_TRUE(ros::param::get("/four_wheels", drives));
    if (ros::param::get("/" + node, own)) {
      for (auto& member : drives) own[member.first] = member.second;
    } else {
      own = drives;
    }
    ros::param::set("/robot_description", urdf(sizes));
    ros::param::set("/" + node, own);
    drives["left_wheel"] = own["left_wheel"];
    drives["right_wheel"] = own["right_wheel"];
    drives["wheel_radius"] = sizes.radius;
    drives["wheel_separation"] = true_separation;
    ros::param::set("/nord_sim", drives);
    simulator_ = std::make_unique<NodeProcess>(kSimulatorProgram, std::vector<std::string>{"__name:=nord_sim"});
    const std::string inside = "/" + node + "/";
    driver_ = std::make_unique<NodeProcess>(
        kDriverProgram,
        std::vector<std::string>{"__name:=" + node, "cmd_vel:=" + inside + "cmd_vel", "odom:=" + inside + "odom"});
    odom_ = std::make_unique<Topic<nav_msgs::Odometry>>(node_, inside + "odom");
    truth_ = std::make_unique<Topic<nav_msgs::Odometry>>(node_, "/nord_sim/truth/odom");
    publisher_ = node_.advertise<geometry_msgs::Twist>(inside + "cmd_vel", 1);
    timer_ = node_.createSteadyTimer(ros::WallDuration(0.02), [this](const ros::SteadyTimerEvent&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      publisher_.publish(command_);
    });
    ASSERT_TRUE(odom_->next()) << driver_->errorText();
    std_srvs::SetBool enable;
    enable.request.data = true;
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = callService(inside + "enable", enable)).success; })) << answer;
  }
  void TearDown() override {
    timer_.stop();
    if (HasFailure() && driver_) std::fputs(driver_->errorText().c_str(), stderr);
    std_srvs::Trigger referee;
    const Answer judgement = callService("/nord_sim/referee", referee);
    EXPECT_TRUE(judgement.success) << judgement;
    driver_.reset();
    simulator_.reset();
    ros::param::del("/" + name_);
    ros::param::del("/nord_sim");
  }
  void drive(const geometry_msgs::Twist& command) {
    const std::lock_guard<std::mutex> lock(mutex_);
    command_ = command;
  }
  static geometry_msgs::Twist twist(double x, double y, double turn) {
    geometry_msgs::Twist command;
    command.linear.x = x;
    command.linear.y = y;
    command.angular.z = turn;
    return command;
  }
  /// Drives until the pose told is `far_enough` from where it began, and comes to rest. What a speed did between two
  /// samples is not seen: a hold-up can hide a way.
  void driveLeg(const geometry_msgs::Twist& command, const std::function<bool(const Pose&)>& far_enough,
                const std::function<bool(const Leg&)>& fits, Leg& leg) {
    constexpr Seconds kHidesWay{0.2};
    tryAgainOnlyIfStoodStill(
        kHidesWay, [&] { driveOnce(command, far_enough, leg); }, [&] { return fits(leg); });
  }
  void driveOnce(const geometry_msgs::Twist& command, const std::function<bool(const Pose&)>& far_enough, Leg& leg) {
    Pose told, is;
    ASSERT_NO_FATAL_FAILURE(restAt(told, is));
    const auto angles = wheelAngles();
    drive(command);
    ASSERT_TRUE(
        odom_->waitNext([&](const nav_msgs::Odometry& odom) { return far_enough(seenFrom(told, poseOf(odom))); }));
    drive({});
    Pose told_end, is_end;
    ASSERT_NO_FATAL_FAILURE(restAt(told_end, is_end));
    leg = {seenFrom(told, told_end), seenFrom(is, is_end), wheelAngles()};
    for (std::size_t i = 0; i < 4; ++i) leg.turned[i] -= angles[i];
  }
  void restAt(Pose& told, Pose& is) {
    ASSERT_TRUE(waitForRest());
    const auto odom = odom_->waitNext([](const nav_msgs::Odometry& seen) {
      const auto& twist = seen.twist.twist;
      return std::hypot(twist.linear.x, twist.linear.y) < 1e-3 && std::fabs(twist.angular.z) < 1e-2;
    });
    const auto truth = truth_->next();
    ASSERT_TRUE(odom && truth);
    told = poseOf(*odom);
    is = poseOf(*truth);
  }
  bool waitForRest() {
    const auto rest = [](const SimDrive& drive) { return std::fabs(drive.wheel_velocity) < 1e-3; };
    bool all = true;
    for (const std::string& wheel : kWheels) {
      Topic<SimDrive> truth(node_, "/nord_sim/truth/" + wheel);
      all = all && truth.waitNext(rest);
    }
    return all;
  }
  /// rad, since the simulator's start.
  std::array<double, 4> wheelAngles() {
    std::array<double, 4> angles{};
    for (std::size_t i = 0; i < 4; ++i) {
      Topic<SimDrive> truth(node_, "/nord_sim/truth/" + kWheels[i]);
      const auto now = truth.next();
      if (now) angles[i] = now->wheel_angle;
    }
    return angles;
  }

  ros::NodeHandle node_;
  std::string name_;
  std::unique_ptr<NodeProcess> simulator_, driver_;
  std::unique_ptr<Topic<nav_msgs::Odometry>> odom_, truth_;
  ros::Publisher publisher_;
  ros::SteadyTimer timer_;
  std::mutex mutex_;
  geometry_msgs::Twist command_;
};

struct Robot {
  std::string controller;
  Sizes sizes;
  double multiplier;  ///< of the separation, as in its file
  double pose_covariance_z;
};

void PrintTo(const Robot& robot, std::ostream* out) {
  *out << robot.controller;
}

class ControllerFile : public FourWheels, public ::testing::WithParamInterface<Robot> {};

// Started under the controller's name, with its file, the drives beside it and the robot's URDF: it drives an arc that
// ends where the simulated body is.
TEST_P(ControllerFile, DrivesTheRobotUnchanged) {
  const Robot& robot = GetParam();
  Topic<tf2_msgs::TFMessage> tf(node_, "/tf");
  ASSERT_NO_FATAL_FAILURE(start(robot.controller, robot.sizes, robot.multiplier * robot.sizes.separation));
  EXPECT_THAT(driver_->errorText(), Not(HasSubstr("is not known")));
  const auto odom = odom_->next();
  EXPECT_EQ(odom->child_frame_id, "base_link");
  EXPECT_EQ(odom->pose.covariance[14], robot.pose_covariance_z);
  EXPECT_EQ(odom->twist.covariance[35], 0.03);

  constexpr double kFits = 0.03;  // m, rad
  const auto fits = [](const Leg& seen) {
    return std::fabs(seen.told.x - seen.is.x) < kFits && std::fabs(seen.told.y - seen.is.y) < kFits &&
           std::fabs(seen.told.heading - seen.is.heading) < 2.0 * kFits;
  };
  Leg leg;
  const auto command = twist(0.4, 0.3, 0.5);  // sideways is beyond it
  ASSERT_NO_FATAL_FAILURE(driveLeg(
      command, [](const Pose& pose) { return pose.heading > 0.8; }, fits, leg));
  EXPECT_GT(leg.is.x, 0.3);
  EXPECT_NEAR(leg.told.x, leg.is.x, kFits);
  EXPECT_NEAR(leg.told.y, leg.is.y, kFits);
  EXPECT_NEAR(leg.told.heading, leg.is.heading, 2.0 * kFits);
  EXPECT_NEAR(leg.turned[0], leg.turned[1], 0.1) << "both wheels of a side";
  EXPECT_NEAR(leg.turned[2], leg.turned[3], 0.1);
  EXPECT_GT(leg.turned[2], leg.turned[0] + 1.0);
  EXPECT_EQ(tf.mark(), 0u) << "enable_odom_tf is false";
}

// Radius, separation and wheel base of the robots' descriptions.
INSTANTIATE_TEST_SUITE_P(Of, ControllerFile,
                         ::testing::Values(Robot{"jackal_velocity_controller", {0.098, 0.37559, 0.262}, 1.5, 1e6},
                                           Robot{"husky_velocity_controller", {0.1651, 0.5708, 0.512}, 1.875, 0.001}),
                         [](const ::testing::TestParamInfo<Robot>& test) { return test.param.controller; });

// Forward, to the left and around: the wheels as the rollers want them, and the pose they make by the textbook's sums.
TEST_F(FourWheels, MecanumGoesWhereItIsTold) {
  const Sizes sizes{0.1, 0.5, 0.4};
  XmlRpcValue own;
  own["base_type"] = std::string("mecanum");
  for (int i = 0; i < 2; ++i) {
    own["left_wheel"][i] = kWheels[static_cast<std::size_t>(i)] + "_wheel";
    own["right_wheel"][i] = kWheels[static_cast<std::size_t>(i + 2)] + "_wheel";
  }
  ros::param::set("/mecanum", own);
  ASSERT_NO_FATAL_FAILURE(start("mecanum", sizes, sizes.separation));

  // The wheels' angles (front left, rear left, front right, rear right) in the direction the motion gives each.
  const auto sum = [](const Leg& leg, const std::array<double, 4>& signs) {
    double angles = 0.0;
    for (std::size_t i = 0; i < 4; ++i) angles += signs[i] * leg.turned[i];
    return angles;
  };
  Leg leg;
  const auto sideways = [&](const Leg& seen) { return sizes.radius / 4.0 * sum(seen, {-1, 1, 1, -1}); };
  ASSERT_NO_FATAL_FAILURE(driveLeg(
      twist(0.0, 0.3, 0.0), [](const Pose& pose) { return pose.y > 0.4; },
      [&](const Leg& seen) { return std::fabs(seen.told.y - sideways(seen)) < 0.02; }, leg));
  EXPECT_LT(leg.turned[0], -3.0) << "front left";
  EXPECT_GT(leg.turned[1], 3.0) << "rear left";
  EXPECT_GT(leg.turned[2], 3.0) << "front right";
  EXPECT_LT(leg.turned[3], -3.0) << "rear right";
  EXPECT_NEAR(leg.told.x, 0.0, 0.02);
  EXPECT_NEAR(leg.told.y, sideways(leg), 0.02);

  const auto forward = [&](const Leg& seen) { return sizes.radius / 4.0 * sum(seen, {1, 1, 1, 1}); };
  ASSERT_NO_FATAL_FAILURE(driveLeg(
      twist(0.3, 0.0, 0.0), [](const Pose& pose) { return pose.x > 0.4; },
      [&](const Leg& seen) { return std::fabs(seen.told.x - forward(seen)) < 0.02; }, leg));
  for (const double angle : leg.turned) EXPECT_GT(angle, 3.0);
  EXPECT_NEAR(leg.told.x, forward(leg), 0.02);

  const double lever = (sizes.separation + sizes.base) / 2.0;
  const auto turned = [&](const Leg& seen) { return sizes.radius / 4.0 / lever * sum(seen, {-1, -1, 1, 1}); };
  ASSERT_NO_FATAL_FAILURE(driveLeg(
      twist(0.0, 0.0, 1.0), [](const Pose& pose) { return pose.heading > 1.0; },
      [&](const Leg& seen) { return std::fabs(seen.told.heading - turned(seen)) < 0.03; }, leg));
  EXPECT_NEAR(leg.told.heading, turned(leg), 0.03);
}

}  // namespace
}  // namespace nord_driver::test
