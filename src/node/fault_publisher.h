// ~<drive>/fault, latched.
#pragma once

#include <ros/ros.h>

#include <string>

#include "cycle/snapshot.h"
#include "node/fault_messages.h"
#include "node/stamps.h"

namespace nord_driver::node {

/// Of one drive.
class FaultPublisher {
 public:
  /// `private_node`: "~".
  FaultPublisher(ros::NodeHandle& private_node, const std::string& drive, const catalogue::FaultWords& words)
      : messages_(drive, words), publisher_(private_node.advertise<Fault>(drive + "/fault", 10, true)) {}

  /// With every snapshot.
  void update(const cycle::DriveSnapshot& drive, const Stamps& stamps) {
    for (const Fault& message : messages_.poll(drive, stamps)) publisher_.publish(message);
  }

 private:
  FaultMessages messages_;
  ros::Publisher publisher_;
};

}  // namespace nord_driver::node
