// nord_sim_node: simulated NORD drives on a pseudo-terminal or a CAN bus, with the truth as topics and faults as
// services.

#include <ros/ros.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "core/node_arguments.h"
#include "sim/running_bus.h"
#include "sim_node/param_yaml.h"
#include "sim_node/sim_node.h"

namespace {

constexpr char kUsage[] =
    "Simulated NORD inverters on a pseudo-terminal or a CAN bus, with the truth as topics and faults as services. A "
    "ROS\n"
    "node: its configuration is its private parameters. nord_sim is the same without ROS.\n"
    "  rosparam load config/demo.yaml /nord_sim && rosrun nord_driver nord_sim_node __name:=nord_sim\n"
    "  nord_sim_node [--help] [--version] [NAME:=VALUE ...]\n"
    "Exit code: 0 ended when asked to; 1 wrong configuration or another error; 2 wrong usage.\n";

}  // namespace

int main(int argc, char** argv) {
  if (const auto answer = nord_driver::answerArguments(argc, argv, "nord_sim_node", kUsage)) {
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
