// nord_driver_node: reads the command line and the signals, runs the node until it is asked to end.
#include <ros/ros.h>
#include <ros/topic_manager.h>

#include <atomic>
#include <cstdio>

#include "core/node_arguments.h"
#include "node/driver_node.h"
#include "tools/end_signals.h"

namespace {

constexpr char kUsage[] =
    "Drives NORD frequency inverters over a field bus. A ROS node: its configuration is its private parameters.\n"
    "  roslaunch nord_driver nord_driver.launch config:=$PWD/my_robot.yaml\n"
    "  nord_driver_node [--help] [--version] [NAME:=VALUE ...]\n"
    "Exit code: 0 ended when asked to (the log names a drive that nobody saw at rest); 1 wrong configuration; 2 "
    "another error, or wrong usage.\n";

/// What is said before somebody reads /rosout is lost to it, and a wrong configuration is said at once. Without a
/// reader the node goes on.
void waitForALogReader(const std::atomic<bool>& end_asked) {
  for (int i = 0; i < 50 && !end_asked; ++i) {
    if (ros::TopicManager::instance()->getNumSubscribers(ros::names::resolve("/rosout")) > 0) return;
    ros::WallDuration(0.02).sleep();
  }
}

/// The log reaches /rosout on roscpp's own thread: give it the time to get there before the node is gone.
void letTheLogOut() {
  ros::WallDuration(0.5).sleep();
}

}  // namespace

int main(int argc, char** argv) {
  if (const auto answer = nord_driver::answerArguments(argc, argv, "nord_driver_node", kUsage)) {
    std::fputs(answer->output.c_str(), stdout);
    std::fputs(answer->error.c_str(), stderr);
    return answer->exit_code;
  }
  // roscpp's own handler would tear down the publishers before the drives have come to rest.
  ros::init(argc, argv, "nord_driver", ros::init_options::NoSigintHandler);
  const std::atomic<bool>& end_asked = nord_driver::tools::catchEndSignals();
  ros::Time::init();  // before the first NodeHandle, which needs the master, nobody else does it
  while (!ros::master::check()) {
    if (end_asked) return 0;
    ROS_WARN_THROTTLE(5.0, "nord_driver: no ROS master answers at %s, waiting for it", ros::master::getURI().c_str());
    ros::WallDuration(0.2).sleep();
  }
  ros::NodeHandle keep_alive;
  waitForALogReader(end_asked);
  try {
    nord_driver::node::DriverNode node;
    node.run(end_asked);
  } catch (const nord_driver::ConfigError& error) {
    ROS_FATAL("nord_driver: %s", error.what());
    letTheLogOut();
    return 1;
  } catch (const std::exception& error) {
    ROS_FATAL("nord_driver: %s", error.what());
    letTheLogOut();
    return 2;
  }
  return 0;
}
