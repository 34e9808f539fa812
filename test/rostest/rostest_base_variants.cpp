// The same robot, configured in other ways: geometry from the URDF, frames, publishers, and a node that is started
// again. Each test starts the driver with the parameters it changes.
#include <gmock/gmock.h>
#include <signal.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A wheel at `xyz` of base_link with this shape.
std::string wheel(const std::string& joint, const std::string& xyz, const std::string& shape) {
  return "<link name=\"" + joint + "_link\"><collision><geometry><" + shape + "/></geometry></collision></link>" +
         "<joint name=\"" + joint + "\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"" + joint +
         "_link\"/><origin xyz=\"" + xyz + "\"/><axis xyz=\"0 1 0\"/></joint>";
}

std::string robotOf(const std::string& wheels) {
  return "<robot name=\"robot\"><link name=\"base_link\"/>" + wheels + "</robot>";
}

/// Both wheels alike, 0.8 m apart.
std::string twoWheels(const std::string& shape) {
  return robotOf(wheel("left_wheel_joint", "0 0.4 0.2", shape) + wheel("right_wheel_joint", "0 -0.4 0.2", shape));
}

const char* const kCylinder = "cylinder radius=\"0.2\" length=\"0.1\"";

class Variant : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(ros::param::get("/nord_driver", parameters_));
    // The watchdog that expired after the test before has left E10.2: mains off and on.
    for (const char* drive : {"left", "right"}) {
      ASSERT_TRUE(robot().simulator(std::string(drive) + "/unplug", true).success);
      ASSERT_TRUE(robot().simulator(std::string(drive) + "/unplug", false).success);
    }
  }
  void TearDown() override {
    RobotTest::TearDown();
    ros::param::del("/nord_driver");
    ros::param::set("/nord_driver", parameters_);
    ros::param::del("/robot_description");
  }
  template <typename Value>
  static void configure(const std::string& key, const Value& value) {
    ros::param::set("/nord_driver/" + key, value);
  }
  static void takeSizesFrom(const std::string& urdf) {
    ros::param::del("/nord_driver/wheel_separation");
    ros::param::del("/nord_driver/wheel_radius");
    ros::param::set("/robot_description", urdf);
  }
  void startAndEnable() {
    robot().drive(0.0);
    ASSERT_NO_FATAL_FAILURE(startDriver());
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
  }
  /// The wheels' speeds behind this command once it is reached.
  static bool waitForWheels(double left, double right) {
    const auto is = [](double wanted) {
      return [wanted](const DriveStatus& status) { return std::fabs(status.velocity_command - wanted) < 0.01; };
    };
    return robot().left.status.waitNext(is(left)) && robot().right.status.waitNext(is(right));
  }

  XmlRpc::XmlRpcValue parameters_;
};

class Shape : public Variant, public ::testing::WithParamInterface<const char*> {};

// 0.4 m/s on wheels of 0.2 m; 0.5 rad/s at 0.4 m from the middle.
TEST_P(Shape, GivesTheRadiusAndTheJointsTheSeparation) {
  takeSizesFrom(twoWheels(GetParam()));
  ASSERT_NO_FATAL_FAILURE(startAndEnable());
  robot().drive(0.4);
  EXPECT_TRUE(waitForWheels(2.0, 2.0));
  robot().drive(0.0, 0.5);
  EXPECT_TRUE(waitForWheels(-1.0, 1.0));
}

// Drawn with its wheels along x, as diff_drive_controller's own test robot: 0.8 m between the joints.
TEST_F(Variant, WheelsAlongXGiveTheSeparationTheirDistance) {
  takeSizesFrom(
      robotOf(wheel("left_wheel_joint", "0.4 0 0.2", kCylinder) + wheel("right_wheel_joint", "-0.4 0 0.2", kCylinder)));
  ASSERT_NO_FATAL_FAILURE(startAndEnable());
  robot().drive(0.0, 0.5);
  EXPECT_TRUE(waitForWheels(-1.0, 1.0));
}

INSTANTIATE_TEST_SUITE_P(OfAWheel, Shape, ::testing::Values(kCylinder, "sphere radius=\"0.2\""),
                         [](const auto& test) { return std::string(test.param).substr(0, 6); });

struct Refused {
  std::string name, urdf, said;
};

void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.name;
}

class RefusedUrdf : public Variant, public ::testing::WithParamInterface<Refused> {};

// Before anything is advertised, and with the joint's name.
TEST_P(RefusedUrdf, EndsTheNodeWithASentence) {
  takeSizesFrom(GetParam().urdf);
  const std::size_t odom_from = robot().odom.mark();
  NodeProcess driver(kDriverProgram, {"__name:=nord_driver"});
  const auto end = driver.waitEnd(Seconds{10.0});
  ASSERT_TRUE(end) << "still runs";
  EXPECT_EQ(end->exit_code, 1);
  EXPECT_THAT(driver.errorText(), AllOf(HasSubstr("robot_description"), HasSubstr(GetParam().said)));
  EXPECT_EQ(robot().odom.mark(), odom_from);
}

INSTANTIATE_TEST_SUITE_P(
    Because, RefusedUrdf,
    ::testing::Values(Refused{"ABoxHasNoRadius", twoWheels("box size=\"0.2 0.1 0.2\""), "left_wheel_joint"},
                      Refused{"TheWheelsStandInOnePlace",
                              robotOf(wheel("left_wheel_joint", "0.3 0 0.2", kCylinder) +
                                      wheel("right_wheel_joint", "0.3 0 0.2", kCylinder)),
                              "in one place"},
                      Refused{"AJointIsMissing", robotOf(wheel("left_wheel_joint", "0 0.4 0.2", kCylinder)),
                              "right_wheel_joint"}),
    [](const ::testing::TestParamInfo<Refused>& test) { return test.param.name; });

// A joint's own limit slows the whole base: 2 rad/s on the right wheel are 0.2 m/s, and the path stays an arc.
TEST_F(Variant, AJointsVelocityLimitSlowsTheWholeBase) {
  std::string urdf = twoWheels(kCylinder);
  const std::string joint = "<joint name=\"right_wheel_joint\" type=\"continuous\">";
  urdf.insert(urdf.find(joint) + joint.size(), "<limit effort=\"1\" velocity=\"2\"/>");
  ros::param::set("/robot_description", urdf);
  ASSERT_NO_FATAL_FAILURE(startAndEnable());
  robot().drive(0.3, 0.4);  // left 2 rad/s, right 4 rad/s
  EXPECT_TRUE(waitForWheels(1.0, 2.0));
}

// For robots whose EKF owns odom -> base_link; integers where numbers are expected.
TEST_F(Variant, FramesAndTfAreConfigured) {
  configure("enable_odom_tf", false);
  configure("odom_frame_id", std::string("wheel_odom"));
  configure("base_frame_id", std::string("base_footprint"));
  configure("publish_rate", 25);
  configure("cmd_vel_timeout", 1);
  robot().drive(0.0);
  ros::NodeHandle node;
  Topic<tf2_msgs::TFMessage> tf(node, "/tf");
  ASSERT_NO_FATAL_FAILURE(startDriver());
  const auto odom = robot().odom.next();
  ASSERT_TRUE(odom);
  EXPECT_EQ(odom->header.frame_id, "wheel_odom");
  EXPECT_EQ(odom->child_frame_id, "base_footprint");
  EXPECT_EQ(odom->pose.covariance[0], 0.001);
  EXPECT_EQ(odom->pose.covariance[35], 0.03);
  EXPECT_EQ(odom->twist.covariance[35], 0.03);
  const std::size_t from = robot().odom.mark();
  ASSERT_TRUE(eventually([&] { return robot().odom.mark() >= from + 25; }));
  EXPECT_EQ(tf.mark(), 0u);
}

// With allow_multiple_cmd_vel_publishers: false a second voice stops the base, and its silence lets it drive again.
TEST_F(Variant, ASecondPublisherOfCommandsStopsTheBase) {
  configure("allow_multiple_cmd_vel_publishers", false);
  ASSERT_NO_FATAL_FAILURE(startAndEnable());
  robot().drive(0.3);
  ASSERT_TRUE(waitForWheels(3.0, 3.0));
  {
    // Of another node: one node has one connection for a topic.
    NodeProcess other("/usr/bin/rostopic", {"pub", "-r", "20", "/cmd_vel", "geometry_msgs/Twist", "linear: {x: 0.3}"});
    EXPECT_TRUE(waitForWheels(0.0, 0.0));
    EXPECT_TRUE(robot().waitForStandstill());
    EXPECT_THAT(driver_->errorText(), HasSubstr("2 publishers on cmd_vel, expected one"));
    EXPECT_EQ(robot().left.status.next()->state, DriveStatus::OPERATION_ENABLED);
    other.signal(SIGINT);  // signs off: killed, it would still count as a publisher
    EXPECT_TRUE(other.waitEnd(kPatience));
  }
  EXPECT_TRUE(waitForWheels(3.0, 3.0));
}

// The pose of a new node begins at zero, the joints' positions too, and neither jumps afterwards.
TEST_F(Variant, ARestartBeginsAtZeroWithoutAJump) {
  ASSERT_NO_FATAL_FAILURE(startAndEnable());
  robot().drive(0.4);
  ASSERT_TRUE(robot().odom.waitNext([](const auto& odom) { return odom.pose.pose.position.x > 0.3; }));
  driver_->signal(SIGTERM);
  ASSERT_TRUE(driver_->waitEnd(kPatience));
  ASSERT_TRUE(robot().waitForStandstill());
  const std::size_t from = robot().odom.mark(), joints_from = robot().joint_states.mark();
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_TRUE(eventually([&] { return robot().odom.mark() >= from + 25; }));
  for (const auto& odom : robot().odom.since(from)) {
    EXPECT_NEAR(odom->pose.pose.position.x, 0.0, 1e-3);
    EXPECT_NEAR(odom->twist.twist.linear.x, 0.0, 1e-3);
  }
  for (const auto& joints : robot().joint_states.since(joints_from)) EXPECT_NEAR(joints->position.at(0), 0.0, 1e-2);
}

}  // namespace
}  // namespace nord_driver::test
