#include "node/word_topics.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <boost/function.hpp>
#include <string>

namespace nord_driver::node {

WordTopics::WordTopics(CallbackThreads& lane, const cycle::CycleConfig& config, cycle::CyclePorts& ports,
                       IgnoredCommands& ignored)
    : ports_(ports), ignored_(ignored) {
  for (DriveIndex drive = 0; drive < config.drives.size(); ++drive) {
    const cycle::DriveSetup& setup = config.drives[drive];
    for (std::size_t i = 0; i < setup.words.setpoints.size(); ++i) addSetpoint(lane, drive, setup, i);
    std::size_t outputs = 0;
    for (const cycle::SignalSetup& signal : setup.words.signals) {
      if (!cycle::isOutput(signal.source)) continue;
      addOutput(lane, drive, setup.name + "/signals/" + signal.name, outputs++);
    }
  }
}

void WordTopics::addOutput(CallbackThreads& lane, DriveIndex drive, const std::string& topic, std::size_t index) {
  boost::function<void(const std_msgs::Bool&)> take = [this, drive, index](const std_msgs::Bool& on) {
    ports_.commandOutput(drive, index, on.data != 0, std::chrono::steady_clock::now());
  };
  subscribers_.push_back(lane.handle().subscribe<std_msgs::Bool>(topic, 1, take));
}

void WordTopics::addSetpoint(CallbackThreads& lane, DriveIndex drive, const cycle::DriveSetup& setup,
                             std::size_t index) {
  const cycle::SetpointSetup& setpoint = setup.words.setpoints[index];
  const std::string topic = setup.name + "/setpoints/" + setpoint.name;
  boost::function<void(const std_msgs::Float64&)> take = [this, drive, index, topic](const std_msgs::Float64& value) {
    const Instant now = std::chrono::steady_clock::now();
    if (ports_.commandSetpoint(drive, index, value.data, now)) return;
    // No command at all: the time-out of the one before runs on.
    if (const auto count = ignored_.add(drive, now)) {
      ROS_WARN("nord_driver: %s is not a number or infinite, ignored (%lu of this drive so far)", topic.c_str(),
               static_cast<unsigned long>(*count));
    }
  };
  if (setpoint.moves) moving_.push_back(subscribers_.size());
  subscribers_.push_back(lane.handle().subscribe<std_msgs::Float64>(topic, 1, take));
}

std::uint32_t WordTopics::commanders() const {
  std::uint32_t publishers = 0;
  for (const std::size_t i : moving_) publishers += subscribers_[i].getNumPublishers();
  return publishers;
}

}  // namespace nord_driver::node
