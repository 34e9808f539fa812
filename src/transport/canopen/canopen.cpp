#include "transport/canopen/canopen.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/setting_checks.h"
#include "core/can_trace.h"
#include "link/can/make_can_link.h"
#include "transport/canopen/canopen_counters.h"
#include "transport/canopen/canopen_frame_text.h"

namespace nord_driver {

namespace {

constexpr Duration kReopenInterval = std::chrono::milliseconds{500};
constexpr Duration kShortestWait = std::chrono::microseconds{50};
constexpr Duration kQueueRetry = std::chrono::microseconds{250};
constexpr int kFramesAtOnce = 1000;
constexpr Duration kLineCountersInterval = std::chrono::milliseconds{500};  // each time is a system call
constexpr Duration kLongestRelease = std::chrono::milliseconds{1100};       // the master ends before
constexpr Duration kListenFirst = std::chrono::milliseconds{500};  // a driver guards or sends more often than that

std::unique_ptr<link::CanLink> openInterface(const link::CanSettings& settings) {
  return link::makeCanLink(settings);
}

// A node watches its master from the first question or heartbeat on (CiA 301 7.2.8.3.2): where none came, the end is no
// loss, whatever times a driver has left in 100Ch, 100Dh and 1016h.
void endWithoutATrip(canopen::MasterConfig& master) {
  master.own_id.reset();
  master.heartbeat_time = Duration::zero();
  for (canopen::NodeConfig& node : master.nodes) {
    node.reset = canopen::BootReset::kNone;
    node.error_control.mode = canopen::ErrorControlMode::kNone;
    node.error_control.master_timeout.reset();
  }
}

// s until the node notices that this computer is gone; 0: the bus gives it nothing to watch.
double protectionTime(const canopen::ErrorControl& control) {
  if (control.mode == canopen::ErrorControlMode::kGuarding) {
    return toSeconds(control.guard_time * control.life_time_factor);
  }
  return control.master_timeout ? toSeconds(*control.master_timeout) : 0.0;
}

// Which number of group 10 an inverter behind a gateway shows is in no manual we have.
std::string protectionOf(const CanopenDrive& drive, const canopen::ErrorControl& control) {
  const double time = protectionTime(control);
  if (time == 0.0) return {};
  const bool guarding = control.mode == canopen::ErrorControlMode::kGuarding;
  const bool gateway = drive.connection == CanopenConnection::kGateway;
  return std::string(guarding ? "node guarding, " : "the node watches this computer's heartbeat for ") +
         shortNumber(time) + " s: the inverter trips " + (gateway ? "E10" : "E10.0") + " and the motor coasts";
}

}  // namespace

CanopenTransport::CanopenTransport() : CanopenTransport(openInterface) {}

CanopenTransport::CanopenTransport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

void CanopenTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readCanopenConfig(bus, drives, cycle_rate);
  period_ = seconds(1.0 / cycle_rate);
  if (parameters_only_) endWithoutATrip(config_.master);
  listen_first_.emplace(kListenFirst, parameters_only_ ? CanListener::kGuest : CanListener::kDriver);
  master_.emplace(config_.master);
  link::CanSettings settings;
  settings.interface = config_.interface;
  if (!parameters_only_) settings.ids = master_->receivedIds();  // otherwise every frame there is
  settings.bit_rate = config_.bit_rate;
  Sentence reason;
  if (!link::checkCanSettings(settings, reason)) throw ConfigError(bus.fullName("interface") + ": " + reason.str());
  trace_.emplace(kLinkTypeCanSocketCan, CanopenFrameText{config_}, TelegramTrace::kCapacity,
                 [](const TraceRecord& record) {
                   const auto frame = fromPacket(record.view());
                   return frame ? candumpText(*frame) : toHex(record.view());
                 });
  drives_.clear();
  drives_.reserve(config_.drives.size());
  for (const CanopenDrive& drive : config_.drives) {
    const canopen::NodeConfig& node = config_.master.nodes[drive.node];
    drives_.emplace_back(drive, node.receive_pdos[drive.receive_pdo].cob_id,
                         static_cast<std::uint16_t>(drives_.size()));
  }
  answered_.assign(drives_.size(), 0);
  link_ = make_link_(settings);
}

bool CanopenTransport::serveParametersOnly() noexcept {
  parameters_only_ = true;
  return true;
}

Instant CanopenTransport::now() const noexcept {
  return link_->now();
}

void CanopenTransport::sleepUntil(Instant when) noexcept {
  if (link_->isOpen()) {
    run(receive(), when, false);
  }
  link_->sleepUntil(when);
}

// An interface that is not there is looked for again and again, whatever happened to it.
bool CanopenTransport::linkReady() noexcept {
  if (link_->isOpen()) return true;
  const Instant now = link_->now();
  if (now < next_open_) return false;
  next_open_ = now + kReopenInterval;
  if (!link_->open()) return false;
  restart();
  return true;
}

void CanopenTransport::restart() noexcept {
  const Instant now = link_->now();
  master_->restart(now);
  // A driver whose interface was away has had the nodes: they may turn, and must hear from this driver at once.
  if (parameters_only_ || !opened_) listen_first_->restart(now);
  opened_ = true;
  for (CanopenDriveState& drive : drives_) drive.handleRestart();
}

// Listening is over: the start-up of the nodes begins now, so that none of its times has run meanwhile.
bool CanopenTransport::mayTalk(Instant now) noexcept {
  const bool listened = isSilent();
  if (!listen_first_->mayTalk(now)) return false;
  if (listened) master_->restart(now);
  return true;
}

bool CanopenTransport::busWorks() const noexcept {
  return link_->isOpen() && link_->state() != link::CanState::kBusOff && link_->state() != link::CanState::kDown;
}

void CanopenTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                                std::vector<DriveExchange>& inputs) noexcept {
  if (linkReady()) {
    cycle_start_ = link_->now();
    const Instant received = receive();  // what came while nobody looked is older than this cycle's answers
    for (DriveIndex i = 0; i < drives_.size(); ++i) {
      drives_[i].putOutput(outputs[i], *master_);
      answered_[i] = master_->transmitPdo(config_.drives[i].node, config_.drives[i].transmit_pdo).count;
    }
    master_->startCycle(cycle_start_);
    if (!isSilent()) commandUnheardNodes();
    run(received, cycle_start_ + config_.answer_window, true);
  }
  takeLineCounters();
  const bool works = busWorks() && !isSilent();
  const Instant now = link_->now();
  for (DriveIndex i = 0; i < drives_.size(); ++i) drives_[i].takeInput(*master_, works, now, inputs[i]);
}

bool CanopenTransport::allAnswered() const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const CanopenDrive& drive = config_.drives[i];
    const bool operational = master_->status(drive.node).state == canopen::NodeState::kOperational;
    if (operational && master_->transmitPdo(drive.node, drive.transmit_pdo).count == answered_[i]) return false;
  }
  return true;
}

// The clock may be later than `received` by now, but no time-out may be seen ahead of what has come since.
void CanopenTransport::run(Instant received, Instant until, bool until_answered) noexcept {
  while (link_->isOpen()) {
    takeEvents();
    const bool talks = mayTalk(received);
    if (talks) {
      master_->poll(received);
      runParameters();
      send(std::max(until, cycle_start_ + period_ / 2));
      takeEvents();
    }
    const Instant now = link_->now();
    if (now >= until || (until_answered && allAnswered())) break;
    const Instant due = (talks ? master_->nextDeadline() : listen_first_->nextDeadline()).value_or(until);
    // Time must pass, also where something is due that cannot be sent.
    if (!link_->waitReadable(std::min(until, std::max(due, now + kShortestWait))) && link_->now() >= until) break;
    received = receive();
  }
  if (link_->isOpen()) return;
  // Gone in the middle of a cycle: nobody exchanges until it is back.
  restart();
  next_open_ = link_->now() + kReopenInterval;
}

Instant CanopenTransport::receive() noexcept {
  link::ReceivedCanFrame received;
  const Instant looked = link_->now();
  for (int count = 0; count < kFramesAtOnce && link_->receive(received); ++count) {
    trace_->record(TraceKind::kReceived, toPacket(received.frame), received.at);
    if (!isSilent()) {
      master_->handleFrame(received.frame, received.at);
    } else if (parameters_only_) {
      listen_first_->handle(received.frame);
    } else if (master_->noteOtherMaster(received.frame, received.at)) {
      listen_first_->handleMaster(received.frame.id, received.at);
    }
  }
  return looked;
}

// A burst longer than the interface's queue is waited out, but not beyond `until`: the setpoints of this cycle are
// then dropped, and the next cycle sends newer ones.
void CanopenTransport::send(Instant until) noexcept {
  CanFrame frame;
  while (master_->pollTransmit(frame)) {
    link::CanSend sent = link_->send(frame);
    while (sent == link::CanSend::kQueueFull && link_->now() < until && link_->waitWritable(until)) {
      sent = link_->send(frame);
      // A queue further down can be full although this one is not: polling would spin.
      if (sent == link::CanSend::kQueueFull) link_->sleepUntil(std::min(until, link_->now() + kQueueRetry));
    }
    if (sent != link::CanSend::kSent) return master_->notSent();
    trace_->record(TraceKind::kSent, toPacket(frame), link_->now());
  }
}

// Words that stop, as long as the drive layer gives any; never an old one.
void CanopenTransport::commandUnheardNodes() noexcept {
  for (const CanopenDriveState& drive : drives_) {
    const auto frame = drive.unheardCommand(*master_);
    if (!frame || link_->send(*frame) != link::CanSend::kSent) continue;
    trace_->record(TraceKind::kSent, toPacket(*frame), link_->now());
  }
}

void CanopenTransport::runParameters() noexcept {
  while (const auto answer = master_->pollSdo()) {
    const DriveIndex drive = CanopenParameters::tagOf(answer->answer.id);
    if (drive < drives_.size()) drives_[drive].parameters().handleAnswer(answer->answer);
  }
  for (CanopenDriveState& drive : drives_) {
    const auto access = drive.parameters().pendingAccess();
    const CanopenDrive& config = drive.config();
    if (access && master_->submitSdo(config.node, config.sdo_server, *access)) drive.parameters().handleStarted();
  }
}

void CanopenTransport::takeEvents() noexcept {
  while (const auto event = master_->pollEvent()) {
    if (event->kind == canopen::CanopenEventKind::kSecondMaster) listen_first_->handleMaster(event->value, event->at);
    const bool of_a_node = event->node != canopen::kNoNode;
    events_.take(*event, of_a_node ? config_.master.nodes[event->node].id : 0);
  }
}

void CanopenTransport::takeLineCounters() noexcept {
  const Instant now = link_->now();
  if (now < next_line_counters_) return;
  next_line_counters_ = now + kLineCountersInterval;
  line_ = link_->counters();
  events_.noteLostFrames(config_.interface.c_str(), line_.dropped, now);
}

std::vector<std::string> CanopenTransport::warnings() const {
  std::vector<std::string> sentences;
  for (const CanopenDrive& drive : config_.drives) {
    if (drive.connection != CanopenConnection::kSystemBus) continue;
    sentences.push_back("drive " + drive.name +
                        ": connection system_bus is experimental, no manual we have lists its objects; they are taken "
                        "to be those of SK 5xxE");
  }
  return sentences;
}

bool CanopenTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  return drives_[drive].submit(request);
}

std::optional<profile::ParameterResult> CanopenTransport::pollResult() noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto result = drives_[result_cursor_].pollResult();
    if (result) return result;
    result_cursor_ = (result_cursor_ + 1) % drives_.size();
  }
  return std::nullopt;
}

bool CanopenTransport::connected() const noexcept {
  return busWorks() && std::any_of(drives_.begin(), drives_.end(),
                                   [](const CanopenDriveState& drive) { return drive.moduleAnswers(); });
}

BusCounters CanopenTransport::counters() const noexcept {
  return canopenCounters(*master_, line_);
}

DriveNote CanopenTransport::note(DriveIndex drive) const noexcept {
  if (!link_->isOpen()) return {"the CAN interface is not open"};
  if (!isSilent()) return {drives_[drive].note()};
  return {listen_first_->heard() ? "another master has the bus: nothing is sent beside it"
                                 : "it is listened for other masters before anything is sent"};
}

std::uint32_t CanopenTransport::identNumber(DriveIndex drive) const noexcept {
  const canopen::NodeStatus& status = master_->status(config_.drives[drive].node);
  return status.vendor_id << 16 | (status.product_code & 0xFFFFu);
}

Sentence CanopenTransport::busText() const noexcept {
  Sentence text;
  if (!link_->isOpen()) {
    text.format("%s", link_->lastError().empty() ? "the CAN interface is not open yet" : link_->lastError().c_str());
    return text;
  }
  text.format("%s", link_->advice());
  if (!text.empty()) return text;
  if (isSilent()) return listen_first_->text();
  if (!connected() && !events_.isExplained(link_->now())) {
    text.format(
        "%s is open, but no node runs: are the drives powered, is the bit rate right (P514), are the two ends of the "
        "bus terminated?",
        config_.interface.c_str());
    return text;
  }
  text = events_.text(link_->now());
  if (!text.empty()) return text;
  for (const CanopenDriveState& drive : drives_) {
    // A drive that is silent tells it in its note.
    if (!drive.inverterAnswers() || drive.emergency().empty()) continue;
    text.format("drive %s reports %s", drive.config().name.c_str(), drive.emergency().c_str());
    break;
  }
  return text;
}

DriveIdentity CanopenTransport::identity(DriveIndex drive) const {
  const CanopenDrive& config = config_.drives[drive];
  const canopen::NodeConfig& node = config_.master.nodes[config.node];
  DriveIdentity identity;
  identity.address = "CANopen node " + std::to_string(node.id);
  if (config.connection == CanopenConnection::kGateway) {
    identity.address += ", inverter " + std::to_string(config.inverter);
  } else if (config.connection == CanopenConnection::kSystemBus) {
    identity.address = "NORD system bus id " + std::to_string(node.id) +
                       " (experimental: its objects are taken to be those of SK 5xxE)";
  }
  if (config.drive_profile == DriveProfile::kCia402) identity.address += ", CiA 402";
  identity.process_values = config.process_values;
  identity.parameter_channel = "SDO";
  identity.protected_by = protectionOf(config, node.error_control);
  identity.protection_time = protectionTime(node.error_control);
  if (config.connection == CanopenConnection::kGateway) {
    identity.timeout_owner = TimeoutOwner::kModule;
    identity.inverter = config.inverter;
    identity.shared_module = config.node;
  }
  return identity;
}

// Guarding that simply ended would be a loss to the node, and leave E10.0 in every inverter.
void CanopenTransport::release() noexcept {
  const Instant begun = link_->now();
  const Instant until = begun + kLongestRelease;
  master_->releaseAll(begun);
  for (;;) {
    send(until);
    const Instant now = link_->now();
    if (master_->released() || now >= until || !link_->isOpen()) return;
    const Instant due = master_->nextDeadline().value_or(until);
    link_->waitReadable(std::min(until, std::max(due, now + kShortestWait)));
    master_->poll(receive());
  }
}

void CanopenTransport::close() noexcept {
  if (!link_ || !link_->isOpen()) return;
  // Silent: no node was touched, or somebody else has them.
  if (!isSilent()) release();
  link_->close();
}

}  // namespace nord_driver
