#include "transport/devicenet/devicenet.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "config/setting_checks.h"
#include "profile/control_word.h"
#include "transport/addresses_asked.h"
#include "transport/devicenet/assembly.h"
#include "transport/devicenet/devicenet_bus_events.h"
#include "transport/devicenet/devicenet_counters.h"
#include "transport/devicenet/devicenet_frame_text.h"
#include "transport/devicenet/devicenet_listening.h"
#include "transport/devicenet/devicenet_scanner.h"

namespace nord_driver {

namespace {

constexpr Duration kLongestRelease = std::chrono::milliseconds{500};
constexpr Duration kListenFirst = std::chrono::milliseconds{500};  // a scanner polls more often than that
constexpr Duration kFirstAnswers = std::chrono::seconds{1};        // of modules that are there

const char* stateText(link::CanState state) noexcept {
  return state == link::CanState::kBusOff ? "the controller is bus-off" : "the interface is down";
}

// Any stop, also the word 0000, lacks one of them.
bool letsMove(Word control_word) noexcept {
  using namespace profile::control_bit;
  constexpr Word kAll = kOn | kEnableVoltage | kNoQuickStop | kEnableOperation | kDataValid;
  return (control_word & kAll) == kAll;
}

}  // namespace

void DeviceNetTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readDevicenetConfig(bus, drives, cycle_rate);
  const Duration period = seconds(1.0 / cycle_rate);
  if (parametersOnly()) {
    for (devicenet::NodeConfig& node : config_.scanner.nodes) node.io.kind = devicenet::IoKind::kNone;
  }
  scanner_.emplace(config_.scanner);
  drives_.clear();
  drives_.reserve(config_.drives.size());
  for (const DevicenetDrive& drive : config_.drives) {
    drives_.emplace_back(drive, config_.scanner.nodes[drive.module].io, period,
                         static_cast<std::uint16_t>(drives_.size()), parametersOnly());
  }
  outputs_.assign(config_.modules.size(), {});
  answered_.assign(drives_.size(), 0);
  given_.assign(drives_.size(), {});
  Setup setup;
  setup.link = {config_.interface, scanner_->receivedIds(), config_.bit_rate};
  setup.period = period;
  setup.answer_window = config_.answer_window;
  setup.longest_release = kLongestRelease;
  setup.describe = DevicenetFrameText{config_};
  if (parametersOnly()) setup.listen.emplace(kDevicenetListening, kListenFirst);
  prepare(bus, std::move(setup), *scanner_);
}

// Who has been off the bus checks its MAC id again.
void DeviceNetTransport::handleController(bool works) noexcept {
  if (works) return restart();
  Sentence why;
  why.format("%s: %s", config_.interface.c_str(),
             link().isOpen() ? stateText(link().state()) : "the interface is gone");
  scanner_->handleBusLost(why, now());
}

void DeviceNetTransport::handleGone() noexcept {
  watchController();
  restartDrives();
}

void DeviceNetTransport::restartDrives() noexcept {
  online_at_.reset();
  for (DevicenetDriveState& drive : drives_) drive.handleRestart();
}

bool DeviceNetTransport::busWorks() const noexcept {
  return linkWorks() && scanner_->busState() == devicenet::BusState::kOnline && !isSilent();
}

// A word that stops, or the first steps of a ramp to rest.
bool DeviceNetTransport::isUrgent(const profile::ProcessOutput& before, const profile::ProcessOutput& now) noexcept {
  return now.control_word != before.control_word ||
         std::abs(int{now.setpoints[0]}) < std::abs(int{before.setpoints[0]});
}

void DeviceNetTransport::putOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    // All 0, the module's own byte too: its outputs stay off, and an inverter nobody drives ignores its words.
    outputs_[i].clear();
    outputs_[i].resize(config_.scanner.nodes[i].io.output_bytes);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].putOutput(outputs[i], *scanner_, outputs_[config_.drives[i].module]);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) putModuleOutputs(config_.drives[i].module, outputs[i].module_outputs);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (holdsBack(config_.modules[i])) continue;
    scanner_->setOutput(i, outputs_[i]);
    const std::vector<std::size_t>& behind = config_.modules[i].drives;
    scanner_->setMoves(i, std::any_of(behind.begin(), behind.end(),
                                      [&outputs](std::size_t drive) { return letsMove(outputs[drive].control_word); }));
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (isUrgent(given_[i], outputs[i])) scanner_->hurry(config_.drives[i].module);
    given_[i] = outputs[i];
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) answered_[i] = scanner_->input(config_.drives[i].module).count;
}

bool DeviceNetTransport::holdsBack(const DevicenetModule& module) const noexcept {
  return std::any_of(module.drives.begin(), module.drives.end(),
                     [this](std::size_t drive) { return drives_[drive].holdsBack(*scanner_); });
}

// Instance 100 and its like: bits 0 and 1 of the first byte (BU 0280 4.2.4).
void DeviceNetTransport::putModuleOutputs(std::size_t module, std::uint8_t bits) noexcept {
  constexpr unsigned kOutputs = 0x03;
  if (!config_.modules[module].output_byte || outputs_[module].empty()) return;
  outputs_[module][0] = static_cast<std::uint8_t>(outputs_[module][0] | (bits & kOutputs));
}

void DeviceNetTransport::takeInputs(Instant now, std::vector<DriveExchange>& inputs) noexcept {
  const bool works = busWorks();
  constexpr unsigned kInputs = 0x0F;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].takeInput(*scanner_, works, now, inputs[i]);
    const std::size_t module = config_.drives[i].module;
    const devicenet::IoInput& data = scanner_->input(module);
    if (!inputs[i].module_answers || !config_.modules[module].input_byte || data.bytes.empty()) continue;
    inputs[i].module_inputs = static_cast<std::uint8_t>(data.bytes[0] & kInputs);
  }
}

bool DeviceNetTransport::allAnswered() const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!drives_[i].answered(*scanner_, answered_[i])) return false;
  }
  return true;
}

void DeviceNetTransport::runRequests(Instant now) noexcept {
  while (const auto answer = scanner_->pollAnswer()) {
    constexpr unsigned kProbes = DevicenetDriveState::kProbeTag | DevicenetDriveState::kMotorTag;
    const std::size_t drive = DevicenetParameters::tagOf(answer->answer.id) & ~kProbes;
    if (drive >= drives_.size()) continue;
    drives_[drive].handleAnswer(answer->answer, now);
    const auto finding = drives_[drive].takeFinding();
    if (!finding) continue;
    Sentence text;
    text.format("drive %.60s: %.180s", config_.drives[drive].name.c_str(), finding->c_str());
    events().warn(text, now, false);
  }
  if (!busWorks()) return;
  for (DevicenetDriveState& drive : drives_) drive.runRequests(*scanner_, now);
}

void DeviceNetTransport::takeEvents() noexcept {
  while (const auto event = scanner_->pollEvent()) {
    if (event->kind == devicenet::DevicenetEventKind::kSecondScanner) noteMaster(event->value, event->at);
    if (event->kind == devicenet::DevicenetEventKind::kOnline) online_at_ = event->at;
    const bool of_a_node = event->node != devicenet::kNoNode;
    takeEvent(*event, of_a_node ? config_.modules[event->node].mac : 0u, events());
  }
}

std::vector<std::string> DeviceNetTransport::warnings() const {
  std::vector<std::string> sentences = config_.warnings;
  for (const DevicenetDrive& drive : config_.drives) {
    if (drive.connection == DevicenetConnection::kOption) {
      sentences.push_back("drive " + drive.name +
                          ": SK TU1/2/3-DEV is experimental, no manual we have lists its objects; "
                          "they are taken to be those of SK CU4-DEV");
    }
    if (drive.drive_profile != DevicenetProfile::kNord) {
      sentences.push_back(
          "drive " + drive.name +
          ": the AC drive profile does not tell whether the bus has control, bus_control is what the "
          "driver itself commands (BU 0280 4.2.3.1): an inverter that obeys its terminals or keypad is not "
          "recognized; check P509 and P510");
    }
    if (drive.drive_profile == DevicenetProfile::kAcDrive) {
      sentences.push_back("drive " + drive.name +
                          ": the AC drive profile of assembly 20/70 has no reverse: where one is commanded the motor "
                          "stands still, and a base as a whole; 21/71 (P160 = 2) and 100/110 (P160 = 3) have it");
    }
  }
  return sentences;
}

bool DeviceNetTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  return drives_[drive].submit(request);
}

bool DeviceNetTransport::connected() const noexcept {
  return busWorks() && std::any_of(drives_.begin(), drives_.end(),
                                   [](const DevicenetDriveState& drive) { return drive.moduleAnswers(); });
}

BusCounters DeviceNetTransport::counters() const noexcept {
  return devicenetCounters(*scanner_, line());
}

DriveNote DeviceNetTransport::note(DriveIndex drive) const noexcept {
  if (const char* note = linkNote(); *note != '\0') return {note};
  switch (scanner_->busState()) {
    case devicenet::BusState::kCheckingMac:
      return {"the duplicate-MAC check of this computer takes two seconds"};
    case devicenet::BusState::kCommunicationFault:
      return {"communication fault: another device has this computer's MAC id"};
    default:
      return {drives_[drive].note()};
  }
}

std::uint32_t DeviceNetTransport::identNumber(DriveIndex drive) const noexcept {
  const devicenet::NodeStatus& status = scanner_->status(config_.drives[drive].module);
  return std::uint32_t{status.vendor_id} << 16 | status.product_code;
}

// No device is connected. One that answers all the same says why, and that is no matter of wires; nor is one that is not
// asked.
Sentence DeviceNetTransport::silenceText() const noexcept {
  Sentence text;
  for (std::size_t i = 0; i < config_.modules.size(); ++i) {
    const devicenet::NodeStatus& status = scanner_->status(i);
    const bool not_asked = status.state == devicenet::NodeState::kAbsent && scanner_->isLeftAlone(i);
    if (status.state != devicenet::NodeState::kRefused && !not_asked) continue;
    text.format("MAC id %u %.220s", unsigned{config_.modules[i].mac}, status.reason.c_str());
    return text;
  }
  if (!online_at_ || now() - *online_at_ < kFirstAnswers) {
    text.format("%s is open, and the modules are asked for the first time", config_.interface.c_str());
    return text;
  }
  const auto asked =
      addressesAsked(config_.modules.size(), [this](std::size_t module) { return config_.modules[module].mac; });
  text.format(
      "%s is open, but no device answers (asked: %s): are the modules and the bus powered (24 V), do MAC ids and bit "
      "rate agree with their switches, are the two ends of the bus terminated? nord_param scan finds who is there",
      config_.interface.c_str(), asked.c_str());
  return text;
}

Sentence DeviceNetTransport::busText() const noexcept {
  Sentence text = linkText();
  if (!text.empty()) return text;
  if (!scanner_->busReason().empty()) return scanner_->busReason();
  if (scanner_->busState() == devicenet::BusState::kCheckingMac) {
    text.format("checks for two seconds that no other device has our MAC id %u", unsigned{config_.scanner.mac});
    return text;
  }
  if (!connected() && !events().isExplained(now())) return silenceText();
  return events().text(now());
}

// As the module has answered its rate, once it has.
Duration DeviceNetTransport::longestPause(std::size_t module) const noexcept {
  const Duration configured = config_.modules[module].longest_pause;
  const Duration answered = scanner_->status(module).packet_rate;
  return configured > Duration::zero() && answered > Duration::zero() ? answered : configured;
}

DriveIdentity DeviceNetTransport::identity(DriveIndex drive) const {
  const DevicenetDrive& config = config_.drives[drive];
  const devicenet::IoConfig& io = config_.scanner.nodes[config.module].io;
  const bool gateway = config.connection == DevicenetConnection::kGateway;
  DriveIdentity identity;
  identity.address = "DeviceNet MAC id " + std::to_string(config.mac);
  if (gateway) identity.address += ", inverter " + std::to_string(config.inverter);
  if (config.drive_profile != DevicenetProfile::kNord) {
    identity.address += ", AC drive profile";
    identity.nord_profile = false;
    identity.parameter_sets = 1;
    identity.has_quick_stop = false;
  }
  identity.reverses = config.drive_profile != DevicenetProfile::kAcDrive;
  identity.process_values = config.processValues();
  identity.parameter_channel = "explicit messages";
  identity.longest_pause = toSeconds(longestPause(config.module));
  identity.module_saves = true;
  identity.sends_words = identity.tells_words = !parametersOnly();
  // NetCtrl and NetRef (BU 0280 4.2.3.1), which assembly 20 does not have.
  identity.sources_by_telegram = config.drive_profile == DevicenetProfile::kAcDriveExtended;
  identity.module_io = config_.modules[config.module].output_byte && config_.modules[config.module].input_byte;
  const Duration rate = io.expected_packet_rate.value_or(Duration::zero());
  if (parametersOnly()) {
    identity.protection_time = toSeconds(devicenet::longestOwnTimeOut(rate));
  } else {
    identity.protection_time = toSeconds(devicenet::kRatesUntilTimeout * rate);
    identity.protected_by =
        "DeviceNet time-out of " + shortNumber(identity.protection_time) +
        " s, four times the expected packet rate, which the module may round up: the inverter trips " +
        (gateway ? "E10.2" : "E10") + " and the motor coasts";
  }
  if (gateway) {
    identity.timeout_owner = TimeoutOwner::kModule;
    identity.inverter = config.inverter;
    identity.shared_module = config.module;
  }
  return identity;
}

ScanReport DeviceNetTransport::scan(const Settings& bus, const std::atomic<bool>& end_asked) {
  return scanDevicenet(bus, linkFactory(), end_asked);
}

std::string DeviceNetTransport::quiet(const Settings& bus) const {
  return devicenetScanIsQuiet(bus);
}

}  // namespace nord_driver
