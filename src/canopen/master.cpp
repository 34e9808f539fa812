#include "canopen/master.h"

#include <algorithm>
#include <array>

namespace nord_driver::canopen {
namespace {

using Kind = CobIdUse::Kind;

MasterConfig checked(const MasterConfig& config) {
  MasterConfig complete = completed(config);
  checkConfig(complete);
  return complete;
}

constexpr std::uint8_t kToggle = 0x80;

}  // namespace

Master::Master(const MasterConfig& config)
    : config_(checked(config)),
      uses_(cobIdTable(config_)),
      watch_(counters_, events_),
      process_(receivePdosOf(config_)) {
  nodes_.reserve(config_.nodes.size());
  for (std::size_t i = 0; i < config_.nodes.size(); ++i) {
    const NodeConfig& node = config_.nodes[i];
    nodes_.push_back(std::make_unique<Node>(i, node, config_.own_id.value_or(std::uint8_t{0}), config_.ask_interval,
                                            counters_, events_));
    for (std::size_t server = 0; server < node.sdo_servers.size(); ++server) servers_.emplace_back(i, server);
  }
}

void Master::restart(Instant now) noexcept {
  now_ = now;
  given_ = Given{};
  process_.clear();
  stuck_ = false;
  watch_.restart();
  next_server_ = 0;
  deadline_.reset();
  boot_up_due_ = config_.own_id.has_value();
  heartbeat_due_ = false;
  next_heartbeat_.reset();
  if (config_.own_id && config_.heartbeat_time > Duration::zero()) next_heartbeat_ = now + config_.heartbeat_time;
  expect(next_heartbeat_);
  for (const auto& node : nodes_) {
    node->restart(now);
    touched(*node);
  }
}

void Master::handleFrame(const CanFrame& frame, Instant now) noexcept {
  now_ = now;
  ++counters_.frames_received;
  if (frame.extended || frame.id >= kCobIds || frame.size > kCanDataLength) {
    ++counters_.foreign;
    return;
  }
  const CobIdUse& use = uses_[frame.id];
  if (frame.remote) {
    handleRemote(use, frame, now);
  } else {
    dispatch(use, frame, now);
  }
}

bool Master::noteOtherMaster(const CanFrame& frame, Instant now) noexcept {
  now_ = now;
  ++counters_.frames_received;
  if (frame.extended || frame.id >= kCobIds || frame.size > kCanDataLength) return false;
  const CobIdUse& use = uses_[frame.id];
  if (use.kind == Kind::kTransmitPdo && !frame.remote) nodes_[use.node]->keepTransmitPdo(use.item, frame, now);
  if (!isOfOtherMaster(use, frame)) return false;
  watch_.secondMaster(frame, use.kind, now);
  return true;
}

bool Master::isOfOtherMaster(const CobIdUse& use, const CanFrame& frame) const noexcept {
  switch (use.kind) {
    case Kind::kNmt:
      return isNmtCommand(frame) &&
             (frame.data[1] == 0 ||
              std::any_of(nodes_.begin(), nodes_.end(), [&](const auto& node) { return node->id() == frame.data[1]; }));
    case Kind::kSync:
    case Kind::kReceivePdo:
    case Kind::kSdoRequest:
      return !frame.remote;
    case Kind::kTransmitPdo:
      return frame.remote;
    case Kind::kErrorControl:
      // Only the answer to a question bears a toggle bit; the question itself may have been lost.
      return frame.remote || (frame.size == 1 && (frame.data[0] & kToggle) != 0);
    default:
      return false;
  }
}

void Master::dispatch(const CobIdUse& use, const CanFrame& frame, Instant now) noexcept {
  switch (use.kind) {
    case Kind::kTransmitPdo:
      return nodes_[use.node]->handleTransmitPdo(use.item, frame, now);
    case Kind::kErrorControl:
      nodes_[use.node]->handleErrorControl(frame, now);
      return touched(*nodes_[use.node]);
    case Kind::kSdoAnswer:
      nodes_[use.node]->handleSdo(use.item, frame, now);
      return touched(*nodes_[use.node]);
    case Kind::kEmergency:
      return nodes_[use.node]->handleEmergency(frame, now);
    case Kind::kNmt:
      return handleNmt(frame, now);
    case Kind::kReceivePdo:
      nodes_[use.node]->handleForeignPdo(now);
      return watch_.secondMaster(frame, use.kind, now);
    case Kind::kSdoRequest:
      nodes_[use.node]->handleForeignRequest();
      return watch_.secondMaster(frame, use.kind, now);
    case Kind::kSync:
      return watch_.secondMaster(frame, use.kind, now);
    case Kind::kOwnHeartbeat:
      return watch_.ownIdUsed(frame, now);
    case Kind::kForeignNode:
      return watch_.foreignNode(static_cast<std::uint8_t>(use.item), now);
    case Kind::kForeign:
      ++counters_.foreign;
      return;
    case Kind::kIgnored:
      return;
  }
}

/// Only a master asks by remote frames here: for the state of a node (guarding), or for a PDO.
void Master::handleRemote(const CobIdUse& use, const CanFrame& frame, Instant now) noexcept {
  switch (use.kind) {
    case Kind::kErrorControl:
      nodes_[use.node]->guard().handleForeignQuestion();
      return watch_.secondMaster(frame, use.kind, now);
    case Kind::kTransmitPdo:
      return watch_.secondMaster(frame, use.kind, now);
    case Kind::kNmt:
      return watch_.malformedNmt(frame, now);
    case Kind::kEmergency:
    case Kind::kSdoAnswer:
      return nodes_[use.node]->report().malformed(frame, "nobody asks for this by a remote frame", now);
    default:
      ++counters_.foreign;
  }
}

void Master::handleNmt(const CanFrame& frame, Instant now) noexcept {
  if (!isNmtCommand(frame)) return watch_.malformedNmt(frame, now);
  const bool to_us = isOfOtherMaster(uses_[frame.id], frame) || frame.data[1] == config_.own_id;
  to_us ? watch_.secondMaster(frame, Kind::kNmt, now) : watch_.foreignCommand(frame, now);
  for (const auto& node : nodes_) {
    if (frame.data[1] != 0 && frame.data[1] != node->id()) continue;
    node->handleForeignCommand(static_cast<NmtCommand>(frame.data[0]), now);
    touched(*node);
  }
}

void Master::poll(Instant now) noexcept {
  now_ = now;
  if (!deadline_ || now < *deadline_) return;
  deadline_.reset();
  if (next_heartbeat_ && now >= *next_heartbeat_) {
    heartbeat_due_ = true;
    // A late look sends one, not one for each that was missed.
    *next_heartbeat_ += config_.heartbeat_time;
    if (*next_heartbeat_ <= now) next_heartbeat_ = now + config_.heartbeat_time;
  }
  expect(next_heartbeat_);
  for (const auto& node : nodes_) {
    node->poll(now);
    touched(*node);
  }
}

std::optional<Instant> Master::nextDeadline() const noexcept {
  return deadline_;
}

void Master::expect(std::optional<Instant> deadline) noexcept {
  deadline_ = earlier(deadline_, deadline);
}

void Master::touched(const Node& node) noexcept {
  expect(node.nextDeadline());
  nmt_maybe_ = true;
  error_control_maybe_ = true;
  sdo_maybe_ = true;
}

bool Master::pollTransmit(CanFrame& frame) noexcept {
  if (stuck_) return false;
  const bool given = pollNmt() || pollProcessData() || pollErrorControl() || pollSdoFrame();
  if (!given) {
    given_.kind = Given::Kind::kNothing;
    return false;
  }
  frame = given_.frame;
  ++counters_.frames_sent;
  return true;
}

void Master::give(Given::Kind kind, std::size_t node, std::size_t item, const CanFrame& frame) noexcept {
  given_ = {kind, node, item, false, frame};
}

bool Master::pollNmt() noexcept {
  if (!nmt_maybe_) return false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    std::optional<NmtCommand>& command = nodes_[i]->command();
    if (!command) continue;
    give(Given::Kind::kNmt, i, static_cast<std::size_t>(*command), nmtFrame(*command, nodes_[i]->id()));
    // Whatever it has said while the command waited: it hears no RPDO any more.
    if (stateAfter(*command) == NmtState::kUnknown) nodes_[i]->report().status().nmt = NmtState::kUnknown;
    command.reset();
    return true;
  }
  nmt_maybe_ = false;
  return false;
}

bool Master::pollErrorControl() noexcept {
  if (boot_up_due_ || heartbeat_due_) {
    const NmtState state = boot_up_due_ ? NmtState::kBootUp : NmtState::kOperational;
    const std::array<std::uint8_t, 1> byte{static_cast<std::uint8_t>(state)};
    give(Given::Kind::kOwnHeartbeat, 0, byte[0], dataFrame(kErrorControlBase + *config_.own_id, byte));
    (boot_up_due_ ? boot_up_due_ : heartbeat_due_) = false;
    return true;
  }
  if (!error_control_maybe_) return false;
  CanFrame frame;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i]->guard().pollTransmit(frame)) continue;
    give(Given::Kind::kGuard, i, 0, frame);
    return true;
  }
  error_control_maybe_ = false;
  return false;
}

bool Master::pollSdoFrame() noexcept {
  if (!sdo_maybe_) return false;
  CanFrame frame;
  for (std::size_t tried = 0; tried < servers_.size(); ++tried) {
    const auto [node, server] = servers_[next_server_];
    next_server_ = (next_server_ + 1) % servers_.size();
    if (!nodes_[node]->ports()[server].pollTransmit(frame)) continue;
    give(Given::Kind::kSdo, node, server, frame);
    return true;
  }
  sdo_maybe_ = false;
  return false;
}

void Master::notSent() noexcept {
  const Given given = given_;
  given_.kind = Given::Kind::kNothing;
  if (given.kind == Given::Kind::kNothing) return;
  --counters_.frames_sent;
  ++counters_.not_sent;
  Node& node = *nodes_[given.node];
  switch (given.kind) {
    case Given::Kind::kNothing:
      break;
    case Given::Kind::kNmt:
      if (!node.command()) node.command() = static_cast<NmtCommand>(given.item);
      nmt_maybe_ = true;
      break;
    case Given::Kind::kReceivePdo:
      --node.report().status().counters.receive_pdos;
      drop({static_cast<std::uint8_t>(given.node), static_cast<std::uint16_t>(given.item), given.unheard});
      break;
    case Given::Kind::kSync:
      --counters_.syncs;
      drop(kSyncOfCycle);
      break;
    case Given::Kind::kOwnHeartbeat:
      (given.item == 0 ? boot_up_due_ : heartbeat_due_) = true;
      break;
    case Given::Kind::kGuard:
      node.guard().notSent();
      error_control_maybe_ = true;
      break;
    case Given::Kind::kSdo:
      node.ports()[given.item].putBack(given.frame);
      sdo_maybe_ = true;
      break;
  }
  dropProcessData();
}

void Master::setReceivePdo(std::size_t node, std::size_t pdo, ByteView bytes) noexcept {
  nodes_[node]->receivePdos()[pdo].set(bytes);
}

const PdoValue& Master::transmitPdo(std::size_t node, std::size_t pdo) const noexcept {
  return nodes_[node]->transmitPdo(pdo);
}

bool Master::submitSdo(std::size_t node, std::size_t server, const SdoRequest& request) noexcept {
  if (!nodes_[node]->ports()[server].submit(SdoOwner::kUser, request, now_)) return false;
  touched(*nodes_[node]);
  return true;
}

std::optional<NodeSdoAnswer> Master::pollSdo() noexcept {
  for (const auto& [node, server] : servers_) {
    const std::optional<SdoAnswer> answer = nodes_[node]->ports()[server].take(SdoOwner::kUser);
    if (!answer) continue;
    touched(*nodes_[node]);
    if (answer->end == SdoEnd::kTimedOut) ++counters_.sdo_timeouts;
    if (answer->end == SdoEnd::kAbortedByServer) ++counters_.sdo_aborts;
    return NodeSdoAnswer{node, server, *answer};
  }
  return std::nullopt;
}

}  // namespace nord_driver::canopen
