// Service calls whose answer cannot get lost on the way.
#pragma once

#include <ros/ros.h>

#include <string>

namespace nord_driver::test {

/// A client over a connection that it ends itself: where the server ends it after its answer, roscpp's client may take
/// that for a lost connection before it has read the answer (ros_comm issue 1976; one of some 60 000 calls).
template <typename Service>
ros::ServiceClient connectTo(const std::string& name) {
  constexpr bool kPersistent = true;
  return ros::NodeHandle().serviceClient<Service>(name, kPersistent);
}

/// One call over a connection of its own.
template <typename Service>
bool carryOut(const std::string& name, Service& service) {
  return connectTo<Service>(name).call(service);
}

}  // namespace nord_driver::test
