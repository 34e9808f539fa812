// A service whose handler fills an answer and never lets the call itself fail.
#pragma once

#include <ros/ros.h>

#include <boost/function.hpp>
#include <string>

namespace nord_driver::node {

/// `handler(request, response)`: a refusal is an answer, not a failed call.
template <typename Service, typename Handler>
ros::ServiceServer offer(ros::NodeHandle& node, const std::string& name, Handler handler) {
  // A bare lambda is ambiguous to advertiseService.
  boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
      [handler](typename Service::Request& request, typename Service::Response& response) {
        handler(request, response);
        return true;
      };
  return node.advertiseService(name, callback);
}

}  // namespace nord_driver::node
