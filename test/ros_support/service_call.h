// Service calls whose answer cannot get lost on the way.
#pragma once

#include <ros/ros.h>

#include <string>

namespace nord_driver::test {

/// Over a connection that the caller ends: where the server ends it after its answer, roscpp's client may take that for
/// a lost connection before it has read the answer (ros_comm issue 1976; one of some 60 000 calls).
template <typename Service>
bool carryOut(const std::string& name, Service& service) {
  constexpr bool kPersistent = true;
  return ros::NodeHandle().serviceClient<Service>(name, kPersistent).call(service);
}

}  // namespace nord_driver::test
