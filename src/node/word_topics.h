// Topics of what users command in the process data beside the velocity: ~<drive>/setpoints/<name>
// and, of outputs, ~<drive>/signals/<name>.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "cycle/cycle_config.h"
#include "cycle/cycle_ports.h"
#include "node/callback_threads.h"

namespace nord_driver::node {

class WordTopics {
 public:
  /// `lane`: the private handle whose callbacks wait behind no service.
  WordTopics(CallbackThreads& lane, const cycle::CycleConfig& config, cycle::CyclePorts& ports);

  /// Publishers connected to topics that can turn a motor.
  std::uint32_t commanders() const;
  /// Values ignored, because they were no number or infinite.
  std::uint64_t ignored() const noexcept { return ignored_; }

 private:
  void addOutput(CallbackThreads& lane, DriveIndex drive, const std::string& topic, std::size_t index);
  void addSetpoint(CallbackThreads& lane, DriveIndex drive, const cycle::DriveSetup& setup, std::size_t index);

  cycle::CyclePorts& ports_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<std::size_t> moving_;  // of `subscribers_`
  std::atomic<std::uint64_t> ignored_{0};
};

}  // namespace nord_driver::node
