#include "sim/canopen/can_stations.h"

#include <algorithm>
#include <utility>

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr std::uint32_t kSync = 0x80;
constexpr std::uint32_t kTime = 0x100;
constexpr std::uint32_t kSdoRequest = 0x600;
constexpr std::uint32_t kErrorControl = 0x700;

/// Identifiers with a meaning of their own, whether or not somebody listens: NMT, SYNC, TIME, SDO requests to nodes
/// that may be there, guarding and the master's own heartbeat.
bool hasMeaning(std::uint32_t id) noexcept {
  return id == 0 || id == kSync || id == kTime || (id > kSdoRequest && id <= kSdoRequest + 127) ||
         (id > kErrorControl && id <= kErrorControl + 127);
}

/// P515 the node id, P551 the profile, P509 CANopen.
Commissioning commissioningOf(const DriveConfig& config) {
  const CanDriveConfig& can = config.bus.as<CanDriveConfig>();
  Commissioning commissioning;
  commissioning.wiring = canWiring(can.connection, config.device);
  if (can.connection != CanConnection::kGateway) commissioning.parameters.push_back({515, 0, 0, config.address});
  commissioning.parameters.push_back({551, 0, 0, can.cia402 ? 1 : 0});
  if (commissioning.wiring.source) commissioning.parameters.push_back({509, 0, 0, *commissioning.wiring.source});
  return commissioning;
}

}  // namespace

CanStations::CanStations(RobotSim& robot) : robot_(robot) {
  std::vector<std::pair<CanNodeSettings, CanNode::Drives>> plan;
  for (std::size_t i = 0; i < robot_.drives().size(); ++i) {
    DriveUnit& drive = robot_.drive(i);
    const DriveConfig& config = drive.config();
    const CanDriveConfig& can = config.bus.as<CanDriveConfig>();
    const bool gateway = can.connection == CanConnection::kGateway;
    const std::size_t place = config.place > 0 ? config.place - 1 : 0;
    auto at =
        std::find_if(plan.begin(), plan.end(), [&](const auto& entry) { return entry.first.node == config.address; });
    if (can.doubled_id || at == plan.end()) {
      CanNodeSettings settings;
      settings.node = config.address;
      settings.can = can;
      settings.swap_words_2_3 = config.device.isOlderSeries();
      plan.emplace_back(settings, CanNode::Drives{});
      at = plan.end() - 1;
    } else if (!gateway || at->first.can.connection != CanConnection::kGateway || at->second[place] != nullptr) {
      throw ConfigError("drive " + config.name + ": node " + std::to_string(config.address) + " with inverter " +
                        std::to_string(place + 1) +
                        " is taken; expected a node of its own, or behind one gateway an inverter number of its own");
    }
    at->second[place] = &drive;
    node_of_.push_back(static_cast<std::size_t>(at - plan.begin()));
  }
  for (const auto& [settings, drives] : plan) {
    nodes_.push_back(&robot_.add(std::make_unique<CanNode>(settings, drives, referee_)));
  }
  for (std::size_t i = 0; i < node_of_.size(); ++i) {
    DriveUnit& drive = robot_.drive(i);
    drive.connect(nodeOf(i), commissioningOf(drive.config()));
  }
}

void CanStations::advance(Instant now, CanSink& sink) noexcept {
  if (!started_) {
    started_ = true;
    now_ = now;
    robot_.advance(now);
  }
  while (now_ < now) {
    const Duration span = std::min(kStep, now - now_);
    now_ += span;
    robot_.advance(now_);
    for (CanNode* node : nodes_) node->advance(span, sink);
  }
}

void CanStations::receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept {
  if (judge == Judge::kYes) {
    referee_.masterFrame(frame);
    CanNode::Claim claim = CanNode::Claim::kNone;
    for (CanNode* node : nodes_) claim = std::max(claim, node->claim(frame.id));
    const bool guarding = frame.remote && frame.id > kErrorControl;
    if (claim == CanNode::Claim::kSends && !guarding) {
      referee_.broken(frame.remote ? CanRule::kRemotePdo : CanRule::kIdOfANode);
    } else if (claim == CanNode::Claim::kNone && !hasMeaning(frame.id) && !frame.extended) {
      referee_.broken(CanRule::kUnknownId);
    }
  }
  for (CanNode* node : nodes_) node->receive(frame, judge == Judge::kYes, sink);
}

void CanStations::delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept {
  const CanNode* sender =
      frame.id > kErrorControl ? find(static_cast<std::uint8_t>(frame.id - kErrorControl)) : nullptr;
  const bool is_operational = sender != nullptr && sender->state() == NmtState::kOperational;
  if (to_master) referee_.delivered(frame, is_operational);
  for (CanNode* node : nodes_) {
    if (node->claim(frame.id) != CanNode::Claim::kSends) node->receive(frame, false, sink);
  }
}

void CanStations::stoodStill() noexcept {
  for (CanNode* node : nodes_) node->stoodStill();
}

bool CanStations::anyAlive() const noexcept {
  return std::any_of(nodes_.begin(), nodes_.end(), [](const CanNode* node) { return node->alive(); });
}

CanNode* CanStations::find(std::uint8_t id) noexcept {
  const auto at = std::find_if(nodes_.begin(), nodes_.end(), [&](const CanNode* node) { return node->id() == id; });
  return at == nodes_.end() ? nullptr : *at;
}

}  // namespace nord_driver::sim
