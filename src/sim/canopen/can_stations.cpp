#include "sim/canopen/can_stations.h"

#include <algorithm>

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

}  // namespace

CanStations::CanStations(RobotSim& robot) : robot_(robot) {
  std::vector<std::pair<CanNodeSettings, CanNode::Drives>> plan;
  for (std::size_t i = 0; i < robot_.drives().size(); ++i) {
    DriveUnit& drive = robot_.drive(i);
    const DriveConfig& config = drive.config();
    const CanDriveConfig can = config.can.value_or(CanDriveConfig{});
    const bool gateway = can.connection == CanConnection::kGateway;
    const std::size_t place = gateway ? can.inverter - 1 : 0;
    auto at = std::find_if(plan.begin(), plan.end(),
                           [&](const auto& entry) { return entry.first.node == config.slave.address; });
    if (can.doubled_id || at == plan.end()) {
      CanNodeSettings settings;
      settings.node = config.slave.address;
      settings.can = can;
      settings.swap_words_2_3 = config.slave.swap_words_3_4;
      plan.emplace_back(settings, CanNode::Drives{});
      at = plan.end() - 1;
    } else if (!gateway || at->first.can.connection != CanConnection::kGateway || at->second[place] != nullptr) {
      throw ConfigError("drive " + config.name + ": node " + std::to_string(config.slave.address) + " with inverter " +
                        std::to_string(place + 1) +
                        " is taken; expected a node of its own, or behind one gateway an inverter number of its own");
    }
    at->second[place] = &drive;
    node_of_.push_back(static_cast<std::size_t>(at - plan.begin()));
  }
  for (const auto& [settings, drives] : plan) nodes_.push_back(std::make_unique<CanNode>(settings, drives, referee_));
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
    for (const auto& node : nodes_) node->advance(span, sink);
  }
}

void CanStations::receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept {
  if (judge == Judge::kYes) {
    referee_.masterFrame(frame);
    CanNode::Claim claim = CanNode::Claim::kNone;
    for (const auto& node : nodes_) claim = std::max(claim, node->claim(frame.id));
    const bool guarding = frame.remote && frame.id > kErrorControl;
    if (claim == CanNode::Claim::kSends && !guarding) {
      referee_.broken(frame.remote ? CanRule::kRemotePdo : CanRule::kIdOfANode);
    } else if (claim == CanNode::Claim::kNone && !hasMeaning(frame.id) && !frame.extended) {
      referee_.broken(CanRule::kUnknownId);
    }
  }
  for (const auto& node : nodes_) node->receive(frame, judge == Judge::kYes, sink);
}

void CanStations::delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept {
  // A heartbeat that waited for the bus may tell what is over already: it is nothing to judge by.
  const CanNode* sender =
      frame.id > kErrorControl ? find(static_cast<std::uint8_t>(frame.id - kErrorControl)) : nullptr;
  const bool stale = sender != nullptr && sender->state() == NmtState::kOperational;
  if (to_master && !stale) referee_.delivered(frame);
  for (const auto& node : nodes_) {
    if (node->claim(frame.id) != CanNode::Claim::kSends) node->receive(frame, false, sink);
  }
}

void CanStations::stoodStill() noexcept {
  for (const auto& node : nodes_) node->stoodStill();
}

bool CanStations::anyAlive() const noexcept {
  return std::any_of(nodes_.begin(), nodes_.end(), [](const auto& node) { return node->alive(); });
}

CanNode* CanStations::find(std::uint8_t id) noexcept {
  const auto at = std::find_if(nodes_.begin(), nodes_.end(), [&](const auto& node) { return node->id() == id; });
  return at == nodes_.end() ? nullptr : at->get();
}

}  // namespace nord_driver::sim
