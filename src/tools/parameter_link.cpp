#include "tools/parameter_link.h"

#include "config/setting_checks.h"
#include "cycle/drive_parameters.h"
#include "cycle/user_messages.h"
#include "profile/pkw.h"
#include "profile/status_word.h"

namespace nord_driver::tools {

using profile::DriveState;
using profile::ParameterOutcome;

namespace {

constexpr int kCyclesToSeeAll = 3;     // inverters behind one module do not answer in the same cycle
constexpr int kCyclesToEndOrders = 5;  // "no order" has reached the inverter (BU 2700 6.5: none is left standing)
constexpr Duration kReadyTime = std::chrono::seconds{1};
constexpr Duration kPatience = std::chrono::seconds{20};  // every step of an access has its own, shorter one
constexpr int kAttempts = 3;
constexpr Duration kBackTime = std::chrono::seconds{2};  // a silent station is asked for more often than that
constexpr std::uint16_t kTelegramTimeout = 513, kModuleTimeout = 151;

bool isAtRest(DriveState state) noexcept {
  return state == DriveState::kNotReadyToSwitchOn || state == DriveState::kSwitchOnDisabled ||
         state == DriveState::kReadyToSwitchOn || state == DriveState::kFault;
}

bool hasSets(profile::ParameterShape shape) noexcept {
  return shape == profile::ParameterShape::kPerSet || shape == profile::ParameterShape::kArrayPerSet;
}

}  // namespace

ParameterLink::ParameterLink(const ToolConfig& config, Transport& transport)
    : config_(config), transport_(transport), outputs_(config.drives.size()), inputs_(config.drives.size()) {
  if (!transport.serveParametersOnly()) {
    throw Trouble("transport " + config.transport +
                  " does not serve a program for parameters only, and its start-up might stop a drive that runs: ask "
                  "the driver (~<drive>/read_parameter)");
  }
  transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
  for (const cycle::DriveSetup& setup : config.cycle.drives) drives_.emplace_back(setup.drive);
}

ParameterLink::~ParameterLink() {
  transport_.close();
}

std::string ParameterLink::silence() const {
  std::string bus = transport_.busText().str();
  if (!bus.empty() && !transport_.connected()) return bus;
  const std::string note = transport_.note(0).text;
  return "drive " + drive().name + " (" + transport_.identity(0).address + ") does not answer" +
         (note.empty() ? "" : ": " + note);
}

void ParameterLink::refuseRunning() const {
  for (DriveIndex i = 0; i < inputs_.size(); ++i) {
    if (!inputs_[i].inverter_answers) continue;
    const DriveState state = profile::StatusWord{inputs_[i].input.status_word}.state();
    if (isAtRest(state)) continue;
    throw Trouble("drive " + config_.cycle.drives[i].name + " is not at rest (" + profile::toString(state) +
                  "): it was left as it is; disable it first");
  }
}

void ParameterLink::connect(Duration limit, const std::atomic<bool>& end_asked) {
  const Instant end = transport_.now() + limit;
  // The default of an output is 0000.
  for (int seen = 0; seen < kCyclesToSeeAll;) {
    const Instant start = transport_.now();
    transport_.exchange(outputs_, inputs_);
    if (inputs_[0].inverter_answers) ++seen;
    refuseRunning();
    if (end_asked) throw Trouble("ended before drive " + drive().name + " answered");
    if (seen == 0 && transport_.now() >= end) throw Trouble(silence());
    transport_.sleepUntil(start + config_.cycle.period());
  }
  connected_ = true;
  // Some parameters are written to a drive only that is seen at rest.
  const Instant ready = transport_.now() + kReadyTime;
  do {
    exchange();
  } while (drives_[0].report().state != DriveState::kReadyToSwitchOn && transport_.now() < ready);
  if (!drives_[0].report().online) throw Trouble(silence());
}

void ParameterLink::exchange() noexcept {
  const Instant start = transport_.now();
  for (DriveIndex i = 0; i < drives_.size(); ++i) outputs_[i] = drives_[i].pollOutput(start);
  transport_.exchange(outputs_, inputs_);
  const Instant after = transport_.now();
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].handleInput(inputs_[i].input, inputs_[i].inverter_answers, after);
  }
  runSession();
  transport_.sleepUntil(start + config_.cycle.period());
}

void ParameterLink::runSession() noexcept {
  while (const auto result = transport_.pollResult()) {
    if (open_id_ == 0 || result->id != open_id_) continue;
    open_id_ = 0;
    session_.handleResult(*result);
  }
  if (!drives_[0].report().online) {
    open_id_ = 0;
    session_.handleOffline();
    return;
  }
  auto request = session_.pollRequest();
  if (!request) return;
  request->id = open_id_ = ++last_id_;
  if (transport_.submit(0, *request)) return;
  profile::ParameterResult busy;
  busy.outcome = ParameterOutcome::kBusy;
  open_id_ = 0;
  session_.handleResult(busy);
}

void ParameterLink::idle(int cycles) noexcept {
  for (int i = 0; i < cycles; ++i) exchange();
}

ParameterAnswer ParameterLink::read(const cycle::ParameterAddress& address) {
  cycle::Request request;
  const profile::ParameterInfo* info = nullptr;
  const std::string wrong = cycle::addressParameter(address, drive().series, request, info);
  if (!wrong.empty()) throw Trouble(wrong);
  return carryOut(request, info);
}

ParameterAnswer ParameterLink::write(const cycle::ParameterAddress& address, const cycle::ParameterWrite& write) {
  cycle::Request request;
  const profile::ParameterInfo* info = nullptr;
  std::string wrong = cycle::addressParameter(address, drive().series, request, info);
  if (wrong.empty()) wrong = cycle::addValue(write, info, request);
  if (!wrong.empty()) throw Trouble(wrong);
  // The terminals may turn a drive under local control at any time; setpoints are a share of P105.
  if (cycle::decidesMotion(request) && !drives_[0].isAtRest()) {
    throw Trouble("P" + std::to_string(address.number) + " decides how the motor follows setpoints, and drive " +
                  drive().name + " is not at rest");
  }
  return carryOut(request, info);
}

std::optional<drive::ParameterTaskResult> ParameterLink::run(const drive::ParameterTask& task) noexcept {
  if (!session_.submit(task)) return std::nullopt;
  const Instant end = transport_.now() + kPatience;
  do {
    exchange();
    if (const auto result = session_.pollResult()) return result;
  } while (transport_.now() < end);
  return std::nullopt;
}

bool ParameterLink::waitForDrive() noexcept {
  const Instant end = transport_.now() + kBackTime;
  do {
    exchange();
    if (inputs_[0].inverter_answers) return true;
  } while (transport_.now() < end);
  return false;
}

ParameterAnswer ParameterLink::carryOut(const cycle::Request& request, const profile::ParameterInfo* info) {
  drive::ParameterTask task = cycle::taskOf(request, drives_[0].report().parameter_set);
  task.id = ++last_id_;
  task.even_if_same = true;  // the run before may have put it into the RAM
  std::optional<drive::ParameterTaskResult> result = run(task);
  // Nothing but the line was lost: a write compares first, so that it is not done twice.
  for (int i = 1; i < kAttempts && result && result->outcome == ParameterOutcome::kOffline; ++i) {
    if (result->eeprom_written || !waitForDrive()) break;
    result = run(task);
  }
  if (!result) throw Trouble("drive " + drive().name + " did not carry the access out");

  ParameterAnswer answer;
  answer.success = result->outcome == ParameterOutcome::kDone;
  answer.refused = result->outcome == ParameterOutcome::kRefused;
  answer.unknown = answer.refused && result->refused_number == task.number &&
                   result->error_number == profile::pkw_error::kInvalidNumber;
  answer.message = cycle::parameterMessage(drive().name.c_str(), task.number, *result).str();
  answer.raw = result->raw;
  answer.value = cycle::valueOf(info, result->raw);
  answer.info = info;
  answer.set = hasSets(task.shape) ? task.set : std::uint8_t{0};
  return answer;
}

std::vector<std::string> ParameterLink::finish() {
  std::vector<std::string> sentences;
  if (!connected_) return sentences;
  ParameterAnswer answer;
  if (drives_[0].report().online) {
    cycle::ParameterAddress timeout;
    timeout.number = identity().timeout_owner == TimeoutOwner::kModule ? kModuleTimeout : kTelegramTimeout;
    // Any further access also tries again to put P560 back.
    answer = read(timeout);
  }
  if (answer.success && answer.info != nullptr && answer.value > 0.0) {
    sentences.push_back("drive " + drive().name + " has P" + std::to_string(answer.info->number) + " = " +
                        shortNumber(answer.value) +
                        " s: that long after this it trips (E10.x), because nobody sends it words any more; "
                        "acknowledge it before it is enabled");
  }
  if (session_.owesEepromSwitch()) {
    sentences.push_back("P560 of drive " + drive().name +
                        " is 0 and could not be put back to 1: it saves nothing in its EEPROM until it is");
  }
  idle(kCyclesToEndOrders);
  transport_.close();
  connected_ = false;
  return sentences;
}

}  // namespace nord_driver::tools
