// The simulator node of common.launch: its services, its truth, its bus, freshly plugged in for every test.
#pragma once

#include <gmock/gmock.h>
#include <nord_driver/SimAnswerDelay.h>
#include <nord_driver/SimDrive.h>
#include <nord_driver/SimParameterChannel.h>
#include <nord_driver/SimTerminals.h>
#include <nord_driver/SimTrip.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <memory>
#include <string>

#include "ros_support/service_call.h"
#include "sim_node/bus_client.h"

namespace nord_driver::sim_node {

class SimNodeTest : public ::testing::Test {
 protected:
  void SetUp() override;

  /// The service's response; its absence within ten seconds is a failure.
  template <typename Service>
  static typename Service::Response call(const std::string& service, const typename Service::Request& request) {
    Service call;
    call.request = request;
    const std::string name = "/nord_sim/" + service;
    EXPECT_TRUE(ros::service::waitForService(name, ros::Duration(10.0))) << name;
    EXPECT_TRUE(test::carryOut(name, call)) << name;
    return call.response;
  }
  static std::string trigger(const std::string& service);
  static std::string set(const std::string& service, bool data);

  /// The truth about the drive as published after the call.
  static SimDrive truth();
  /// Waits for a truth the predicate likes, for at most ten seconds.
  static bool eventually(const std::function<bool(const SimDrive&)>& likes);

  std::unique_ptr<BusClient> bus;
};

}  // namespace nord_driver::sim_node
