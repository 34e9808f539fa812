// nord_driver_node: reads the command line and the signals, runs the node until it is asked to end.
#include <ros/ros.h>
#include <ros/topic_manager.h>

#include <atomic>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "core/node_arguments.h"
#include "core/version.h"
#include "node/driver_node.h"
#include "nord_driver/profile/series.h"
#include "tools/end_signals.h"

namespace {

/// What a configuration may say in words; the transports as nord_driver_plugins.xml declares them.
std::vector<nord_driver::ProgramWords> parameterWords() {
  nord_driver::ProgramWords transports{"_transport", {}}, series{"_drives/*/series", {}};
  std::istringstream names{NORD_DRIVER_TRANSPORTS};
  for (std::string name; names >> name;) transports.words.push_back(name);
  for (const nord_driver::profile::Series known : nord_driver::profile::kAllSeries) {
    series.words.emplace_back(nord_driver::profile::toString(known));
  }
  return {transports, series};
}

nord_driver::ProgramText programText() {
  nord_driver::ProgramText text;
  text.name = "nord_driver_node";
  text.version = nord_driver::kVersion;
  text.brief = "ROS node that drives NORD frequency inverters over a field bus";
  text.about =
      "Drives NORD frequency inverters over a field bus. A ROS node: its configuration is its private parameters.";
  text.examples = {"roslaunch nord_driver nord_driver.launch config:=$PWD/my_robot.yaml"};
  text.options = nord_driver::commonOptions();
  text.footer =
      "Exit code: 0 ended when asked to (the log names a drive that nobody saw at rest); 1 wrong configuration; 2 "
      "another "
      "error, or wrong usage.";
  text.takes_ros_arguments = true;
  text.words = parameterWords();
  return text;
}

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
  if (const auto answer = nord_driver::answerArguments(argc, argv, programText())) {
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
