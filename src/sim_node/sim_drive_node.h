// One simulated drive in ROS: its truth as a topic, what can go wrong with it as services.
#pragma once

#include <nord_driver/SimAnswerDelay.h>
#include <nord_driver/SimDrive.h>
#include <nord_driver/SimInputs.h>
#include <nord_driver/SimParameterChannel.h>
#include <nord_driver/SimSetParameter.h>
#include <nord_driver/SimTerminals.h>
#include <nord_driver/SimTrip.h>
#include <nord_driver/SimWarn.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>
#include <vector>

#include "sim/running_bus.h"

namespace nord_driver::sim_node {

/// Publishes ~truth/<drive>; services ~<drive>/trip, clear_cause, acknowledge, warn, unplug, power_inverter,
/// power_module, module_link, mute, torn_words, block, answer_delay, parameter_channel, local_control, terminals, inputs
/// and set_parameter.
class SimDriveNode {
 public:
  /// `bus` must outlive it.
  SimDriveNode(ros::NodeHandle& handle, sim::RunningBus& bus, std::size_t index, const std::string& name);
  SimDriveNode(const SimDriveNode&) = delete;
  SimDriveNode& operator=(const SimDriveNode&) = delete;

  static SimDrive truthOf(const sim::DriveUnit& drive);
  void publish(const SimDrive& truth) { truth_.publish(truth); }

 private:
  /// What a service does with the drive while the models stand still. It returns the message; `success` is true before.
  template <typename Service>
  using Act =
      std::function<std::string(sim::DriveUnit&, const typename Service::Request&, typename Service::Response&)>;

  template <typename Service>
  void serve(const std::string& service, Act<Service> act);
  void serveSwitch(const std::string& service, void (*act)(sim::DriveUnit&, bool), const char* on, const char* off);
  void serveFaults();
  void serveStation();
  void serveParameters();
  void serveControl();
  void serveInputs();

  ros::NodeHandle handle_;
  sim::RunningBus& bus_;
  std::size_t index_;
  std::string name_;
  ros::Publisher truth_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace nord_driver::sim_node
