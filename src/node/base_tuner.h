// dynamic_reconfigure: what can be changed of a base while it runs, by diff_drive_controller's names.
#pragma once

#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>

#include "cycle/cycle_ports.h"
#include "node/base_publisher.h"
#include "node/node_config.h"
#include "nord_driver/TuningConfig.h"

namespace nord_driver::node {

/// Hands the multipliers to the cycle (which takes them over at standstill), rate and tf to the publisher.
class BaseTuner {
 public:
  /// `config` has a base. The server's values, and what it leaves on the parameter server, are the configuration's.
  BaseTuner(ros::NodeHandle& private_node, const NodeConfig& config, cycle::CyclePorts& ports,
            BasePublisher& publisher);

 private:
  void take(TuningConfig& wanted);
  void offerRanges();

  cycle::CyclePorts& ports_;
  BasePublisher& publisher_;
  TuningConfig taken_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<TuningConfig> server_;
};

}  // namespace nord_driver::node
