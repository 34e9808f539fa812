// The services of the node: each hands a request to the bus cycle, waits for its answer and passes it on in words.
#pragma once

#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <deque>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "catalogue/parameter_access.h"
#include "cycle/request.h"
#include "node/fault_board.h"
#include "node/node_config.h"
#include "node/request_broker.h"
#include "node/stop_calls.h"
#include "nord_driver/ReadParameter.h"
#include "nord_driver/SelectParameterSet.h"
#include "nord_driver/WriteParameter.h"
#include "state/drive_eeprom.h"

namespace nord_driver::node {

/// Private handles whose callbacks do not wait behind those of another one: with threads of their own, as StopCalls says
/// how many.
struct ServiceLanes {
  ros::NodeHandle& others;
  ros::NodeHandle& enable;
  ros::NodeHandle& quick_stop;
  ros::NodeHandle& home;
};

class Services {
 public:
  /// `known` and `eeproms`: of each drive. `eeproms` and `faults` must outlive the services.
  Services(const ServiceLanes& lanes, const NodeConfig& config, std::vector<catalogue::DriveCatalogue> known,
           const FaultBoard& faults, std::deque<state::DriveEeprom>& eeproms, RequestBroker& broker);

 private:
  template <typename Service, typename Handler>
  void advertise(ros::NodeHandle& node, const std::string& name, Handler handler);
  cycle::Completion ask(cycle::RequestKind kind, DriveIndex drive);
  /// Its message; of a refusal with the faults that stand.
  std::string messageOf(const cycle::Completion& answer, DriveIndex drive) const;
  /// Hands an access to the cycle and waits for its answer.
  cycle::Completion carryOut(DriveIndex drive, cycle::RequestKind kind, const catalogue::ParameterAccess& access);
  void selectSet(DriveIndex drive, SelectParameterSet::Request& request, SelectParameterSet::Response& response);
  void readParameter(DriveIndex drive, ReadParameter::Request& request, ReadParameter::Response& response);

  void writeParameter(DriveIndex drive, WriteParameter::Request& request, WriteParameter::Response& response);

  const NodeConfig& config_;
  std::vector<catalogue::DriveCatalogue> known_;
  const FaultBoard& faults_;
  std::deque<state::DriveEeprom>& eeproms_;
  RequestBroker& broker_;
  StopCalls stops_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace nord_driver::node
