#include "nord_driver/node/services.h"

#include <boost/function.hpp>

#include "nord_driver/profile/parameter_catalogue.h"

namespace nord_driver::node {

using cycle::kAllDrives;
using cycle::RequestKind;

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

Services::Services(ros::NodeHandle& private_node, const NodeConfig& config, RequestBroker& broker)
    : config_(config), broker_(broker) {
  const auto addTrigger = [&](const std::string& name, RequestKind kind, DriveIndex drive) {
    advertise<std_srvs::Trigger>(private_node, name,
                                 [this, kind, drive](auto&, auto& response) { trigger(kind, drive, response); });
  };
  const auto addEnable = [&](const std::string& name, DriveIndex drive) {
    advertise<std_srvs::SetBool>(private_node, name,
                                 [this, drive](auto& request, auto& response) { enable(drive, request, response); });
  };
  addEnable("enable", kAllDrives);
  addTrigger("quick_stop", RequestKind::kQuickStop, kAllDrives);
  addTrigger("reset_odometry", RequestKind::kResetOdometry, kAllDrives);
  for (DriveIndex i = 0; i < config.cycle.drives.size(); ++i) {
    const std::string prefix = config.cycle.drives[i].name + "/";
    addEnable(prefix + "enable", i);
    addTrigger(prefix + "quick_stop", RequestKind::kQuickStop, i);
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

void Services::enable(DriveIndex drive, std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const cycle::Completion answer = ask(request.data ? RequestKind::kEnable : RequestKind::kDisable, drive);
  response.success = answer.success;
  response.message = answer.message.str();
}

void Services::trigger(RequestKind kind, DriveIndex drive, std_srvs::Trigger::Response& response) {
  const cycle::Completion answer = ask(kind, drive);
  response.success = answer.success;
  response.message = answer.message.str();
}

void Services::readParameter(DriveIndex drive, ReadParameter::Request& request, ReadParameter::Response& response) {
  const profile::ParameterInfo* info = profile::findParameter(request.number, config_.cycle.drives[drive].series);
  cycle::Request access;
  access.kind = RequestKind::kReadParameter;
  access.drive = drive;
  access.patience = config_.cycle.service_timeout;
  if (request.number > 999) {
    response.message = "parameter " + std::to_string(request.number) + " does not exist, expected 0 to 999";
    return;
  }
  if (request.parameter_set > 4) {
    response.message = "parameter set " + std::to_string(request.parameter_set) + " does not exist, expected 0 to 4";
    return;
  }
  const std::uint8_t index = request.index == 0 ? 1 : request.index;
  if (info != nullptr) {
    access.parameter = profile::readRequest(*info, request.parameter_set, index);
  } else {
    access.parameter.number = request.number;
    access.parameter.shape = request.index != 0 ? profile::ParameterShape::kArray : profile::ParameterShape::kPlain;
    access.parameter.index = index;
  }
  access.active_set = request.parameter_set == 0;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
  if (!answer.success) return;
  response.raw = answer.parameter.raw;
  response.value = info != nullptr ? profile::toValue(*info, answer.parameter.raw) : answer.parameter.raw;
  if (info != nullptr) {
    response.unit = info->unit;
    response.name = info->name;
  }
}

}  // namespace nord_driver::node
