#include "node/services.h"

#include <utility>

#include "catalogue/parameter_text.h"
#include "cycle/taught_position.h"
#include "node/offer.h"
#include "tools/counted_write.h"

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

// What is refused for the moment only says nothing of the parameter: it may be asked again.
bool isRefusedForGood(const cycle::Completion& answer) noexcept {
  return answer.parameter.outcome == profile::ParameterOutcome::kRefused && !mayPass(answer.parameter.reason);
}

}  // namespace

template <typename Service, typename Handler>
void Services::advertise(ros::NodeHandle& node, const std::string& name, Handler handler) {
  servers_.push_back(offer<Service>(node, name, handler));
}

Services::Services(const ServiceLanes& lanes, const NodeConfig& config, std::vector<catalogue::DriveCatalogue> known,
                   const FaultBoard& faults, std::deque<state::DriveEeprom>& eeproms, RequestBroker& broker)
    : config_(config),
      known_(std::move(known)),
      faults_(faults),
      eeproms_(eeproms),
      broker_(broker),
      stops_(config.cycle.drives.size(), config.cycle.service_timeout,
             [&broker](const cycle::Request& request) { return broker.call(request); }) {
  ros::NodeHandle& private_node = lanes.others;
  const auto addTrigger = [&](const std::string& name, RequestKind kind, DriveIndex drive) {
    const bool quick_stop = kind == RequestKind::kQuickStop;
    ros::NodeHandle& node = quick_stop ? lanes.quick_stop : private_node;
    advertise<std_srvs::Trigger>(node, name, [this, quick_stop, kind, drive, name](auto&, auto& response) {
      const cycle::Completion answer = quick_stop ? stops_.quickStop(drive) : ask(kind, drive);
      tellOutcome(name, answer);
      response.success = answer.success;
      response.message = messageOf(answer, drive);
    });
  };
  const auto addEnable = [&](const std::string& name, DriveIndex drive) {
    advertise<std_srvs::SetBool>(lanes.enable, name, [this, drive, name](auto& request, auto& response) {
      const bool on = request.data != 0;
      const cycle::Completion answer = stops_.enable(on, drive);
      tellOutcome(name + (on ? " true" : " false"), answer);
      response.success = answer.success;
      response.message = messageOf(answer, drive);
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
    if (config.cycle.drives[i].position) {
      advertise<std_srvs::Trigger>(private_node, prefix + "teach_position", [this, i, prefix](auto&, auto& response) {
        const auto read = [&](const profile::ParameterRequest& element) {
          catalogue::ParameterAccess access;
          access.request = element;
          return carryOut(i, RequestKind::kReadParameter, access);
        };
        const cycle::Completion answer =
            cycle::withTaughtElement(ask(RequestKind::kTeach, i), *config_.cycle.drives[i].position, read);
        tellOutcome(prefix + "teach_position", answer);
        response.success = answer.success;
        response.message = messageOf(answer, i);
      });
      addTrigger(prefix + "reset_position", RequestKind::kResetPosition, i);
      advertise<std_srvs::Trigger>(lanes.home, prefix + "home", [this, i, prefix](auto&, auto& response) {
        cycle::Request request;
        request.kind = RequestKind::kHome;
        request.drive = i;
        request.patience = config_.cycle.drives[i].position->axis.homing_timeout + config_.cycle.service_timeout;
        const cycle::Completion answer = broker_.call(request);
        tellOutcome(prefix + "home", answer);
        response.success = answer.success;
        response.message = messageOf(answer, i);
      });
    }
    advertise<SelectParameterSet>(private_node, prefix + "select_parameter_set",
                                  [this, i](auto& request, auto& response) { selectSet(i, request, response); });
    advertise<WriteParameter>(private_node, prefix + "write_parameter",
                              [this, i](auto& request, auto& response) { writeParameter(i, request, response); });
    advertise<ReadParameter>(private_node, prefix + "read_parameter",
                             [this, i](auto& request, auto& response) { readParameter(i, request, response); });
  }
}

std::string Services::messageOf(const cycle::Completion& answer, DriveIndex drive) const {
  const std::string faults = answer.success ? "" : faults_.text(drive);
  return answer.message.str() + (faults.empty() ? "" : "; " + faults);
}

cycle::Completion Services::ask(RequestKind kind, DriveIndex drive) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.patience = config_.cycle.service_timeout;
  // What runs for a time of its own is waited for until it tells how it ended.
  const bool sets_up = kind == RequestKind::kTeach || kind == RequestKind::kResetPosition;
  if (sets_up) request.patience += config_.cycle.setupTimeout(config_.cycle.drives[drive]);
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

cycle::Completion Services::carryOut(DriveIndex drive, RequestKind kind, const catalogue::ParameterAccess& access) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.patience = config_.cycle.service_timeout;
  request.parameter = access.request;
  return broker_.call(request);
}

void Services::readParameter(DriveIndex drive, ReadParameter::Request& request, ReadParameter::Response& response) {
  const catalogue::ParameterAccess access =
      catalogue::accessTo({request.number, request.parameter_set, request.index}, known_[drive]);
  response.message = access.error;
  response.refused = !response.message.empty();
  if (response.refused) return;
  const cycle::Completion answer = carryOut(drive, RequestKind::kReadParameter, access);
  response.success = answer.success;
  response.message = answer.message.str();
  response.refused = isRefusedForGood(answer);
  response.unknown = response.refused && answer.parameter.refused_number == access.request.number &&
                     answer.parameter.reason == profile::ParameterReason::kNoSuchParameter;
  if (!answer.success) return;
  response.raw = answer.parameter.raw;
  response.value = catalogue::valueOf(access.entry, answer.parameter.raw, access.request.index);
  if (access.entry != nullptr) {
    response.unit = access.entry->unitOf(access.request.index);
    response.name = access.entry->title();
  }
  if (response.message.empty()) response.message = catalogue::valueSentence(access, response.raw, known_[drive]);
}

void Services::writeParameter(DriveIndex drive, WriteParameter::Request& request, WriteParameter::Response& response) {
  catalogue::ParameterAccess access =
      catalogue::accessTo({request.number, request.parameter_set, request.index}, known_[drive]);
  response.message = access.error;
  if (response.message.empty()) {
    response.message =
        catalogue::setValue(access, {request.value, request.persistent != 0, config_.allow_raw_parameters});
  }
  if (response.message.empty()) response.message = config_.writable_parameters.refusal(request.number);
  response.refused = !response.message.empty();
  if (response.refused) return;
  const tools::CountedWrite write = tools::countedWrite(
      eeproms_[drive], access.request, [&] { return carryOut(drive, RequestKind::kWriteParameter, access); });
  response.message = write.refusal;
  response.refused = response.used_up = !response.message.empty();
  if (response.refused) return;
  if (!write.note.empty()) ROS_WARN("nord_driver: %s", write.note.c_str());
  const cycle::Completion& answer = *write.completion;  // the broker always has one
  response.success = answer.success;
  response.message = answer.message.str();
  response.refused = isRefusedForGood(answer);
  response.raw = answer.parameter.raw;
  response.value = catalogue::valueOf(access.entry, answer.parameter.raw, access.request.index);
  if (answer.success && response.message.empty())
    response.message = catalogue::valueSentence(access, response.raw, known_[drive]);
}

}  // namespace nord_driver::node
