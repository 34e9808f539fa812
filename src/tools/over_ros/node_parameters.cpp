#include "tools/over_ros/node_parameters.h"

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service.h>

#include <utility>

#include "nord_driver/DriveStatus.h"
#include "nord_driver/ReadParameter.h"
#include "nord_driver/WriteParameter.h"
#include "profile/parameter_shape.h"

namespace nord_driver::tools {

namespace {

const ros::WallDuration kStatusTime{2.0};  // it is published several times a second

}  // namespace

NodeParameters::NodeParameters(const std::string& node, DriveDescription drive)
    : node_(node), drive_(std::move(drive)) {
  const std::string prefix = node_ + "/" + drive_.name + "/";
  ros::NodeHandle handle;
  for (const char* service : {"read_parameter", "write_parameter"}) {
    if (ros::service::exists(prefix + service, false)) continue;
    throw Trouble("no service " + prefix + service + ": is " + node_ + " a nord_driver_node that runs and has drive " +
                  drive_.name + "?");
  }
  // Connected as long as the program runs: a dump asks hundreds of times.
  read_ = handle.serviceClient<ReadParameter>(prefix + "read_parameter", true);
  write_ = handle.serviceClient<WriteParameter>(prefix + "write_parameter", true);
}

template <typename Service>
void NodeParameters::call(ros::ServiceClient& client, Service& service) {
  if (client.call(service)) return;
  throw Trouble("node " + node_ + " gave no answer at " + client.getService() + ": did it end?");
}

// The one in force where none is named, so that it can be told which one was meant.
std::uint8_t NodeParameters::setFor(const catalogue::ParameterAccess& access) {
  if (!profile::hasSets(access.request.shape)) return 0;
  if (access.request.parameter_set != 0) return access.request.parameter_set;
  std::uint8_t set = 0;
  ros::CallbackQueue queue;
  ros::NodeHandle handle;
  handle.setCallbackQueue(&queue);
  const auto status =
      handle.subscribe<DriveStatus>(node_ + "/" + drive_.name + "/status", 1,
                                    [&set](const DriveStatus::ConstPtr& told) { set = told->parameter_set; });
  // Not by ros::Time, which may stand still (/use_sim_time).
  const ros::WallTime end = ros::WallTime::now() + kStatusTime;
  while (set == 0 && ros::WallTime::now() < end) queue.callAvailable(ros::WallDuration(0.1));
  if (set != 0) return set;
  throw Trouble("node " + node_ + " does not tell which parameter set is in force: does drive " + drive_.name +
                " answer? Name one with --set");
}

ParameterAnswer NodeParameters::read(const catalogue::ParameterAddress& address) {
  const catalogue::ParameterAccess access = catalogue::accessTo(address, known());
  if (!access.error.empty()) throw Trouble(access.error);
  ParameterAnswer answer;
  answer.set = setFor(access);
  ReadParameter service;
  service.request.number = address.number;
  service.request.parameter_set = answer.set;
  service.request.index = address.index;
  call(read_, service);
  answer.success = service.response.success != 0;
  answer.refused = service.response.refused != 0;
  answer.unknown = service.response.unknown != 0;
  if (!answer.success) answer.message = service.response.message;
  answer.raw = service.response.raw;
  answer.value = catalogue::valueOf(access.entry, answer.raw, access.request.index);
  answer.entry = access.entry;
  return answer;
}

ParameterAnswer NodeParameters::write(const catalogue::ParameterAccess& access) {
  ParameterAnswer answer;
  answer.set = setFor(access);
  WriteParameter service;
  service.request.number = access.request.number;
  service.request.parameter_set = answer.set;
  if (profile::isArray(access.request.shape)) service.request.index = access.request.index;
  service.request.value = catalogue::valueOf(access.entry, access.request.raw, access.request.index);
  service.request.persistent = access.request.action == profile::ParameterAction::kWritePersistent;
  call(write_, service);
  answer.success = service.response.success != 0;
  answer.refused = !answer.success;
  answer.message = service.response.message;
  answer.raw = service.response.raw;
  answer.value = catalogue::valueOf(access.entry, answer.raw, access.request.index);
  answer.entry = access.entry;
  return answer;
}

}  // namespace nord_driver::tools
