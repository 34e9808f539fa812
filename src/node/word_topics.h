// Topics of what users command in the process data beside the velocity: ~<drive>/setpoints/<name>
// and, of outputs, ~<drive>/signals/<name>.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cycle/cycle_config.h"
#include "cycle/cycle_ports.h"
#include "node/callback_threads.h"
#include "node/ignored_commands.h"

namespace nord_driver::node {

class WordTopics {
 public:
  /// `lane`: the private handle whose callbacks wait behind no service.
  /// Values that are no number or infinite are counted in `ignored`, which must outlive it.
  WordTopics(CallbackThreads& lane, const cycle::CycleConfig& config, cycle::CyclePorts& ports,
             IgnoredCommands& ignored);

  /// Publishers connected to topics that can turn a motor.
  std::uint32_t commanders() const;

 private:
  void addOutput(CallbackThreads& lane, DriveIndex drive, const std::string& topic, std::size_t index);
  void addSetpoint(CallbackThreads& lane, DriveIndex drive, const cycle::DriveSetup& setup, std::size_t index);

  cycle::CyclePorts& ports_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<std::size_t> moving_;  // of `subscribers_`
  IgnoredCommands& ignored_;
};

}  // namespace nord_driver::node
