// The services of the node: each hands a request to the bus cycle, waits for its answer and passes it on in words.
#pragma once

#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <vector>

#include "cycle/request.h"
#include "node/node_config.h"
#include "node/request_broker.h"
#include "nord_driver/ReadParameter.h"
#include "nord_driver/SelectParameterSet.h"
#include "nord_driver/WriteParameter.h"
#include "profile/parameter_catalogue.h"

namespace nord_driver::node {

class Services {
 public:
  /// `stop_node`: the private handle whose callbacks do not wait behind those of the other services.
  Services(ros::NodeHandle& private_node, ros::NodeHandle& stop_node, const NodeConfig& config, RequestBroker& broker);

 private:
  template <typename Service, typename Handler>
  void advertise(ros::NodeHandle& node, const std::string& name, Handler handler);
  cycle::Completion ask(cycle::RequestKind kind, DriveIndex drive);
  template <typename RosRequest>
  std::string addressParameter(DriveIndex drive, const RosRequest& from, cycle::Request& to,
                               const profile::ParameterInfo*& info) const;
  void selectSet(DriveIndex drive, SelectParameterSet::Request& request, SelectParameterSet::Response& response);
  void readParameter(DriveIndex drive, ReadParameter::Request& request, ReadParameter::Response& response);

  void writeParameter(DriveIndex drive, WriteParameter::Request& request, WriteParameter::Response& response);

  const NodeConfig& config_;
  RequestBroker& broker_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace nord_driver::node
