#include "tools/over_ros/node_parameters.h"

#include <ros/node_handle.h>
#include <ros/param.h>
#include <ros/service.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <sstream>
#include <utility>

#include "nord_driver/DriveStatus.h"
#include "nord_driver/ReadParameter.h"
#include "nord_driver/WriteParameter.h"
#include "profile/parameter_shape.h"

namespace nord_driver::tools {

namespace {

const ros::WallDuration kStatusTime{11.0};  // status_rate is 0.1 Hz at least
const ros::WallDuration kSetTime{2.0};      // from a status without one: a drive that is coming back
constexpr char kWritable[] = "writable_parameters";

SettingValue numbersOf(XmlRpc::XmlRpcValue& told) {
  using XmlRpc::XmlRpcValue;
  if (told.getType() == XmlRpcValue::TypeString) return SettingValue::ofText(static_cast<std::string>(told));
  if (told.getType() == XmlRpcValue::TypeInt) {
    const int number = static_cast<int>(told);
    return SettingValue::ofInteger(number, std::to_string(number));
  }
  if (told.getType() != XmlRpcValue::TypeArray) return SettingValue::other(told.toXml());
  SettingValue list = SettingValue::list();
  for (int i = 0; i < told.size(); ++i) list.items.push_back(numbersOf(told[i]));
  return list;
}

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

DriveStatus NodeParameters::statusOnce(const std::function<bool(const DriveStatus&)>& enough) {
  if (!status_) {
    ros::NodeHandle handle;
    handle.setCallbackQueue(&queue_);
    status_ = handle.subscribe<DriveStatus>(node_ + "/" + drive_.name + "/status", 1,
                                            [this](const DriveStatus::ConstPtr& told) { heard_ = *told; });
  }
  queue_.callAvailable();
  heard_.reset();  // what has lain there may be as old as the last question
  // Not by ros::Time, which may stand still (/use_sim_time).
  ros::WallTime end = ros::WallTime::now() + kStatusTime;
  bool heard_before = false;
  while ((!heard_ || !enough(*heard_)) && ros::WallTime::now() < end) {
    queue_.callAvailable(ros::WallDuration(0.1));
    if (heard_ && !std::exchange(heard_before, true)) end = ros::WallTime::now() + kSetTime;
  }
  if (heard_) return *heard_;
  throw Trouble("node " + node_ + " tells no status of drive " + drive_.name + ": did it end?");
}

// The one in force where none is named, so that it can be told which one was meant.
std::optional<std::uint8_t> NodeParameters::setFor(const catalogue::ParameterAccess& access) {
  if (!profile::hasSets(access.request.shape)) return std::uint8_t{0};
  if (access.request.parameter_set != 0) return access.request.parameter_set;
  const DriveStatus status = statusOnce([](const DriveStatus& told) { return told.parameter_set != 0; });
  if (status.parameter_set == 0) return std::nullopt;
  return status.parameter_set;
}

NodeParameters::Fence NodeParameters::fence() const {
  Fence fence;
  ros::param::get(node_ + "/allow_raw_parameters", fence.raw);
  SettingValue settings = SettingValue::group();
  XmlRpc::XmlRpcValue told;
  if (ros::param::get(node_ + "/" + kWritable, told)) settings.add(kWritable, numbersOf(told));
  try {
    fence.writable = readWritableParameters(TreeSettings{node_ + "/", settings});
  } catch (const ConfigError& error) {
    throw Trouble(error.what());
  }
  return fence;
}

// Refused by the node in the middle, it would take the whole restore back.
std::string NodeParameters::whyNotWritten(std::uint16_t number) const {
  if (!fence_) fence_ = fence();
  std::string raw = catalogue::whyNotRaw(catalogue::accessTo({number, 0, 0}, known()));
  if (!raw.empty() && !fence_->raw) return raw;
  return fence_->writable.refusal(number);
}

// Its terminals may have enabled it as well.
std::string NodeParameters::notAtRest() {
  const DriveStatus status = statusOnce([](const DriveStatus& told) { return told.online != 0; });
  if (!status.operation_enabled) return {};
  return "drive " + drive_.name + " is enabled, and was left as it is: disable it first";
}

// One drive that is silent is the matter of that drive: who watches several goes on with the others.
ParameterAnswer NodeParameters::silent() const {
  ParameterAnswer answer;
  answer.message = "drive " + drive_.name +
                   " does not answer, and nobody knows which of its parameter sets is in force: name one with --set";
  return answer;
}

ParameterAnswer NodeParameters::read(const catalogue::ParameterAddress& address) {
  const catalogue::ParameterAccess access = catalogue::accessTo(address, known());
  if (!access.error.empty()) throw Trouble(access.error);
  const auto set = setFor(access);
  if (!set) return silent();
  ParameterAnswer answer;
  answer.set = *set;
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

// A value goes to the node in its unit: with another file of parameters there it would be another one in the drive.
void NodeParameters::requireSameMeaning(const catalogue::ParameterAccess& access, std::uint8_t set) {
  ReadParameter service;
  service.request.number = access.request.number;
  service.request.parameter_set = set;
  if (profile::isArray(access.request.shape)) service.request.index = access.request.index;
  call(read_, service);
  if (!service.response.success) return;  // the write tells why
  const std::string unit = access.entry != nullptr ? access.entry->unitOf(access.request.index) : "";
  const double value = catalogue::valueOf(access.entry, service.response.raw, access.request.index);
  if (service.response.unit == unit && service.response.value == value) return;
  std::ostringstream text;
  text << "node " << node_ << " knows P" << access.request.number << " otherwise than this program: the raw value "
       << service.response.raw << " is " << service.response.value << " " << service.response.unit << " there and "
       << value << " " << unit << " here; give both the same parameter_files";
  throw Trouble(text.str());
}

ParameterAnswer NodeParameters::write(const catalogue::ParameterAccess& access) {
  const auto set = setFor(access);
  if (!set) return silent();
  requireSameMeaning(access, *set);
  ParameterAnswer answer;
  answer.set = *set;
  WriteParameter service;
  service.request.number = access.request.number;
  service.request.parameter_set = answer.set;
  if (profile::isArray(access.request.shape)) service.request.index = access.request.index;
  service.request.value = catalogue::valueOf(access.entry, access.request.raw, access.request.index);
  service.request.persistent = access.request.action == profile::ParameterAction::kWritePersistent;
  call(write_, service);
  answer.success = service.response.success != 0;
  answer.refused = service.response.refused != 0;
  answer.used_up = service.response.used_up != 0;
  answer.message = service.response.message;
  answer.raw = service.response.raw;
  // What stands in the answer's other fields is nothing beyond them.
  if (answer.success && answer.message == catalogue::valueSentence(access, answer.raw, known())) answer.message.clear();
  answer.value = catalogue::valueOf(access.entry, answer.raw, access.request.index);
  answer.entry = access.entry;
  return answer;
}

}  // namespace nord_driver::tools
