// The signals of one drive that users read: ~<drive>/signals/<name>, latched.
#pragma once

#include <ros/ros.h>

#include <optional>
#include <vector>

#include "cycle/cycle_config.h"
#include "cycle/snapshot.h"

namespace nord_driver::node {

class SignalPublisher {
 public:
  /// `private_node`: "~". Bool, of an analogue input Float64 in %.
  SignalPublisher(ros::NodeHandle& private_node, const cycle::DriveSetup& setup);

  /// What has changed. One that is not known now stays as it was told last: `online` of the status says so.
  void publish(const cycle::DriveSnapshot& drive);

 private:
  struct Signal {
    cycle::SignalSetup setup;
    ros::Publisher publisher;
    std::optional<double> told;
  };

  profile::Series series_;
  std::vector<Signal> signals_;
};

}  // namespace nord_driver::node
