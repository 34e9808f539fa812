#include "nord_driver/tools/parameter_tool.h"

#include <thread>
#include <utility>

#include "nord_driver/transport/setting_checks.h"

namespace nord_driver::tools {

namespace {

constexpr Duration kPatience = std::chrono::seconds{10};

// Of the base nothing is needed, and its sizes may be in a URDF.
YAML::Node withoutBase(const YamlSettings& config) {
  YAML::Node node{YAML::NodeType::Map};
  if (const auto rate = config.number("cycle_rate")) node["cycle_rate"] = *rate;
  return node;
}

}  // namespace

std::string answerText(const cycle::ParameterAddress& address, const ParameterAnswer& answer) {
  std::string text = "P" + std::to_string(address.number);
  if (address.index != 0) text += (address.index < 10 ? "[-0" : "[-") + std::to_string(address.index) + "]";
  if (!answer.success) return text + ": " + answer.message;
  text += " = " + shortNumber(answer.value);
  if (answer.info != nullptr && answer.info->unit[0] != '\0') text += std::string(" ") + answer.info->unit;
  text += " (raw " + std::to_string(answer.raw) + ")";
  if (answer.info != nullptr) text += std::string(" ") + answer.info->name;
  if (!answer.message.empty()) text += "; " + answer.message;
  return text;
}

ParameterTool::ParameterTool(const YamlSettings& config, std::unique_ptr<Transport> transport)
    : transport_(std::move(transport)) {
  const auto group = config.group("drives");
  std::vector<DriveSettings> drives;
  for (const std::string& name : group->keys()) drives.push_back({name, group->group(name)});
  config_ = cycle::readCycleConfig(YamlSettings{"", withoutBase(config)}, drives);
  transport_->configure(*config.group("bus"), drives, config_.cycle_rate);
  ports_ = std::make_unique<cycle::CyclePorts>(drives.size());
  cycle_ = std::make_unique<cycle::BusCycle>(config_, *transport_, *ports_, false);
  thread_ = std::make_unique<cycle::CycleThread>(*cycle_, *transport_, config_.real_time);
}

ParameterTool::~ParameterTool() {
  // A drive that somebody left running has been told to stop by our first words; it comes to rest before the bus ends.
  cycle::Request request;
  request.kind = cycle::RequestKind::kShutDown;
  request.patience = config_.shutdown_timeout;
  call(request);
  thread_.reset();
  transport_->close();
}

DriveIndex ParameterTool::driveNamed(const std::string& name) const {
  std::string known;
  for (DriveIndex i = 0; i < config_.drives.size(); ++i) {
    if (config_.drives[i].name == name) return i;
    known += (known.empty() ? "" : ", ") + config_.drives[i].name;
  }
  throw ConfigError("\"" + name + "\" is not the name of a drive, expected one of " + known);
}

bool ParameterTool::waitForDrive(DriveIndex drive, Duration limit) {
  const Instant end = std::chrono::steady_clock::now() + limit;
  while (!ports_->readSnapshot().drives[drive].online) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
  return true;
}

std::string ParameterTool::trouble(DriveIndex drive) {
  const cycle::CycleSnapshot& snapshot = ports_->readSnapshot();
  if (!snapshot.bus_text.empty()) return snapshot.bus_text.str();
  const std::string text = snapshot.drives[drive].text.str();
  return "drive " + config_.drives[drive].name + ": " + (text.empty() ? "no answer" : text);
}

cycle::Completion ParameterTool::call(cycle::Request request) {
  request.id = ++last_id_;
  if (request.patience <= Duration::zero()) request.patience = kPatience;
  cycle::Completion answer;
  answer.message = "the bus cycle did not answer";
  if (!ports_->submit(request)) return answer;
  const Instant end = std::chrono::steady_clock::now() + request.patience + std::chrono::seconds{1};
  while (std::chrono::steady_clock::now() < end) {
    const auto completion = ports_->waitCompletion(std::chrono::milliseconds{100});
    if (completion && completion->id == request.id) return *completion;
  }
  return answer;
}

ParameterAnswer ParameterTool::read(DriveIndex drive, const cycle::ParameterAddress& address) {
  ParameterAnswer answer;
  cycle::Request request;
  request.drive = drive;
  answer.message = cycle::addressParameter(address, series(drive), request, answer.info);
  if (!answer.message.empty()) return answer;
  const cycle::Completion completion = call(request);
  answer.success = completion.success;
  answer.message = completion.message.str();
  answer.raw = completion.raw;
  answer.value = cycle::valueOf(answer.info, completion.raw);
  return answer;
}

ParameterAnswer ParameterTool::write(DriveIndex drive, const cycle::ParameterAddress& address,
                                     const cycle::ParameterWish& wish) {
  ParameterAnswer answer;
  cycle::Request request;
  request.drive = drive;
  answer.message = cycle::addressParameter(address, series(drive), request, answer.info);
  if (answer.message.empty()) answer.message = cycle::addValue(wish, answer.info, request);
  if (!answer.message.empty()) return answer;
  const cycle::Completion completion = call(request);
  answer.success = completion.success;
  answer.message = completion.message.str();
  answer.raw = completion.raw;
  answer.value = cycle::valueOf(answer.info, completion.raw);
  return answer;
}

}  // namespace nord_driver::tools
