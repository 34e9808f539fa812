#include "node/services.h"

#include <boost/function.hpp>

#include "cycle/parameter_access.h"

namespace nord_driver::node {

using cycle::kAllDrives;
using cycle::RequestKind;

namespace {

// Who reads the log later sees who moved the robot, and what was answered.
void tellOutcome(const std::string& call, const cycle::Completion& answer) {
  if (answer.success) {
    ROS_INFO("nord_driver: ~%s: %s", call.c_str(), answer.message.c_str());
  } else {
    ROS_WARN("nord_driver: ~%s is refused, or failed: %s", call.c_str(), answer.message.c_str());
  }
}

}  // namespace

/// Which parameter a request names. Returns what is wrong with it; empty when nothing is.
template <typename RosRequest>
std::string Services::addressParameter(DriveIndex drive, const RosRequest& from, cycle::Request& to,
                                       const profile::ParameterInfo*& info) const {
  to.drive = drive;
  to.patience = config_.cycle.service_timeout;
  return cycle::addressParameter({from.number, from.parameter_set, from.index}, config_.cycle.drives[drive].series, to,
                                 info);
}

template <typename Service, typename Handler>
void Services::advertise(ros::NodeHandle& node, const std::string& name, Handler handler) {
  // A bare lambda is ambiguous to advertiseService.
  boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
      [handler](typename Service::Request& request, typename Service::Response& response) {
        handler(request, response);
        return true;  // a refusal is an answer, not a failed call
      };
  servers_.push_back(node.advertiseService(name, callback));
}

Services::Services(ros::NodeHandle& private_node, ros::NodeHandle& stop_node, const NodeConfig& config,
                   RequestBroker& broker)
    : config_(config), broker_(broker) {
  const auto addTrigger = [&](const std::string& name, RequestKind kind, DriveIndex drive) {
    ros::NodeHandle& node = kind == RequestKind::kQuickStop ? stop_node : private_node;
    advertise<std_srvs::Trigger>(node, name, [this, kind, drive, name](auto&, auto& response) {
      const cycle::Completion answer = ask(kind, drive);
      tellOutcome(name, answer);
      response.success = answer.success;
      response.message = answer.message.str();
    });
  };
  const auto addEnable = [&](const std::string& name, DriveIndex drive) {
    advertise<std_srvs::SetBool>(stop_node, name, [this, drive, name](auto& request, auto& response) {
      const bool on = request.data != 0;
      const cycle::Completion answer = ask(on ? RequestKind::kEnable : RequestKind::kDisable, drive);
      tellOutcome(name + (on ? " true" : " false"), answer);
      response.success = answer.success;
      response.message = answer.message.str();
    });
  };
  addEnable("enable", kAllDrives);
  addTrigger("quick_stop", RequestKind::kQuickStop, kAllDrives);
  addTrigger("acknowledge_faults", RequestKind::kAcknowledge, kAllDrives);
  addTrigger("reset_odometry", RequestKind::kResetOdometry, kAllDrives);
  for (DriveIndex i = 0; i < config.cycle.drives.size(); ++i) {
    const std::string prefix = config.cycle.drives[i].name + "/";
    addEnable(prefix + "enable", i);
    addTrigger(prefix + "quick_stop", RequestKind::kQuickStop, i);
    addTrigger(prefix + "acknowledge_fault", RequestKind::kAcknowledge, i);
    advertise<SelectParameterSet>(private_node, prefix + "select_parameter_set",
                                  [this, i](auto& request, auto& response) { selectSet(i, request, response); });
    advertise<WriteParameter>(private_node, prefix + "write_parameter",
                              [this, i](auto& request, auto& response) { writeParameter(i, request, response); });
    advertise<ReadParameter>(private_node, prefix + "read_parameter",
                             [this, i](auto& request, auto& response) { readParameter(i, request, response); });
  }
}

cycle::Completion Services::ask(RequestKind kind, DriveIndex drive) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.patience = config_.cycle.service_timeout;
  return broker_.call(request);
}

void Services::selectSet(DriveIndex drive, SelectParameterSet::Request& request,
                         SelectParameterSet::Response& response) {
  if (request.parameter_set < 1 || request.parameter_set > 4) {
    response.message = "parameter set " + std::to_string(request.parameter_set) + " does not exist, expected 1 to 4";
    return;
  }
  cycle::Request access;
  access.kind = RequestKind::kSelectParameterSet;
  access.drive = drive;
  access.parameter_set = request.parameter_set;
  access.patience = config_.cycle.service_timeout;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
}

void Services::readParameter(DriveIndex drive, ReadParameter::Request& request, ReadParameter::Response& response) {
  cycle::Request access;
  const profile::ParameterInfo* info = nullptr;
  response.message = addressParameter(drive, request, access, info);
  if (!response.message.empty()) return;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
  if (!answer.success) return;
  response.raw = answer.parameter.raw;
  response.value = cycle::valueOf(info, answer.parameter.raw);
  if (info != nullptr) {
    response.unit = info->unit;
    response.name = info->name;
  }
}

void Services::writeParameter(DriveIndex drive, WriteParameter::Request& request, WriteParameter::Response& response) {
  cycle::Request access;
  const profile::ParameterInfo* info = nullptr;
  response.message = addressParameter(drive, request, access, info);
  if (!response.message.empty()) return;
  response.message =
      cycle::addValue({request.value, request.persistent != 0, config_.allow_raw_parameters}, info, access);
  if (!response.message.empty()) return;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
  response.raw = answer.parameter.raw;
  response.value = cycle::valueOf(info, answer.parameter.raw);
}

}  // namespace nord_driver::node
