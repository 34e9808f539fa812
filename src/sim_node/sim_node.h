// The simulator in ROS: the truth as topics, the faults as services.
#pragma once

#include <nord_driver/SimAnswerDelay.h>
#include <nord_driver/SimDrive.h>
#include <nord_driver/SimSetParameter.h>
#include <nord_driver/SimTrip.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "nord_driver/sim/pty_bus.h"

namespace nord_driver::sim_node {

/// Publishes ~truth/odom and ~truth/<drive> at 50 Hz; services ~referee and, per drive, ~<drive>/unplug,
/// power_inverter, mute, local_control, trip, clear_cause, set_parameter and answer_delay.
class SimNode {
 public:
  /// `bus` must outlive the node.
  SimNode(ros::NodeHandle& private_handle, sim::PtyBus& bus);

 private:
  struct Drive {
    std::string name;
    ros::Publisher truth;
    std::vector<ros::ServiceServer> services;
  };

  void addServices(std::size_t index);
  void addSwitch(std::size_t index, const std::string& service, void (*act)(sim::DriveUnit&, bool), const char* on,
                 const char* off);
  void publish();
  SimDrive truthOf(const sim::DriveUnit& drive) const;
  bool trip(std::size_t index, const SimTrip::Request& request, SimTrip::Response& response);
  bool setParameter(std::size_t index, const SimSetParameter::Request& request, SimSetParameter::Response& response);
  bool setAnswerDelay(std::size_t index, const SimAnswerDelay::Request& request, SimAnswerDelay::Response& response);

  /// Runs `function(DriveUnit&)` while the models stand still.
  template <typename Function>
  auto withDrive(std::size_t index, Function&& function) {
    return bus_.withModel([&](sim::RobotSim& robot) { return function(robot.drive(index)); });
  }

  ros::NodeHandle handle_;
  sim::PtyBus& bus_;
  std::vector<Drive> drives_;
  ros::Publisher odom_;
  ros::ServiceServer referee_;
  ros::SteadyTimer timer_;
};

}  // namespace nord_driver::sim_node
