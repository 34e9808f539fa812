// What the node reads for itself: defaults, refusals, and that no key of the documentation is unknown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "node/node_config.h"
#include "node/parameters.h"
#include "node/ros_settings.h"
#include "node/what_is_offered.h"
#include "node/wheel_state_publisher.h"

namespace nord_driver::node {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using XmlRpc::XmlRpcValue;

std::string refusal(const XmlRpcValue& value) {
  try {
    readNodeConfig(RosSettings{"~", value});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NodeConfigTest, HasItsDefaults) {
  const NodeConfig config = readNodeConfig(RosSettings{"~", robotParameters()});
  EXPECT_EQ("nord_driver/profibus_dp", config.transport);
  EXPECT_FALSE(config.auto_enable);
  EXPECT_DOUBLE_EQ(50.0, config.publish.publish_rate);
  EXPECT_DOUBLE_EQ(50.0, config.publish.status_rate);
  EXPECT_EQ("base_link", config.publish.base_frame_id);
  EXPECT_EQ("odom", config.publish.odom_frame_id);
  EXPECT_TRUE(config.publish.enable_odom_tf);
  EXPECT_FALSE(config.publish.publish_cmd);
  ASSERT_EQ(2u, config.drives.size());
  EXPECT_EQ("left", config.drives[0].name);
  EXPECT_EQ("right", config.drives[1].name);
  EXPECT_EQ("/dev/ttyUSB0", config.bus->text("device").value());
  EXPECT_TRUE(config.cycle.base.has_value());
}

// One file, or several in their order.
TEST(NodeConfigTest, TakesFilesOfTheUser) {
  XmlRpcValue value = robotParameters();
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).parameter_files, IsEmpty());
  value["parameter_files"] = std::string{"/home/me/own.yaml"};
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).parameter_files, ElementsAre("/home/me/own.yaml"));
  XmlRpcValue list;
  list[0] = std::string{"/a.yaml"};
  list[1] = std::string{"/b.yaml"};
  value["parameter_files"] = list;
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).parameter_files, ElementsAre("/a.yaml", "/b.yaml"));
  value["parameter_files"] = 5;
  EXPECT_THAT(refusal(value), HasSubstr("~parameter_files"));
}

// Numbers need no quotation marks.
TEST(NodeConfigTest, TakesWhatIsToBeMonitored) {
  XmlRpcValue value = robotParameters();
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).monitor, ElementsAre(IsEmpty(), IsEmpty()));
  value["drives"]["right"]["monitor"][0] = std::string{"P746"};
  value["drives"]["right"]["monitor"][1] = 728;
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).monitor, ElementsAre(IsEmpty(), ElementsAre("P746", "728")));
  value["drives"]["right"]["monitor"] = 746;
  EXPECT_THAT(readNodeConfig(RosSettings{"~", value}).monitor[1], ElementsAre("746"));
  value["drives"]["right"]["monitor"] = 7.5;
  EXPECT_EQ("~drives/right/monitor: 7.5 is not valid, expected a text or a list of texts", refusal(value));
  value["drives"]["right"]["monitor"] = listOf<double>({7.5});
  EXPECT_EQ("~drives/right/monitor: 7.5 is not valid, expected a list of texts", refusal(value));
}

// A plugin's name without its prefix is one of this package's.
TEST(NodeConfigTest, ATransportMayLeaveItsPrefixOut) {
  XmlRpcValue value = robotParameters();
  value["transport"] = std::string{"profibus_dp"};
  EXPECT_EQ("nord_driver/profibus_dp", readNodeConfig(RosSettings{"~", value}).transport);
  value["transport"] = std::string{"my_package/my_card"};
  EXPECT_EQ("my_package/my_card", readNodeConfig(RosSettings{"~", value}).transport);
}

// One parameter for every bus: the transport says which key of `bus` it stands for.
TEST(NodeConfigTest, TheEndPointReplacesTheKeyOfTheTransport) {
  const EndPoint device{"device", "serial device", "/dev/ttyUSB0"};
  const EndPoint gateway{"gateway", "Modbus/TCP server", "192.168.0.10:502"};
  XmlRpcValue value = robotParameters();
  NodeConfig config = readNodeConfig(RosSettings{"~", value});
  EXPECT_EQ("/dev/ttyUSB0", applyEndPoint(config, device));
  EXPECT_EQ("", applyEndPoint(config, gateway)) << "nothing says where";
  EXPECT_EQ("", applyEndPoint(config, {}));
  value["bus_end_point"] = std::string{"here"};
  const RosSettings settings{"~", value};
  config = readNodeConfig(settings);
  EXPECT_THAT(settings.unknownKeys(), IsEmpty());
  EXPECT_EQ("here", applyEndPoint(config, device));
  EXPECT_EQ("here", config.bus->text("device").value());
  EXPECT_EQ("~bus/device", config.bus->fullName("device"));
  EXPECT_EQ("here", applyEndPoint(config, gateway));
  try {
    applyEndPoint(config, {});
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        "~bus_end_point: \"here\" is not valid, expected none: the transport nord_driver/profibus_dp opens nothing",
        error.what());
  }
}

// Else the images would go to a simulator, and writes of parameters to the machine that the file names.
TEST(NodeConfigTest, TheEndPointReplacesASecondWayToTheBusThatThereIs) {
  const EndPoint two{"device", "Modbus/TCP server", "192.168.0.10:502", "diagnosis"};
  XmlRpcValue value = robotParameters();
  value["bus_end_point"] = std::string{"here"};
  NodeConfig config = readNodeConfig(RosSettings{"~", value});
  applyEndPoint(config, two);
  EXPECT_EQ(std::nullopt, config.bus->text("diagnosis"));
  value["bus"]["diagnosis"] = std::string{"there"};
  config = readNodeConfig(RosSettings{"~", value});
  EXPECT_EQ("here", applyEndPoint(config, two));
  EXPECT_EQ("here", config.bus->text("diagnosis"));
  for (const char* none_else : {"", "/dev/ttyUSB0"}) {  // none, and the one of the file
    value["bus"]["device"] = std::string{"/dev/ttyUSB0"};
    value["bus_end_point"] = std::string{none_else};
    config = readNodeConfig(RosSettings{"~", value});
    EXPECT_EQ("/dev/ttyUSB0", applyEndPoint(config, two));
    EXPECT_EQ("there", config.bus->text("diagnosis"));
  }
}

TEST(NodeConfigTest, TheEndPointNeedsNoGroupOfTheBus) {
  XmlRpcValue value = robotParameters();
  value["bus"] = XmlRpcValue{};
  value["bus_end_point"] = std::string{"here"};
  NodeConfig config = readNodeConfig(RosSettings{"~", value});
  EXPECT_EQ("here", applyEndPoint(config, {"device", "serial device", "/dev/ttyUSB0"}));
  EXPECT_EQ("here", config.bus->text("device").value());
}

TEST(NodeConfigTest, TakesWhatIsGiven) {
  XmlRpcValue value = robotParameters();
  value["auto_enable"] = true;
  value["publish_rate"] = 20;
  value["base_frame_id"] = std::string{"base_footprint"};
  value["enable_odom_tf"] = false;
  value["pose_covariance_diagonal"] = listOf<double>({1, 2, 3, 4, 5, 6});
  const NodeConfig config = readNodeConfig(RosSettings{"~", value});
  EXPECT_TRUE(config.auto_enable);
  EXPECT_DOUBLE_EQ(20.0, config.publish.publish_rate);
  EXPECT_EQ("base_footprint", config.publish.base_frame_id);
  EXPECT_FALSE(config.publish.enable_odom_tf);
  EXPECT_DOUBLE_EQ(6.0, config.publish.pose_covariance_diagonal[5]);
}

// Files written for diff_drive_controller are accepted as they are, its `type` included.
TEST(NodeConfigTest, KnowsTheKeysOfDiffDriveController) {
  XmlRpcValue value = robotParameters();
  value["type"] = std::string{"diff_drive_controller/DiffDriveController"};
  for (const char* axis : {"linear", "angular"}) {
    XmlRpcValue& limits = value[axis][axis == std::string{"linear"} ? "x" : "z"];
    limits["has_velocity_limits"] = limits["has_acceleration_limits"] = limits["has_jerk_limits"] = true;
    limits["max_velocity"] = limits["max_acceleration"] = limits["max_jerk"] = 1.0;
    limits["min_velocity"] = limits["min_acceleration"] = limits["min_jerk"] = -1.0;
  }
  for (const char* key : {"wheel_separation_multiplier", "wheel_radius_multiplier", "left_wheel_radius_multiplier",
                          "right_wheel_radius_multiplier", "cmd_vel_timeout", "publish_rate"}) {
    value[key] = 1.0;
  }
  for (const char* key : {"enable_odom_tf", "open_loop", "publish_cmd", "allow_multiple_cmd_vel_publishers",
                          "estimate_velocity_from_position", "publish_wheel_joint_controller_state"}) {
    value[key] = true;
  }
  value["velocity_rolling_window_size"] = 10;
  value["base_frame_id"] = std::string{"frame"};
  value["odom_frame_id"] = std::string{"other_frame"};
  value["pose_covariance_diagonal"] = value["twist_covariance_diagonal"] = listOf<double>({1, 2, 3, 4, 5, 6});
  const RosSettings settings{"~", value};
  const NodeConfig config = withWhatIsOffered(readNodeConfig(settings), settings);
  EXPECT_THAT(settings.unknownKeys(), IsEmpty());
  EXPECT_EQ(WheelStatePublisher::isOffered(), config.publish.publish_wheel_states);
  if (WheelStatePublisher::isOffered()) {
    EXPECT_THAT(config.warnings, IsEmpty());
  } else {
    EXPECT_THAT(config.warnings, ElementsAre(AllOf(HasSubstr("~publish_wheel_joint_controller_state is not offered"),
                                                   HasSubstr("no control_msgs"))));
  }
}

// What the base's reader has to say of the robot description goes the way of all warnings.
TEST(NodeConfigTest, WarnsOfWhatTheRobotDescriptionDoesNotTell) {
  const NodeConfig config =
      readNodeConfig(RosSettings{"~", robotParameters()}, "<robot name=\"arm\"><link name=\"base_link\"/></robot>");
  EXPECT_THAT(config.warnings, ElementsAre(HasSubstr("robot_description: there is no joint"),
                                           HasSubstr("robot_description: there is no joint")));
}

// The search for a robot description begins with the node's own parameters; a file of the configuration is not searched.
TEST(NodeConfigTest, KnowsARobotDescriptionOfTheNodeItself) {
  XmlRpcValue value = robotParameters();
  value["robot_description"] = std::string{"<robot name=\"arm\"/>"};
  const RosSettings of_file{"~", value}, of_node{"~", value};
  const NodeConfig config = readNodeConfig(of_file);
  EXPECT_THAT(unknownKeys(of_file, config), Contains(HasSubstr("~robot_description is not known and is ignored")));
  EXPECT_THAT(unknownKeys(of_node, readNodeConfig(of_node), "/nord_driver"),
              Not(Contains(HasSubstr("~robot_description"))));
}

// roslaunch kills a node 17 s after SIGINT (15 s to SIGTERM, 2 s more), and the drives coast. The end takes shutdown_timeout,
// and up to 3 s for a quick stop behind it.
TEST(NodeConfigTest, WarnsOfAnEndThatRoslaunchDoesNotWaitFor) {
  XmlRpcValue value = robotParameters();
  const auto warnings = [&value] { return readNodeConfig(RosSettings{"~", value}).warnings; };
  EXPECT_THAT(warnings(), IsEmpty()) << "10 s";
  value["shutdown_timeout"] = 12;
  EXPECT_THAT(warnings(), IsEmpty());
  value["shutdown_timeout"] = 12.5;
  EXPECT_THAT(
      warnings(),
      ElementsAre(
          "~shutdown_timeout: with 12.5 s the end of the node may take 15.5 s; roslaunch by default waits 15 s, then "
          "kills it, and the drives coast: start it with roslaunch --sigint-timeout=17"));
  value["shutdown_timeout"] = 600;
  EXPECT_THAT(warnings(), ElementsAre(AllOf(HasSubstr("with 600 s"), HasSubstr("--sigint-timeout=604"))));
  value["read_only"] = true;
  EXPECT_THAT(warnings(), IsEmpty()) << "it stops nothing";
}

// dynamic_reconfigure leaves what it is given on the parameter server, where a node that is started again finds it.
TEST(NodeConfigTest, TakesEveryRateThatDynamicReconfigureOffers) {
  for (const double rate : {0.0, 1e-200, 0.05, 2000.0}) {
    XmlRpcValue value = robotParameters();
    value["publish_rate"] = rate;
    EXPECT_DOUBLE_EQ(rate, readNodeConfig(RosSettings{"~", value}).publish.publish_rate);
  }
}

// diagnostic_updater takes any number: infinity ends the node, 0 publishes in each pass.
TEST(NodeConfigTest, TheDiagnosticPeriodIsCheckedAsAnyNumber) {
  XmlRpcValue value = robotParameters();
  const auto period = [&value] { return readNodeConfig(RosSettings{"~", value}).publish.diagnostic_period; };
  EXPECT_DOUBLE_EQ(1.0, period());
  value["diagnostic_period"] = 5;
  EXPECT_DOUBLE_EQ(5.0, period());
  for (const double wrong :
       {0.0, -1.0, 1e10, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    value["diagnostic_period"] = wrong;
    EXPECT_THAT(refusal(value), AllOf(HasSubstr("~diagnostic_period: "),
                                      HasSubstr(" is not valid, expected a number from 0.1 to 3600 s")));
  }
  value["diagnostic_period"] = std::string{"often"};
  EXPECT_THAT(refusal(value), HasSubstr("~diagnostic_period: \"often\" is not valid, expected a number"));
}

template <typename Value>
XmlRpcValue with(const std::string& key, const Value& wrong) {
  XmlRpcValue value = robotParameters();
  value[key] = wrong;
  return value;
}

TEST(NodeConfigTest, RefusalsNameKeyValueAndExpectation) {
  EXPECT_THAT(refusal(with("publish_rate", -1)), HasSubstr("~publish_rate: -1 is not valid, expected a number from 0"));
  EXPECT_THAT(refusal(with("status_rate", 1001)), HasSubstr("~status_rate: 1001 is not valid"));
  EXPECT_THAT(refusal(with("auto_enable", 1)), HasSubstr("~auto_enable: 1 is not valid, expected true or false"));
  EXPECT_THAT(refusal(with("pose_covariance_diagonal", listOf<double>({1, 2}))),
              AllOf(HasSubstr("~pose_covariance_diagonal: a list of 2 numbers"), HasSubstr("expected six numbers")));
  EXPECT_THAT(refusal(with("twist_covariance_diagonal", listOf<double>({1, 2, 3, 4, 5, -6}))),
              HasSubstr("~twist_covariance_diagonal: -6 is not valid"));
  EXPECT_THAT(refusal(with("drives", 3)), HasSubstr("~drives: 3 is not valid, expected a group of keys and values"));
  EXPECT_THAT(refusal(with("bus", std::string{"ttyUSB0"})), HasSubstr("~bus: \"ttyUSB0\" is not valid"));
  // Below it keys are asked for, never the group itself.
  EXPECT_THAT(refusal(with("stop", std::string{"coast"})),
              HasSubstr("~stop: \"coast\" is not valid, expected a group of keys and values"));
  EXPECT_THAT(refusal(with("linear", 5)), HasSubstr("~linear: 5 is not valid, expected a group of keys and values"));
  XmlRpcValue axis;
  axis["x"] = 5;
  EXPECT_THAT(refusal(with("linear", axis)), HasSubstr("~linear/x: 5 is not valid, expected a group of keys and"));
  EXPECT_THAT(refusal(with("base_frame_id", std::string{})), HasSubstr("~base_frame_id: \"\" is not valid"));
  EXPECT_THAT(refusal(with("odom_frame_id", std::string{})), HasSubstr("~odom_frame_id: \"\" is not valid"));
  EXPECT_THAT(refusal(with("odom_frame_id", std::string{"base_link"})),
              AllOf(HasSubstr("~odom_frame_id: \"base_link\" is not valid"), HasSubstr("another frame")));
  EXPECT_THAT(refusal(with("wheel_radius", -0.1)), HasSubstr("~wheel_radius: -0.1 is not valid"));
  EXPECT_THAT(refusal(XmlRpcValue{}), HasSubstr("~drives is missing"));
}

}  // namespace
}  // namespace nord_driver::node
