// The topic wheel_joint_controller_state, built with control_msgs or, where there is none, with its interface.
#include <control_msgs/JointTrajectoryControllerState.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/base_publisher.h"
#include "node/parameters.h"
#include "node/ros_settings.h"
#include "node/wheel_state_publisher.h"
#include "rostest/topic.h"

namespace nord_driver::node {
namespace {

using State = control_msgs::JointTrajectoryControllerState;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

NodeConfig configWith(bool publish_states) {
  XmlRpc::XmlRpcValue value = robotParameters();
  value["publish_wheel_joint_controller_state"] = publish_states;
  return readNodeConfig(RosSettings{"~", value});
}

// Subscribers of diff_drive_controller refuse a message of another definition.
TEST(WheelStates, TheMessageIsTheOneSubscribersKnow) {
  EXPECT_STREQ("control_msgs/JointTrajectoryControllerState", ros::message_traits::datatype<State>());
  EXPECT_STREQ("10817c60c2486ef6b33e97dcd87f4474", ros::message_traits::md5sum<State>());
}

TEST(WheelStates, ArePublishedWithTheBase) {
  const NodeConfig config = configWith(true);
  EXPECT_THAT(config.warnings, IsEmpty());
  ros::NodeHandle node;
  test::Topic<State> topic(node, "wheel_joint_controller_state");
  BasePublisher base(node, config);
  cycle::CycleSnapshot snapshot{2};
  test::Topic<State>::Pointer state;
  // The first ones leave before the subscriber is connected.
  for (int i = 0; i < 200 && !state; ++i) {
    snapshot.time = Instant{} + std::chrono::hours{1} + i * std::chrono::milliseconds{100};
    snapshot.drives[0].velocity = 0.2 * i;
    snapshot.drives[0].velocity_command = 3.0;
    snapshot.drives[1].velocity_command = -3.0;
    base.publish(snapshot, ros::Time{100.0 + 0.1 * i});
    state = topic.waitFrom(
        0, [](const State& now) { return now.actual.accelerations.at(0) > 0.0; }, test::Seconds{0.1});
  }
  ASSERT_TRUE(state);
  EXPECT_GE(state->header.stamp.toSec(), 100.0);
  EXPECT_THAT(state->joint_names, ElementsAre("left_wheel_joint", "right_wheel_joint"));
  EXPECT_THAT(state->desired.velocities, ElementsAre(3.0, -3.0));
  EXPECT_THAT(state->actual.accelerations, ElementsAre(DoubleNear(2.0, 1e-9), 0.0));
  EXPECT_THAT(state->error.velocities, SizeIs(2));
  EXPECT_THAT(state->error.effort, SizeIs(2));
}

TEST(WheelStates, AreNotAdvertisedUnasked) {
  ros::NodeHandle node("unasked");
  BasePublisher base(node, configWith(false));
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  bool joints = false;
  for (const ros::master::TopicInfo& topic : topics) {
    EXPECT_NE("/unasked/wheel_joint_controller_state", topic.name);
    joints = joints || topic.name == "/unasked/joint_states";
  }
  EXPECT_TRUE(joints);
}

}  // namespace
}  // namespace nord_driver::node
