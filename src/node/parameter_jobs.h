// The services that read all parameters of a drive: jobs of many accesses, beside everything else.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "node/broker_parameters.h"
#include "node/node_config.h"
#include "node/request_broker.h"
#include "nord_driver/DumpParameters.h"
#include "nord_driver/VerifyParameters.h"

namespace nord_driver::node {

/// ~<drive>/dump_parameters and ~<drive>/verify_parameters. A job has one access at a time in the queue of its drive, so
/// that process data and the accesses of other services wait for none; it ends when the drive does not answer one.
/// One job at a time for each drive.
class ParameterJobs {
 public:
  /// `node`: the private handle whose callbacks have threads of their own, for they take minutes. `known` and `eeproms`
  /// are of each drive, as `identities`; all must outlive the object.
  ParameterJobs(ros::NodeHandle& node, const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                const std::vector<catalogue::DriveCatalogue>& known, std::deque<state::DriveEeprom>& eeproms,
                RequestBroker& broker);

  /// What runs ends after the access under way, and nothing new begins. By any thread.
  void end() noexcept { end_asked_ = true; }

 private:
  struct Drive {
    explicit Drive(BrokerParameters its) : parameters(std::move(its)) {}
    BrokerParameters parameters;
    std::atomic<bool> busy{false};
  };

  /// Carries `job` out, unless another one runs at the drive. A sentence on why not, or why it has failed; empty: done.
  std::string run(Drive& drive, const std::function<void()>& job);
  void dump(Drive& drive, DumpParameters::Response& response);
  void verify(Drive& drive, const VerifyParameters::Request& request, VerifyParameters::Response& response);

  std::deque<Drive> drives_;
  std::atomic<bool> end_asked_{false};
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace nord_driver::node
