// Bases of four drives: skid steer configured by the files of two robots that had diff_drive_controller, and mecanum.
#include <gmock/gmock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <cmath>

#include "node/robot_under_test.h"

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
  void drive(double x, double y, double turn) {
    const std::lock_guard<std::mutex> lock(mutex_);
    command_.linear.x = x;
    command_.linear.y = y;
    command_.angular.z = turn;
  }
  bool waitForPose(const std::function<bool(double x, double y, double heading)>& good) {
    return odom_->waitNext([&](const nav_msgs::Odometry& odom) {
      const auto& pose = odom.pose.pose;
      return good(pose.position.x, pose.position.y, 2.0 * std::atan2(pose.orientation.z, pose.orientation.w));
    }) != nullptr;
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
  std::unique_ptr<Topic<nav_msgs::Odometry>> odom_;
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

  Topic<nav_msgs::Odometry> truth(node_, "/nord_sim/truth/odom");
  drive(0.4, 0.3, 0.5);  // sideways is beyond it
  ASSERT_TRUE(waitForPose([](double, double, double heading) { return heading > 0.8; }));
  drive(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForRest());
  const auto told = odom_->next()->pose.pose, is = truth.next()->pose.pose;
  EXPECT_GT(is.position.x, 0.3);
  EXPECT_NEAR(told.position.x, is.position.x, 0.03);
  EXPECT_NEAR(told.position.y, is.position.y, 0.03);
  EXPECT_NEAR(std::atan2(told.orientation.z, told.orientation.w), std::atan2(is.orientation.z, is.orientation.w), 0.03);
  const auto angles = wheelAngles();
  EXPECT_NEAR(angles[0], angles[1], 0.1) << "both wheels of a side";
  EXPECT_NEAR(angles[2], angles[3], 0.1);
  EXPECT_GT(angles[2], angles[0] + 1.0);
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

  drive(0.0, 0.3, 0.0);
  ASSERT_TRUE(waitForPose([](double, double y, double) { return y > 0.4; }));
  drive(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForRest());
  const auto left = wheelAngles();
  EXPECT_LT(left[0], -3.0) << "front left";
  EXPECT_GT(left[1], 3.0) << "rear left";
  EXPECT_GT(left[2], 3.0) << "front right";
  EXPECT_LT(left[3], -3.0) << "rear right";
  const auto after_left = odom_->next()->pose.pose;
  EXPECT_NEAR(after_left.position.x, 0.0, 0.02);
  EXPECT_NEAR(after_left.position.y, sizes.radius / 4.0 * (-left[0] + left[1] + left[2] - left[3]), 0.02);

  drive(0.3, 0.0, 0.0);
  ASSERT_TRUE(waitForPose([](double x, double, double) { return x > 0.4; }));
  drive(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForRest());
  const auto forward = wheelAngles();
  double way = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(forward[i] - left[i], 3.0);
    way += sizes.radius / 4.0 * (forward[i] - left[i]);
  }
  EXPECT_NEAR(odom_->next()->pose.pose.position.x, way, 0.02);

  drive(0.0, 0.0, 1.0);
  ASSERT_TRUE(waitForPose([](double, double, double heading) { return heading > 1.0; }));
  drive(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForRest());
  const auto turned = wheelAngles();
  const double lever = (sizes.separation + sizes.base) / 2.0;
  double angle = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    angle += sizes.radius / 4.0 / lever * (i < 2 ? -1.0 : 1.0) * (turned[i] - forward[i]);
  }
  const auto pose = odom_->next()->pose.pose;
  EXPECT_NEAR(2.0 * std::atan2(pose.orientation.z, pose.orientation.w), angle, 0.03);
}

}  // namespace
}  // namespace nord_driver::test
