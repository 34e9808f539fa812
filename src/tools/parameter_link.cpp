#include "tools/parameter_link.h"

#include <algorithm>
#include <cmath>

#include "config/driver_settings.h"
#include "config/setting_checks.h"
#include "cycle/drive_parameters.h"
#include "profile/parameter_shape.h"
#include "tools/counted_write.h"

namespace nord_driver::tools {

using profile::DriveState;
using profile::ParameterOutcome;

namespace {

constexpr int kCyclesToEndOrders = 5;  // "no order" has reached the inverter (BU 2700 6.5: none is left standing)
constexpr Duration kReadyTime = std::chrono::seconds{1};
constexpr Duration kPatience = std::chrono::seconds{20};  // every step of an access has its own, shorter one
constexpr int kAttempts = 3;
constexpr Duration kQuietTime = std::chrono::seconds{3};  // a check for a MAC id alone takes more than two
constexpr Duration kBackTime = std::chrono::seconds{2};   // a silent station is asked for more often than that
constexpr std::uint16_t kFullFrequency = 105, kTelegramTimeout = 513, kModuleTimeout = 151;

}  // namespace

ParameterLink::ParameterLink(const ToolConfig& config, Transport& transport, const catalogue::Catalogues& catalogues)
    : config_(config), transport_(transport), budget_(eepromBudget(config.eeprom)), ports_(config.drives.size()) {
  if (!transport.serveParametersOnly()) {
    throw Trouble("transport " + config.transport +
                  " does not serve a program for parameters only, and its start-up might stop a drive that runs: ask "
                  "the driver (~<drive>/read_parameter)");
  }
  transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
  listening_ = seconds(transport.identity(0).protection_time);
  for (DriveIndex i = 0; i < config.asked; ++i) {
    known_.push_back(catalogue::driveCatalogue(catalogues, config.cycle.drives[i].series,
                                               shortTransportName(config.transport),
                                               identity(i).timeout_owner == TimeoutOwner::kModule));
  }
  const std::string end_point =
      transport.endPoint().isNone() ? "" : config.bus->text(transport.endPoint().key).value_or("");
  eeprom_.emplace(budget_, placeOf(end_point, shortTransportName(config.transport), config.drives.front()),
                  drive().name, transport.parameterCapabilities(0).ram_writes);
  cycle_.emplace(config.cycle, transport, ports_, false, cycle::CycleRole::kGuest);
}

ParameterLink::~ParameterLink() {
  transport_.close();
}

DriveIndex ParameterLink::silent() const {
  DriveIndex silent = 0;
  while (silent + 1 < config_.asked && cycle_->gate().hears(silent)) ++silent;
  return silent;
}

std::string ParameterLink::whySilent() const {
  const std::string bus = transport_.busText().str();
  const std::string why = !bus.empty() && !transport_.connected() ? bus : note(silent());
  return (why.empty() ? "" : ": ") + why;
}

std::string ParameterLink::silence() const {
  std::string bus = transport_.busText().str();
  if (!bus.empty() && !transport_.connected()) return bus;
  return "drive " + name(silent()) + " (" + identity(silent()).address + ") does not answer" + whySilent();
}

void ParameterLink::refuseRunning() const {
  const auto& running = cycle_->gate().running();
  if (!running) return;
  throw Trouble("drive " + config_.cycle.drives[running->drive].name + " is not at rest (" +
                profile::toString(running->state) + "): it was left as it is; disable it first");
}

void ParameterLink::connect(Duration limit, const std::atomic<bool>& end_asked,
                            const std::function<void(const std::string&)>& tell) {
  const Instant begun = transport_.now();
  const Instant end = begun + listening_ + limit;
  bool told = !tell;
  cycle_->closeGate(config_.asked, config_.reaches_others);
  while (!cycle_->gate().isOpen()) {
    exchange();
    refuseRunning();
    if (end_asked) throw Trouble("ended before drive " + name(silent()) + " answered" + whySilent());
    if (!cycle_->gate().heard() && transport_.now() >= end) throw Trouble(silence());
    if (told || transport_.now() - begun < kQuietTime) continue;
    told = true;
    tell("waiting for drive " + name(silent()) + " (" + identity(silent()).address + "), at most " +
         shortNumber(std::ceil(toSeconds(end - transport_.now()))) + " s more" + whySilent());
  }
  connected_ = true;
  // Some parameters are written to a drive only that is seen at rest.
  const Instant ready = transport_.now() + kReadyTime;
  do {
    exchange();
  } while (snapshot().state != DriveState::kReadyToSwitchOn && transport_.now() < ready);
  if (!snapshot().online) throw Trouble(silence());
}

void ParameterLink::exchange() noexcept {
  const Instant start = transport_.now();
  cycle_->runOnce();
  transport_.sleepUntil(start + cycle_->period());
}

void ParameterLink::idle(int cycles) noexcept {
  for (int i = 0; i < cycles; ++i) exchange();
}

void ParameterLink::pass(Duration time) noexcept {
  const Instant end = transport_.now() + time;
  do {
    exchange();
  } while (transport_.now() < end);
}

ParameterAnswer ParameterLink::read(const catalogue::ParameterAddress& address) {
  const catalogue::ParameterAccess access = catalogue::accessTo(address, known());
  if (!access.error.empty()) throw Trouble(access.error);
  return carryOut(access, cycle::RequestKind::kReadParameter, 0, kAttempts);
}

ParameterAnswer ParameterLink::read(DriveIndex drive, const catalogue::ParameterAddress& address) {
  const catalogue::ParameterAccess access = catalogue::accessTo(address, known(drive));
  if (!access.error.empty()) throw Trouble(access.error);
  return carryOut(access, cycle::RequestKind::kReadParameter, drive, 1);
}

void ParameterLink::exchangeUntil(Instant when, const std::atomic<bool>& end_asked) {
  while (!end_asked && transport_.now() < when) {
    exchange();
    refuseRunning();
  }
}

ParameterAnswer ParameterLink::write(const catalogue::ParameterAccess& access) {
  ParameterAnswer forbidden;
  forbidden.message = whyNotWritten(access.request.number);
  forbidden.refused = !forbidden.message.empty();
  if (forbidden.refused) return forbidden;
  cycle::Request request;
  request.kind = cycle::RequestKind::kWriteParameter;
  request.parameter = access.request;
  // The terminals may turn a drive under local control at any time; setpoints are a share of P105.
  if (cycle::decidesMotion(request) && !cycle_->isAtRest(0)) {
    throw Trouble("P" + std::to_string(access.request.number) + " decides how the motor follows setpoints, and drive " +
                  drive().name + " is not at rest");
  }
  if (std::string unknown = notAtRest(); cycle::decidesMotion(request) && !unknown.empty()) throw Trouble(unknown);
  return carryOut(access, cycle::RequestKind::kWriteParameter, 0, kAttempts);
}

std::optional<cycle::Completion> ParameterLink::run(cycle::Request& request) {
  request.id = ++last_id_;
  // The same set at each attempt, and told in the answer.
  if (request.parameter.parameter_set == 0) request.parameter.parameter_set = snapshot(request.drive).parameter_set;
  if (!ports_.submit(request)) return std::nullopt;
  const Instant end = transport_.now() + kPatience;
  do {
    exchange();
    while (const auto completion = ports_.waitCompletion(Duration::zero())) {
      if (completion->id == request.id) return completion;
    }
  } while (transport_.now() < end);
  return std::nullopt;
}

bool ParameterLink::waitForDrive() {
  const Instant end = transport_.now() + listening_ + kBackTime;
  do {
    exchange();
    if (snapshot().online) return true;
    refuseRunning();
  } while (transport_.now() < end);
  return false;
}

// A write compares first, so that it is not done twice.
std::optional<cycle::Completion> ParameterLink::runAndRepeat(cycle::Request& request, int attempts) {
  std::optional<cycle::Completion> completion = run(request);
  for (int i = 1; i < attempts && completion && completion->parameter.outcome == ParameterOutcome::kOffline; ++i) {
    if (completion->parameter.eeprom_written || !waitForDrive()) break;
    completion = run(request);
  }
  return completion;
}

ParameterAnswer ParameterLink::carryOut(const catalogue::ParameterAccess& access, cycle::RequestKind kind,
                                        DriveIndex drive, int attempts) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.parameter = access.request;
  request.parameter.even_if_same = true;  // the run before may have put it into the RAM
  std::optional<cycle::Completion> completion;
  std::string note;
  if (kind == cycle::RequestKind::kReadParameter) {
    // Nothing is commanded that another scale would change, and nobody else reads P105 for a guest: a profile in rpm
    // could tell no frequency without it.
    request.parameter.scales = access.request.number == kFullFrequency;
    completion = runAndRepeat(request, attempts);
    if (request.parameter.scales) exchange();  // what came in the last cycle was told by the scale before
  } else {
    CountedWrite counted = countedWrite(*eeprom_, request.parameter, [&] { return runAndRepeat(request, attempts); });
    if (!counted.refusal.empty()) {
      ParameterAnswer refused;
      refused.refused = true;
      refused.used_up = true;
      refused.message = counted.refusal;
      return refused;
    }
    completion = counted.completion;
    note = counted.note;
  }
  if (!completion) throw Trouble("drive " + name(drive) + " did not carry the access out");

  const profile::ParameterResult& result = completion->parameter;
  ParameterAnswer answer;
  answer.success = completion->success;
  // What has cost EEPROM cycles is not to be asked again: it counts as not answered.
  const bool passing = mayPass(result.reason);
  answer.refused = result.outcome == ParameterOutcome::kRefused && !(passing && result.eeprom_written);
  answer.unknown = answer.refused && result.refused_number == access.request.number &&
                   result.reason == profile::ParameterReason::kNoSuchParameter;
  answer.passing = answer.refused && passing;
  answer.message = completion->message.str();
  if (!note.empty()) answer.message += (answer.message.empty() ? "" : "; ") + note;
  answer.raw = result.raw;
  answer.value = catalogue::valueOf(access.entry, result.raw, access.request.index);
  answer.entry = access.entry;
  answer.set = profile::hasSets(access.request.shape) ? request.parameter.parameter_set : std::uint8_t{0};
  return answer;
}

bool ParameterLink::isStateKnown(DriveIndex drive) {
  return identity(drive).tells_words || snapshot(drive).state != DriveState::kNotReadyToSwitchOn;
}

// That it is not known whether it turns is enough.
std::string ParameterLink::notAtRest() {
  if (!snapshot().online || isStateKnown(0)) return {};
  return "whether drive " + drive().name +
         " is at rest is not known: its bus module does not tell the state (class 41); ask the driver's node instead";
}

bool ParameterLink::sendsWords(DriveIndex drive) const {
  const DriveIdentity found = identity(drive);
  return found.sends_words && found.process_values > 0;
}

std::string ParameterLink::changedByReading() {
  return changedByReading(0);
}

std::string ParameterLink::changedByReading(DriveIndex drive) {
  if (!sendsWords(drive) || !cycle_->gate().faultSeen(drive)) return {};
  if (!snapshot(drive).online || snapshot(drive).fault) return {};
  return "drive " + name(drive) +
         " was in fault when this program came: its idle word 047E took the enable away, which acknowledges a fault "
         "whose cause is gone";
}

std::vector<std::string> ParameterLink::finish() {
  std::vector<std::string> sentences;
  if (!connected_) return sentences;
  for (DriveIndex i = 0; i < config_.asked; ++i) {
    ParameterAnswer answer;
    if (snapshot(i).online) {
      catalogue::ParameterAddress timeout;
      timeout.number = identity(i).timeout_owner == TimeoutOwner::kModule ? kModuleTimeout : kTelegramTimeout;
      // Any further access also tries again to put P560 back.
      answer = i == 0 ? read(timeout) : read(i, timeout);
    }
    if (sendsWords(i) && answer.success && answer.entry != nullptr && answer.value > 0.0) {
      sentences.push_back("drive " + name(i) + " has P" + std::to_string(answer.entry->number) + " = " +
                          shortNumber(answer.value) +
                          " s: that long after this it trips (E10.x), because nobody sends it words any more; "
                          "acknowledge it before it is enabled");
    }
    if (snapshot(i).owes_eeprom_switch) {
      sentences.push_back("P560 of drive " + name(i) +
                          " is 0 and could not be put back to 1: it saves nothing in its EEPROM until it is");
    }
  }
  idle(kCyclesToEndOrders);
  transport_.close();
  connected_ = false;
  return sentences;
}

}  // namespace nord_driver::tools
