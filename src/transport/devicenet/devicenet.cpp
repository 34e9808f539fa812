#include "transport/devicenet/devicenet.h"

#include <algorithm>
#include <utility>

#include "config/setting_checks.h"
#include "core/can_trace.h"
#include "link/can/make_can_link.h"
#include "transport/devicenet/assembly.h"
#include "transport/devicenet/devicenet_counters.h"
#include "transport/devicenet/devicenet_frame_text.h"

namespace nord_driver {

namespace {

constexpr Duration kReopenInterval = std::chrono::milliseconds{500};
constexpr Duration kShortestWait = std::chrono::microseconds{50};
constexpr Duration kQueueRetry = std::chrono::microseconds{250};
constexpr int kFramesAtOnce = 1000;
constexpr Duration kLineCountersInterval = std::chrono::milliseconds{500};  // each time is a system call
constexpr Duration kLongestRelease = std::chrono::milliseconds{500};
constexpr Duration kListenFirst = std::chrono::milliseconds{500};  // a scanner polls more often than that
constexpr int kRatesUntilTimeout = 4;

std::unique_ptr<link::CanLink> openInterface(const link::CanSettings& settings) {
  return link::makeCanLink(settings);
}

const char* stateText(link::CanState state) noexcept {
  return state == link::CanState::kBusOff ? "the controller is bus-off" : "the interface is down";
}

}  // namespace

DeviceNetTransport::DeviceNetTransport() : DeviceNetTransport(openInterface) {}

DeviceNetTransport::DeviceNetTransport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

void DeviceNetTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readDevicenetConfig(bus, drives, cycle_rate);
  period_ = seconds(1.0 / cycle_rate);
  if (parameters_only_) {
    for (devicenet::NodeConfig& node : config_.scanner.nodes) node.io.kind = devicenet::IoKind::kNone;
    listen_first_.emplace(kListenFirst);
  }
  scanner_.emplace(config_.scanner);
  link::CanSettings settings;
  settings.interface = config_.interface;
  if (!parameters_only_) settings.ids = scanner_->receivedIds();  // otherwise every frame there is
  settings.bit_rate = config_.bit_rate;
  Sentence reason;
  if (!link::checkCanSettings(settings, reason)) throw ConfigError(bus.fullName("interface") + ": " + reason.str());
  trace_.emplace(kLinkTypeCanSocketCan, DevicenetFrameText{config_}, TelegramTrace::kCapacity,
                 [](const TraceRecord& record) {
                   const auto frame = fromPacket(record.view());
                   return frame ? candumpText(*frame) : toHex(record.view());
                 });
  drives_.clear();
  drives_.reserve(config_.drives.size());
  for (const DevicenetDrive& drive : config_.drives) {
    drives_.emplace_back(drive, config_.scanner.nodes[drive.module].io, period_,
                         static_cast<std::uint16_t>(drives_.size()), parameters_only_);
  }
  outputs_.assign(config_.modules.size(), {});
  answered_.assign(drives_.size(), 0);
  link_ = make_link_(settings);
}

bool DeviceNetTransport::serveParametersOnly() noexcept {
  parameters_only_ = true;
  return true;
}

Instant DeviceNetTransport::now() const noexcept {
  return link_->now();
}

void DeviceNetTransport::sleepUntil(Instant when) noexcept {
  if (link_->isOpen()) run(receive(), when, false);
  link_->sleepUntil(when);
}

// An interface that is not there is looked for again and again, whatever happened to it.
bool DeviceNetTransport::linkReady() noexcept {
  if (link_->isOpen()) return true;
  const Instant now = link_->now();
  if (now < next_open_) return false;
  next_open_ = now + kReopenInterval;
  if (!link_->open()) return false;
  controller_up_ = true;
  restart();
  return true;
}

void DeviceNetTransport::restart() noexcept {
  const Instant now = link_->now();
  scanner_->restart(now);
  if (listen_first_) listen_first_->restart(now);
  for (DevicenetDriveState& drive : drives_) drive.handleRestart();
}

// Who has been off the bus checks its MAC id again.
void DeviceNetTransport::watchController() noexcept {
  const bool up =
      link_->isOpen() && link_->state() != link::CanState::kBusOff && link_->state() != link::CanState::kDown;
  if (up == controller_up_) return;
  controller_up_ = up;
  if (up) return restart();
  Sentence why;
  why.format("%s: %s", config_.interface.c_str(),
             link_->isOpen() ? stateText(link_->state()) : "the interface is gone");
  scanner_->handleBusLost(why, link_->now());
}

// Listening is over: the duplicate-MAC check begins now.
bool DeviceNetTransport::mayTalk(Instant now) noexcept {
  if (!listen_first_) return true;
  const bool listened = isSilent();
  if (!listen_first_->mayTalk(now)) return false;
  if (listened) scanner_->restart(now);
  return true;
}

bool DeviceNetTransport::busWorks() const noexcept {
  return link_->isOpen() && controller_up_ && scanner_->busState() == devicenet::BusState::kOnline && !isSilent();
}

void DeviceNetTransport::setOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    // All 0, the module's own byte too: its outputs stay off, and an inverter nobody drives ignores its words.
    outputs_[i].clear();
    outputs_[i].resize(config_.scanner.nodes[i].io.output_bytes);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].putOutput(outputs[i], *scanner_, outputs_[config_.drives[i].module]);
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) scanner_->setOutput(i, outputs_[i]);
}

void DeviceNetTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                                  std::vector<DriveExchange>& inputs) noexcept {
  if (linkReady()) {
    cycle_start_ = link_->now();
    const Instant received = receive();  // what came while nobody looked is older than this cycle's answers
    watchController();
    setOutputs(outputs);
    for (DriveIndex i = 0; i < drives_.size(); ++i) answered_[i] = scanner_->input(config_.drives[i].module).count;
    scanner_->startCycle(cycle_start_);
    run(received, cycle_start_ + config_.answer_window, true);
  }
  takeLineCounters();
  const bool works = busWorks();
  const Instant now = link_->now();
  for (DriveIndex i = 0; i < drives_.size(); ++i) drives_[i].takeInput(*scanner_, works, now, inputs[i]);
}

bool DeviceNetTransport::allAnswered() const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!drives_[i].answered(*scanner_, answered_[i])) return false;
  }
  return true;
}

// The clock may be later than `received` by now, but no time-out may be seen ahead of what has come since.
void DeviceNetTransport::run(Instant received, Instant until, bool until_answered) noexcept {
  while (link_->isOpen()) {
    watchController();
    takeEvents();
    const bool talks = mayTalk(received);
    if (talks) {
      scanner_->poll(received);
      runRequests(received);
      send(std::max(until, cycle_start_ + period_ / 2));
      takeEvents();
    }
    const Instant now = link_->now();
    if (now >= until || (until_answered && allAnswered())) break;
    const Instant due = (talks ? scanner_->nextDeadline() : listen_first_->nextDeadline()).value_or(until);
    // Time must pass, also where something is due that cannot be sent.
    if (!link_->waitReadable(std::min(until, std::max(due, now + kShortestWait))) && link_->now() >= until) break;
    received = receive();
  }
  if (link_->isOpen()) return;
  // Gone in the middle of a cycle: nobody exchanges until it is back.
  watchController();
  for (DevicenetDriveState& drive : drives_) drive.handleRestart();
  next_open_ = link_->now() + kReopenInterval;
}

Instant DeviceNetTransport::receive() noexcept {
  link::ReceivedCanFrame received;
  const Instant looked = link_->now();
  for (int count = 0; count < kFramesAtOnce && link_->receive(received); ++count) {
    trace_->record(TraceKind::kReceived, toPacket(received.frame), received.at);
    if (isSilent()) {
      listen_first_->handle(received.frame);
    } else {
      scanner_->handleFrame(received.frame, received.at);
    }
  }
  return looked;
}

// A burst longer than the interface's queue is waited out, but not beyond `until`: the process data of this cycle are
// then dropped, and the next cycle sends newer ones.
void DeviceNetTransport::send(Instant until) noexcept {
  CanFrame frame;
  while (scanner_->pollTransmit(frame)) {
    link::CanSend sent = link_->send(frame);
    while (sent == link::CanSend::kQueueFull && link_->now() < until && link_->waitWritable(until)) {
      sent = link_->send(frame);
      // A queue further down can be full although this one is not: polling would spin.
      if (sent == link::CanSend::kQueueFull) link_->sleepUntil(std::min(until, link_->now() + kQueueRetry));
    }
    if (sent != link::CanSend::kSent) return scanner_->notSent();
    trace_->record(TraceKind::kSent, toPacket(frame), link_->now());
  }
}

void DeviceNetTransport::runRequests(Instant now) noexcept {
  while (const auto answer = scanner_->pollAnswer()) {
    const std::size_t drive = DevicenetParameters::tagOf(answer->answer.id) & ~unsigned{DevicenetDriveState::kProbeTag};
    if (drive < drives_.size()) drives_[drive].handleAnswer(answer->answer, now);
  }
  if (!busWorks()) return;
  for (DevicenetDriveState& drive : drives_) drive.runRequests(*scanner_, now);
}

void DeviceNetTransport::takeEvents() noexcept {
  while (const auto event = scanner_->pollEvent()) {
    const bool second = event->kind == devicenet::DevicenetEventKind::kSecondScanner;
    if (second && listen_first_) listen_first_->handleScanner(event->value);
    const bool of_a_node = event->node != devicenet::kNoNode;
    events_.take(*event, of_a_node ? config_.modules[event->node].mac : 0u);
  }
}

void DeviceNetTransport::takeLineCounters() noexcept {
  const Instant now = link_->now();
  if (now < next_line_counters_) return;
  next_line_counters_ = now + kLineCountersInterval;
  line_ = link_->counters();
  events_.noteLostFrames(config_.interface.c_str(), line_.dropped, now);
}

std::vector<std::string> DeviceNetTransport::warnings() const {
  std::vector<std::string> sentences = config_.warnings;
  for (const DevicenetDrive& drive : config_.drives) {
    if (drive.connection == DevicenetConnection::kOption) {
      sentences.push_back("drive " + drive.name +
                          ": SK TU1/2/3-DEV is experimental, no manual we have lists its objects; "
                          "they are taken to be those of SK CU4-DEV");
    }
    if (drive.drive_profile == DevicenetProfile::kAcDrive) {
      sentences.push_back("drive " + drive.name +
                          ": the AC drive profile of assembly 20/70 has no reverse: where one is commanded the motor "
                          "stands still; 21/71 (P160 = 2) and 100/110 (P160 = 3) have it");
    }
  }
  return sentences;
}

bool DeviceNetTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  return drives_[drive].submit(request);
}

std::optional<profile::ParameterResult> DeviceNetTransport::pollResult() noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto result = drives_[result_cursor_].pollResult();
    if (result) return result;
    result_cursor_ = (result_cursor_ + 1) % drives_.size();
  }
  return std::nullopt;
}

bool DeviceNetTransport::connected() const noexcept {
  return busWorks() && std::any_of(drives_.begin(), drives_.end(),
                                   [](const DevicenetDriveState& drive) { return drive.moduleAnswers(); });
}

BusCounters DeviceNetTransport::counters() const noexcept {
  return devicenetCounters(*scanner_, line_);
}

DriveNote DeviceNetTransport::note(DriveIndex drive) const noexcept {
  if (!link_->isOpen()) return {"the CAN interface is not open"};
  if (isSilent()) {
    return {listen_first_->heard() ? "another scanner has the bus: nothing is sent beside it"
                                   : "it is listened for other scanners before anything is sent"};
  }
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

// No device is connected. One that answers all the same says why, and that is no matter of wires.
Sentence DeviceNetTransport::silenceText() const noexcept {
  Sentence text;
  for (std::size_t i = 0; i < config_.modules.size(); ++i) {
    const devicenet::NodeStatus& status = scanner_->status(i);
    if (status.state != devicenet::NodeState::kRefused) continue;
    text.format("MAC id %u %.220s", unsigned{config_.modules[i].mac}, status.reason.c_str());
    return text;
  }
  text.format(
      "%s is open, but no device answers: are the modules and the bus powered (24 V), do MAC ids and bit rate agree "
      "with "
      "their switches, are the two ends of the bus terminated?",
      config_.interface.c_str());
  return text;
}

Sentence DeviceNetTransport::busText() const noexcept {
  Sentence text;
  if (!link_->isOpen()) {
    text.format("%s", link_->lastError().empty() ? "the CAN interface is not open yet" : link_->lastError().c_str());
    return text;
  }
  text.format("%s", link_->advice());
  if (!text.empty()) return text;
  if (isSilent()) return listen_first_->text();
  if (!scanner_->busReason().empty()) return scanner_->busReason();
  if (scanner_->busState() == devicenet::BusState::kCheckingMac) {
    text.format("checks for two seconds that no other device has our MAC id %u", unsigned{config_.scanner.mac});
    return text;
  }
  if (!connected() && !events_.isExplained(link_->now())) return silenceText();
  return events_.text(link_->now());
}

DriveIdentity DeviceNetTransport::identity(DriveIndex drive) const {
  const DevicenetDrive& config = config_.drives[drive];
  const devicenet::IoConfig& io = config_.scanner.nodes[config.module].io;
  const bool gateway = config.connection == DevicenetConnection::kGateway;
  DriveIdentity identity;
  identity.address = "DeviceNet MAC id " + std::to_string(config.mac);
  if (gateway) identity.address += ", inverter " + std::to_string(config.inverter);
  if (config.drive_profile != DevicenetProfile::kNord) identity.address += ", AC drive profile";
  identity.process_values = config.processValues();
  identity.parameter_channel = "explicit messages";
  if (!parameters_only_) {
    const double rate = toSeconds(io.expected_packet_rate.value_or(Duration::zero()));
    identity.protection_time = kRatesUntilTimeout * rate;
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

// A connection that simply ended would be a loss to the device.
void DeviceNetTransport::release() noexcept {
  const Instant begun = link_->now();
  const Instant until = begun + kLongestRelease;
  scanner_->releaseAll(begun);
  for (;;) {
    send(until);
    const Instant now = link_->now();
    if (scanner_->released() || now >= until || !link_->isOpen()) return;
    const Instant due = scanner_->nextDeadline().value_or(until);
    link_->waitReadable(std::min(until, std::max(due, now + kShortestWait)));
    scanner_->poll(receive());
  }
}

void DeviceNetTransport::close() noexcept {
  if (!link_ || !link_->isOpen()) return;
  if (!isSilent()) release();
  link_->close();
}

}  // namespace nord_driver
