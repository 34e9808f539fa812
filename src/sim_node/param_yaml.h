// ROS parameters as YAML, so that the simulator's one reader of configurations serves both programs.
#pragma once

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

namespace nord_driver::sim_node {

/// Everything in the namespace of `handle`; an empty map when nothing is set.
YAML::Node readParameters(const ros::NodeHandle& handle);

}  // namespace nord_driver::sim_node
