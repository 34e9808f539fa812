#include "transport/canopen/canopen.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "config/setting_checks.h"
#include "transport/addresses_asked.h"
#include "transport/canopen/canopen_bus_events.h"
#include "transport/canopen/canopen_counters.h"
#include "transport/canopen/canopen_frame_text.h"
#include "transport/canopen/canopen_listening.h"
#include "transport/canopen/canopen_scanner.h"

namespace nord_driver {

namespace {

constexpr Duration kLongestRelease = std::chrono::milliseconds{1100};  // the master ends before
constexpr Duration kListenFirst = std::chrono::milliseconds{500};      // a driver guards or sends more often than that

// A node watches its master from the first question or heartbeat on (CiA 301 7.2.8.3.2): where none came, the end is no
// loss, whatever times a driver has left in 100Ch, 100Dh and 1016h.
void endWithoutATrip(canopen::MasterConfig& master) {
  master.own_id.reset();
  master.heartbeat_time = Duration::zero();
  for (canopen::NodeConfig& node : master.nodes) {
    node.reset = canopen::BootReset::kNone;
    node.error_control.mode = canopen::ErrorControlMode::kNone;
    node.error_control.master_timeout.reset();
    node.silence = Duration::zero();
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

// One that answers and yet does not run says why, or is on its way, and one that was found driven is heard while it is
// being stopped: that is no matter of wires.
bool answers(const canopen::NodeStatus& status) noexcept {
  return status.state == canopen::NodeState::kBooting || status.state == canopen::NodeState::kOperational ||
         status.state == canopen::NodeState::kRefused || status.stops_first;
}

}  // namespace

void CanopenTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readCanopenConfig(bus, drives, cycle_rate);
  if (parametersOnly()) endWithoutATrip(config_.master);
  master_.emplace(config_.master);
  drives_.clear();
  drives_.reserve(config_.drives.size());
  for (const CanopenDrive& drive : config_.drives) {
    drives_.emplace_back(drive, static_cast<std::uint16_t>(drives_.size()));
  }
  answered_.assign(drives_.size(), 0);
  turns_.resize(drives_.size());
  std::iota(turns_.begin(), turns_.end(), DriveIndex{0});
  Setup setup;
  setup.link = {config_.interface, master_->receivedIds(), config_.bit_rate, master_->receivedRemoteIds()};
  setup.period = seconds(1.0 / cycle_rate);
  setup.answer_window = config_.answer_window;
  setup.longest_release = kLongestRelease;
  setup.describe = CanopenFrameText{config_};
  if (parametersOnly() && booleanOr(bus, "set_free", false)) {
    setup.listen.emplace(kCanopenSetFree, CanListenFirst::kGone, CanListener::kGuest);
  } else {
    setup.listen.emplace(kCanopenListening, kListenFirst,
                         parametersOnly() ? CanListener::kGuest : CanListener::kDriver);
  }
  prepare(bus, std::move(setup), *master_);
}

// Quick stop follows a ramp that does not end, and takes its time as well.
void CanopenTransport::setShutdownTimeout(Duration timeout) noexcept {
  master_->setOnlyAsked(std::max<Duration>(canopen::NodeConfig{}.only_asked, timeout + std::chrono::seconds{5}));
}

void CanopenTransport::putOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept {
  for (std::size_t node = 0; node < master_->nodeCount(); ++node) {
    if (master_->status(node).stops_first) lookForMotion(node);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].putOutput(outputs[i], *master_);
    answered_[i] = master_->transmitPdo(config_.drives[i].node, config_.drives[i].transmit_pdo).count;
  }
}

// Somebody who is gone may have left them turning.
void CanopenTransport::lookForMotion(std::size_t node) noexcept {
  if (parametersOnly()) return;
  const bool asked = config_.master.sync_cob_id.has_value();
  canopen::FoundMotion motion = canopen::FoundMotion::kRests;
  for (const CanopenDriveState& drive : drives_) {
    if (drive.config().node == node) motion = std::max(motion, drive.foundMotion(*master_, asked, now()));
  }
  master_->setMotion(node, motion);
}

void CanopenTransport::takeInputs(Instant now, std::vector<DriveExchange>& inputs) noexcept {
  const bool works = linkWorks() && !isSilent();
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

void CanopenTransport::handleWhileListening(const CanFrame& frame, Instant at) noexcept {
  if (master_->noteOtherMaster(frame, at)) noteMaster(frame.id, at);
}

// Not before: a cycle may be longer than the listening.
void CanopenTransport::handleListened() noexcept {
  for (std::size_t node = 0; node < master_->nodeCount(); ++node) lookForMotion(node);
}

void CanopenTransport::restartDrives() noexcept {
  for (CanopenDriveState& drive : drives_) drive.handleRestart();
}

// One whose request was taken goes behind all others: a single place to begin at would mix up the turns of several
// servers, and one drive could still wait for ever.
void CanopenTransport::runRequests(Instant /*now*/) noexcept {
  while (const auto answer = master_->pollSdo()) {
    const DriveIndex drive = CanopenParameters::tagOf(answer->answer.id);
    if (drive < drives_.size()) drives_[drive].parameters().handleAnswer(answer->answer);
  }
  std::size_t not_served = turns_.size();
  for (std::size_t i = 0; i < not_served;) {
    CanopenDriveState& drive = drives_[turns_[i]];
    const auto access = drive.parameters().pendingAccess();
    const CanopenDrive& config = drive.config();
    if (!access || !master_->submitSdo(config.node, config.sdo_server, *access)) {
      ++i;
      continue;
    }
    drive.parameters().handleStarted();
    const auto served = turns_.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(served, served + 1, turns_.end());
    --not_served;
  }
}

void CanopenTransport::takeEvents() noexcept {
  while (const auto event = master_->pollEvent()) {
    const bool of_a_master = event->kind == canopen::CanopenEventKind::kSecondMaster ||
                             event->kind == canopen::CanopenEventKind::kForeignCommand;
    if (of_a_master) noteMaster(event->value, event->at);
    const bool of_a_node = event->node != canopen::kNoNode;
    takeEvent(*event, of_a_node ? config_.master.nodes[event->node].id : 0, events());
  }
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

bool CanopenTransport::connected() const noexcept {
  return linkWorks() && !isSilent() &&
         std::any_of(config_.drives.begin(), config_.drives.end(),
                     [this](const auto& it) { return answers(master_->status(it.node)); });
}

BusCounters CanopenTransport::counters() const noexcept {
  return canopenCounters(*master_, line());
}

DriveNote CanopenTransport::note(DriveIndex drive) const noexcept {
  const char* note = linkNote();
  return {*note != '\0' ? note : drives_[drive].note()};
}

std::uint32_t CanopenTransport::identNumber(DriveIndex drive) const noexcept {
  const canopen::NodeStatus& status = master_->status(config_.drives[drive].node);
  return status.vendor_id << 16 | (status.product_code & 0xFFFFu);
}

Sentence CanopenTransport::busText() const noexcept {
  Sentence text = linkText();
  if (!text.empty()) return text;
  if (!connected() && !events().isExplained(now())) {
    const auto& nodes = config_.master.nodes;
    const auto asked = addressesAsked(nodes.size(), [&nodes](std::size_t node) { return nodes[node].id; });
    text.format(
        "%s is open, but no node answers (asked: %s): power, address and bit rate (P515, P514, or the module's "
        "switches), termination? nord_param scan finds who is there",
        config_.interface.c_str(), asked.c_str());
    return text;
  }
  text = events().text(now());
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
    identity.module_saves = true;  // SDO has no order for the RAM
  } else if (config.connection == CanopenConnection::kSystemBus) {
    identity.address = "NORD system bus id " + std::to_string(node.id) +
                       " (experimental: its objects are taken to be those of SK 5xxE)";
  }
  if (config.drive_profile == DriveProfile::kCia402) {
    identity.address += ", CiA 402";
    identity.nord_profile = false;
    identity.parameter_sets = 1;
  }
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

ScanReport CanopenTransport::scan(const Settings& bus, const std::atomic<bool>& end_asked) {
  return scanCanopen(bus, linkFactory(), end_asked);
}

}  // namespace nord_driver
