#include "sim_node.h"

#include <nav_msgs/Odometry.h>

#include <boost/function.hpp>
#include <cmath>

namespace nord_driver::sim_node {

namespace {

constexpr double kTruthPeriod = 0.02;  // s

template <typename Service>
using Callback = boost::function<bool(typename Service::Request&, typename Service::Response&)>;

nav_msgs::Odometry toOdometry(const sim::DiffDriveBody& body, const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.position.x = body.pose().x;
  message.pose.pose.position.y = body.pose().y;
  message.pose.pose.orientation.z = std::sin(0.5 * body.pose().theta);
  message.pose.pose.orientation.w = std::cos(0.5 * body.pose().theta);
  message.twist.twist.linear.x = body.linear();
  message.twist.twist.angular.z = body.angular();
  return message;
}

}  // namespace

SimNode::SimNode(ros::NodeHandle& private_handle, sim::PtyBus& bus) : handle_(private_handle), bus_(bus) {
  const sim::SimConfig config = bus_.withModel([](sim::RobotSim& robot) { return robot.config(); });
  if (config.body) odom_ = handle_.advertise<nav_msgs::Odometry>("truth/odom", 10);
  for (const sim::DriveConfig& drive : config.drives) {
    Drive entry;
    entry.name = drive.name;
    entry.truth = handle_.advertise<SimDrive>("truth/" + drive.name, 10);
    drives_.push_back(entry);
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) addServices(i);

  const Callback<std_srvs::Trigger> referee = [this](std_srvs::Trigger::Request&,
                                                     std_srvs::Trigger::Response& response) {
    bus_.withModel([&](sim::RobotSim& robot) {
      response.success = robot.referee().content();
      response.message = robot.referee().report();
    });
    return true;
  };
  referee_ = handle_.advertiseService("referee", referee);
  timer_ =
      handle_.createSteadyTimer(ros::WallDuration(kTruthPeriod), [this](const ros::SteadyTimerEvent&) { publish(); });
}

void SimNode::addSwitch(std::size_t index, const std::string& service, void (*act)(sim::DriveUnit&, bool),
                        const char* on, const char* off) {
  const Callback<std_srvs::SetBool> callback = [this, index, act, on, off](std_srvs::SetBool::Request& request,
                                                                           std_srvs::SetBool::Response& response) {
    withDrive(index, [&](sim::DriveUnit& drive) { act(drive, request.data != 0); });
    response.success = true;
    response.message = drives_[index].name + ": " + (request.data != 0 ? on : off);
    return true;
  };
  drives_[index].services.push_back(handle_.advertiseService(drives_[index].name + "/" + service, callback));
}

void SimNode::addServices(std::size_t index) {
  addSwitch(
      index, "unplug", [](sim::DriveUnit& drive, bool on) { drive.setPlugged(!on); },
      "unplugged: the module is silent, the mains are off", "plugged in");
  addSwitch(
      index, "power_inverter", [](sim::DriveUnit& drive, bool on) { drive.setInverterPower(on); },
      "mains of the inverter on", "mains of the inverter off, the module lives on 24 V");
  addSwitch(
      index, "mute", [](sim::DriveUnit& drive, bool on) { drive.slave().setMute(on); }, "answers are lost",
      "answers get through");
  addSwitch(
      index, "local_control", [](sim::DriveUnit& drive, bool on) { drive.inverter().setLocalControl(on); },
      "controlled by its terminals, which say OFF1", "controlled by the bus");

  const std::string prefix = drives_[index].name + "/";
  const Callback<SimTrip> trip_callback = [this, index](SimTrip::Request& request, SimTrip::Response& response) {
    return trip(index, request, response);
  };
  const Callback<SimSetParameter> parameter_callback = [this, index](SimSetParameter::Request& request,
                                                                     SimSetParameter::Response& response) {
    return setParameter(index, request, response);
  };
  const Callback<SimAnswerDelay> delay_callback = [this, index](SimAnswerDelay::Request& request,
                                                                SimAnswerDelay::Response& response) {
    return setAnswerDelay(index, request, response);
  };
  const Callback<std_srvs::Trigger> clear_callback = [this, index](std_srvs::Trigger::Request&,
                                                                   std_srvs::Trigger::Response& response) {
    withDrive(index, [](sim::DriveUnit& drive) { drive.inverter().clearCause(); });
    response.success = true;
    response.message = drives_[index].name + ": the cause is gone, the fault waits for its acknowledgement";
    return true;
  };
  std::vector<ros::ServiceServer>& services = drives_[index].services;
  services.push_back(handle_.advertiseService(prefix + "trip", trip_callback));
  services.push_back(handle_.advertiseService(prefix + "clear_cause", clear_callback));
  services.push_back(handle_.advertiseService(prefix + "set_parameter", parameter_callback));
  services.push_back(handle_.advertiseService(prefix + "answer_delay", delay_callback));
}

bool SimNode::trip(std::size_t index, const SimTrip::Request& request, SimTrip::Response& response) {
  if (request.number == 0) {
    response.message = "number is 0; expected a fault number as P700 shows it, 102 for E10.2";
    return true;
  }
  withDrive(index, [&](sim::DriveUnit& drive) {
    response.success = drive.inverter().powered();
    drive.inverter().trip(request.number, request.cause_stays != 0);
  });
  response.message = drives_[index].name +
                     (response.success != 0 ? ": tripped with fault " : ": off, cannot trip with ") +
                     std::to_string(request.number);
  return true;
}

bool SimNode::setParameter(std::size_t index, const SimSetParameter::Request& request,
                           SimSetParameter::Response& response) {
  const unsigned element = request.index == 0 ? 0u : request.index - 1u;
  const unsigned first = request.parameter_set == 0 ? 0u : request.parameter_set - 1u;
  const unsigned last = request.parameter_set == 0 ? sim::ParameterStore::kSets - 1 : first;
  bool known = true;
  withDrive(index, [&](sim::DriveUnit& drive) {
    for (unsigned set = first; set <= last; ++set) {
      known = drive.parameters().preset(request.number, set, element, request.raw) && known;
    }
  });
  response.success = known;
  response.message = known ? "P" + std::to_string(request.number) + " is " + std::to_string(request.raw)
                           : "no parameter P" + std::to_string(request.number) + " with set " +
                                 std::to_string(request.parameter_set) + " and index " + std::to_string(request.index);
  return true;
}

bool SimNode::setAnswerDelay(std::size_t index, const SimAnswerDelay::Request& request,
                             SimAnswerDelay::Response& response) {
  if (!(request.seconds >= 0.0 && request.seconds <= 60.0)) {
    response.message = "seconds is " + std::to_string(request.seconds) + "; expected 0 to 60";
    return true;
  }
  withDrive(index, [&](sim::DriveUnit& drive) {
    drive.setAnswerDelay(seconds(request.seconds));
    drive.pkw().setDelay(request.parameter_cycles);
  });
  response.success = true;
  response.message = drives_[index].name + ": answers " + std::to_string(request.seconds) + " s late, parameters " +
                     std::to_string(request.parameter_cycles) + " telegrams late";
  return true;
}

SimDrive SimNode::truthOf(const sim::DriveUnit& drive) const {
  const sim::InverterModel& inverter = drive.inverter();
  const sim::SlaveCounters& counters = drive.slave().counters();
  SimDrive truth;
  truth.powered = inverter.powered();
  truth.in_data_exchange = drive.slave().state() == sim::SlaveState::kDataExchange;
  truth.operation_enabled = inverter.state() == sim::InverterState::kOperationEnabled;
  truth.status_word = inverter.statusWord();
  truth.control_word = counters.last_control;
  truth.last_control_word_before_loss = counters.control_before_loss;
  truth.status_word_at_loss = counters.status_at_loss;
  truth.setpoint_1 = toSigned(inverter.setpoint1());
  truth.parameter_set = static_cast<std::uint8_t>(inverter.parameterSet() + 1);
  truth.frequency = inverter.frequency();
  truth.shaft_velocity = drive.shaftSpeed();
  truth.shaft_angle = drive.shaftAngle();
  truth.wheel_velocity = drive.wheelSpeed();
  truth.wheel_angle = drive.wheelAngle();
  truth.fault_number = inverter.faultNumber();
  truth.watchdog_trips = counters.watchdog_trips;
  truth.set_switches = inverter.setSwitches();
  truth.telegrams = counters.telegrams;
  truth.zero_control_words = counters.zero_control_words;
  truth.eeprom_writes = drive.parameters().eepromWrites();
  return truth;
}

void SimNode::publish() {
  // Copied while the models stand still, sent afterwards: the bus does not wait for ROS.
  std::vector<SimDrive> truths;
  nav_msgs::Odometry odometry;
  const ros::Time stamp = ros::Time::now();
  bus_.withModel([&](sim::RobotSim& robot) {
    for (const auto& drive : robot.drives()) truths.push_back(truthOf(*drive));
    if (robot.body()) odometry = toOdometry(*robot.body(), stamp);
  });
  for (std::size_t i = 0; i < truths.size(); ++i) {
    truths[i].header.stamp = stamp;
    drives_[i].truth.publish(truths[i]);
  }
  if (odom_) odom_.publish(odometry);
}

}  // namespace nord_driver::sim_node
