#include "nord_driver/node/services.h"

#include <boost/function.hpp>
#include <cmath>
#include <cstdint>

#include "nord_driver/transport/setting_checks.h"

namespace nord_driver::node {

using cycle::kAllDrives;
using cycle::RequestKind;

namespace {

double valueOf(const profile::ParameterInfo* info, std::int32_t raw) {
  return info != nullptr ? profile::toValue(*info, raw) : raw;
}

// Nobody has said how an unknown parameter is indexed: as it was asked for.
profile::ParameterShape shapeOfUnknown(std::uint8_t set, std::uint8_t index) {
  if (set != 0) return index != 0 ? profile::ParameterShape::kArrayPerSet : profile::ParameterShape::kPerSet;
  return index != 0 ? profile::ParameterShape::kArray : profile::ParameterShape::kPlain;
}

std::optional<std::int32_t> rawValue(double value) {
  const double rounded = std::round(value);
  if (!(std::abs(rounded) <= INT32_MAX)) return std::nullopt;
  return static_cast<std::int32_t>(rounded);
}

std::string rangeOf(const profile::ParameterInfo* info) {
  if (info == nullptr) return "a whole number of 32 bits";
  return shortNumber(profile::toValue(*info, info->minimum)) + " to " +
         shortNumber(profile::toValue(*info, info->maximum)) + (info->unit[0] != '\0' ? " " : "") + info->unit;
}

}  // namespace

/// Which parameter a request names. Returns what is wrong with it; empty when nothing is.
template <typename RosRequest>
std::string Services::addressParameter(DriveIndex drive, const RosRequest& from, cycle::Request& to,
                                       const profile::ParameterInfo*& info) const {
  if (from.number > 999) {
    return "parameter " + std::to_string(from.number) + " does not exist, expected 0 to 999";
  }
  if (from.parameter_set > 4) {
    return "parameter set " + std::to_string(from.parameter_set) + " does not exist, expected 0 to 4";
  }
  info = profile::findParameter(from.number, config_.cycle.drives[drive].series);
  const std::uint8_t index = from.index == 0 ? 1 : from.index;
  if (info != nullptr) {
    to.parameter = profile::readRequest(*info, from.parameter_set, index);
  } else {
    to.parameter.number = from.number;
    to.parameter.shape = shapeOfUnknown(from.parameter_set, from.index);
    to.parameter.parameter_set = from.parameter_set == 0 ? 1 : from.parameter_set;
    to.parameter.index = index;
  }
  to.drive = drive;
  to.patience = config_.cycle.service_timeout;
  to.active_set = from.parameter_set == 0;
  return "";
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
  access.kind = RequestKind::kReadParameter;
  const profile::ParameterInfo* info = nullptr;
  response.message = addressParameter(drive, request, access, info);
  if (!response.message.empty()) return;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
  if (!answer.success) return;
  response.raw = answer.raw;
  response.value = valueOf(info, answer.raw);
  if (info != nullptr) {
    response.unit = info->unit;
    response.name = info->name;
  }
}

void Services::writeParameter(DriveIndex drive, WriteParameter::Request& request, WriteParameter::Response& response) {
  cycle::Request access;
  access.kind = RequestKind::kWriteParameter;
  const profile::ParameterInfo* info = nullptr;
  response.message = addressParameter(drive, request, access, info);
  if (!response.message.empty()) return;
  access.parameter.action =
      request.persistent ? profile::ParameterAction::kWritePersistent : profile::ParameterAction::kWriteRam;
  const auto raw = info != nullptr ? profile::toRaw(*info, request.value) : rawValue(request.value);
  if (info == nullptr && !config_.allow_raw_parameters) {
    response.message =
        "P" + std::to_string(request.number) +
        " is not in the catalogue: its unit is not known, and raw values need allow_raw_parameters: true";
    return;
  }
  if (!raw) {
    response.message = "the value " + shortNumber(request.value) + " cannot be written to P" +
                       std::to_string(request.number) + ", expected " + rangeOf(info);
    return;
  }
  access.parameter.raw = *raw;
  const cycle::Completion answer = broker_.call(access);
  response.success = answer.success;
  response.message = answer.message.str();
  response.raw = answer.raw;
  response.value = valueOf(info, answer.raw);
}

}  // namespace nord_driver::node
