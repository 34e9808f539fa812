// nord_sim_node: simulated NORD drives on a pseudo-terminal or a CAN bus, with the truth as topics and faults as
// services.

#include <ros/ros.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "core/node_arguments.h"
#include "core/version.h"
#include "sim/bus_kind.h"
#include "sim/running_bus.h"
#include "sim_node/param_yaml.h"
#include "sim_node/sim_node.h"

namespace {

nord_driver::ProgramText programText() {
  nord_driver::ProgramWords transports{"_transport", {}};
  for (const nord_driver::sim::BusKind& kind : nord_driver::sim::busKinds()) {
    transports.words.emplace_back(kind.transport);
  }
  nord_driver::ProgramText text;
  text.name = "nord_sim_node";
  text.version = nord_driver::kVersion;
  text.brief = "ROS node that simulates NORD inverters on their buses";
  text.about =
      "Simulated NORD inverters on a pseudo-terminal, a CAN bus or behind a gateway, with the truth as topics and "
      "faults as "
      "services. A ROS node: its configuration is its private parameters. nord_sim is the same without ROS.";
  text.examples = {"rosparam load config/demo.yaml /nord_sim && rosrun nord_driver nord_sim_node __name:=nord_sim"};
  text.options = nord_driver::commonOptions();
  text.footer = "Exit code: 0 ended when asked to; 1 wrong configuration or another error; 2 wrong usage.";
  text.takes_ros_arguments = true;
  text.words = {transports};
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (const auto answer = nord_driver::answerArguments(argc, argv, programText())) {
    std::fputs(answer->output.c_str(), stdout);
    std::fputs(answer->error.c_str(), stderr);
    return answer->exit_code;
  }
  ros::init(argc, argv, "nord_sim");
  ros::NodeHandle handle("~");  // lives until the last word is logged
  try {
    const nord_driver::sim::SimConfig config =
        nord_driver::sim::readSimConfig(nord_driver::sim_node::readParameters(handle));
    for (const std::string& warning : config.warnings) ROS_WARN("%s", warning.c_str());
    const std::unique_ptr<nord_driver::sim::RunningBus> bus = nord_driver::sim::runBus(config);
    nord_driver::sim_node::SimNode node(handle, *bus);
    ROS_INFO("simulated bus with %zu drives at %s", config.drives.size(), bus->where().c_str());
    ros::spin();
    std::printf("referee: %s\n", bus->refereeReport().c_str());
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());  // on stderr and, when a master is there, on rosout
    return EXIT_FAILURE;
  }
}
