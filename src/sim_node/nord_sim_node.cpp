// nord_sim_node: simulated NORD drives on a pseudo-terminal or a CAN bus, with the truth as topics and faults as
// services.

#include <ros/ros.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "nord_driver/sim/running_bus.h"
#include "param_yaml.h"
#include "sim_node.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--version") {  // without a ROS master
    std::printf("nord_sim_node %s\n", NORD_DRIVER_VERSION);
    return EXIT_SUCCESS;
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
