#include "canopen/node.h"

#include <algorithm>

namespace nord_driver::canopen {
namespace {

std::vector<SdoPort> portsOf(const NodeConfig& config) {
  std::vector<SdoPort> ports;
  ports.reserve(config.sdo_servers.size());
  for (const SdoChannel& channel : config.sdo_servers) ports.emplace_back(channel, config.sdo_timeout);
  return ports;
}

}  // namespace

Node::Node(std::size_t index, const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, Counters& counters,
           CanopenEvents& events)
    : config_(config),
      report_(index, counters, events),
      ports_(portsOf(config)),
      boot_(config, own_id, ask_interval, report_, ports_.front(), timers_),
      guard_(config.id, config.error_control.guard_time, config.error_control.life_time_factor, timers_),
      pace_(config.error_control.heartbeat_time) {
  for (const PdoConfig& pdo : config.receive_pdos) receive_pdos_.emplace_back(pdo);
  for (const PdoConfig& pdo : config.transmit_pdos) transmit_pdos_.push_back({mappedLength(pdo), pdo.enabled, {}});
}

void Node::restart(Instant now) noexcept {
  for (SdoPort& port : ports_) {
    port.cancel(SdoOwner::kUser, now);
    port.cancel(SdoOwner::kBoot, now);
  }
  report_.status().emergencies.clear();
  report_.status().other_commands_at.reset();
  boot_.restart(now);
  for (ReceivePdoSlot& pdo : receive_pdos_) pdo.forget();
  settle(now);
}

bool Node::takesReceivePdos(Instant now) noexcept {
  if (answered_ || now - report_.status().since >= config_.first_answer_timeout) return true;
  // Not in this cycle: its answer would replace the first one before anybody has read that.
  answered_ = std::none_of(transmit_pdos_.begin(), transmit_pdos_.end(),
                           [](const TransmitPdo& pdo) { return pdo.enabled && pdo.value.count == 0; });
  return false;
}

void Node::release(Instant now) noexcept {
  for (SdoPort& port : ports_) port.cancel(SdoOwner::kUser, now);
  boot_.release(now);
  settle(now);
}

void Node::handleErrorControl(const CanFrame& frame, Instant now) noexcept {
  if (frame.size != 1) return report_.malformed(frame, "a state is one byte", now);
  const std::uint8_t value = frame.data[0];
  if (nmtStateOf(value) == NmtState::kUnknown) return report_.malformed(frame, "no such state", now);
  report_.status().heard_at = now;
  handleStateByte(value, now);
  settle(now);
}

void Node::handleStateByte(std::uint8_t value, Instant now) noexcept {
  if (nmtStateOf(value) == NmtState::kBootUp) return boot_.handleBootUp(now);
  ++report_.status().counters.heartbeats;
  const bool alive = !guard_.running() || acceptGuardAnswer(value, now);
  // A wrong toggle bit, or an answer to somebody else's question, is no sign of life; the state is the node's all the
  // same.
  const bool left = operational() && nmtStateOf(value) != NmtState::kOperational;
  if (!alive && !left) return;
  if (alive && timers_.isSet(NodeTimer::kHeartbeat)) {
    timers_.set(NodeTimer::kHeartbeat, now + config_.error_control.heartbeat_timeout);
    if (pace_.handle(now)) boot_.handleDoubleAnswers(now);
  }
  boot_.handleState(nmtStateOf(value), now);
}

bool Node::acceptGuardAnswer(std::uint8_t value, Instant now) noexcept {
  switch (guard_.handle(value, now)) {
    case GuardAnswer::kAccepted:
      told_toggle_ = false;
      return true;
    case GuardAnswer::kNotAsked:
      if (guard_.answeredTwice()) boot_.handleDoubleAnswers(now);
      return false;
    case GuardAnswer::kWrongToggle:
      break;
  }
  ++report_.status().counters.toggle_errors;
  if (!told_toggle_) {
    Sentence text;
    text.format("answered to guarding with the toggle bit of the answer before (%02Xh)", unsigned{value});
    report_.tell(CanopenEventKind::kToggleError, text, value, now);
  }
  told_toggle_ = true;
  return false;
}

void Node::handleEmergency(const CanFrame& frame, Instant now) noexcept {
  EmergencyHistory& history = report_.status().emergencies;
  if (!history.handle(frame, now)) return report_.malformed(frame, "an emergency has eight bytes", now);
  ++report_.status().counters.emergencies;
  const Emergency& emergency = history.back(0);
  Sentence text;
  text.format("emergency %04Xh, error register %02Xh, manufacturer's bytes %02X %02X %02X %02X %02X",
              unsigned{emergency.code}, unsigned{emergency.error_register}, unsigned{emergency.manufacturer[0]},
              unsigned{emergency.manufacturer[1]}, unsigned{emergency.manufacturer[2]},
              unsigned{emergency.manufacturer[3]}, unsigned{emergency.manufacturer[4]});
  report_.tell(CanopenEventKind::kEmergency, text,
               (std::uint32_t{emergency.code} << 8) | std::uint32_t{emergency.error_register}, now);
}

void Node::handleTransmitPdo(std::size_t pdo, const CanFrame& frame, Instant now) noexcept {
  TransmitPdo& received = transmit_pdos_[pdo];
  if (report_.status().stops_first) return keepTransmitPdo(pdo, frame, now);
  // What comes before the start may be laid out otherwise.
  if (watch_ == NodeBoot::Watch::kOff) return;
  const ByteView bytes = frame.bytes();
  if (bytes.size() < received.length) return report_.malformed(frame, "a TPDO shorter than its mapping", now);
  // Of more bytes than mapped the first are taken (CiA 301 7.2.2.2).
  received.value.bytes.clear();
  for (const std::uint8_t byte : bytes.sub(0, received.length != 0 ? received.length : kCanDataLength)) {
    received.value.bytes.push_back(byte);
  }
  received.value.at = now;
  ++received.value.count;
  ++report_.status().counters.transmit_pdos;
  if (timers_.isSet(NodeTimer::kSilence)) timers_.set(NodeTimer::kSilence, now + config_.silence);
}

// It may be mapped otherwise than it will be.
void Node::keepTransmitPdo(std::size_t pdo, const CanFrame& frame, Instant now) noexcept {
  PdoValue& value = transmit_pdos_[pdo].value;
  value.bytes.clear();
  for (const std::uint8_t byte : frame.bytes()) value.bytes.push_back(byte);
  value.at = now;
  ++value.count;
}

void Node::handleSdo(std::size_t server, const CanFrame& frame, Instant now) noexcept {
  SdoPort& port = ports_[server];
  const SdoCounters before = port.counters();
  port.handle(frame, now);
  if (port.counters().stale != before.stale) {
    report_.busCounters().stray_sdo += port.counters().stale - before.stale;
    if (server == 0) boot_.handleStrayAnswer(frame.bytes() == last_answer_.bytes(), now);
  }
  if (server == 0) last_answer_ = frame;
  if (port.counters().malformed != before.malformed) report_.malformed(frame, "an SDO has eight bytes", now);
  settle(now);
}

void Node::handleForeignCommand(NmtCommand command, Instant now) noexcept {
  boot_.handleForeignCommand(command, now);
  settle(now);
}

void Node::handleForeignPdo(Instant now) noexcept {
  ++report_.status().counters.foreign_receive_pdos;
  report_.status().other_commands_at = now;
}

void Node::poll(Instant now) noexcept {
  for (SdoPort& port : ports_) port.poll(now);
  if (guard_.poll(now)) ++report_.status().counters.missed_guards;
  if (watch_ == NodeBoot::Watch::kWatch) tellLoss(now);
  settle(now);
}

void Node::tellLoss(Instant now) noexcept {
  Sentence why;
  if (timers_.isOver(NodeTimer::kHeartbeat, now)) {
    why.format("sent no heartbeat for %.0f ms", toSeconds(config_.error_control.heartbeat_timeout) * 1e3);
  } else if (guard_.expired()) {
    why.format("gave no good answer to guarding for %.0f ms",
               toSeconds(config_.error_control.guard_time * config_.error_control.life_time_factor) * 1e3);
  } else if (timers_.isOver(NodeTimer::kSilence, now)) {
    why.format("sent no process data for %.0f ms", toSeconds(config_.silence) * 1e3);
  } else {
    return;
  }
  boot_.handleLoss(why, now);
}

/// The start-up goes on with what came; error control follows it.
void Node::settle(Instant now) noexcept {
  followWatch(now);
  boot_.poll(now);
  followWatch(now);
  if (boot_.takeGuardQuestion()) guard_.askOnce();
}

void Node::followWatch(Instant now) noexcept {
  const NodeBoot::Watch watch = boot_.watch();
  if (watch == watch_) return;
  const bool begins = watch_ == NodeBoot::Watch::kOff;
  watch_ = watch;
  const ErrorControlMode mode = config_.error_control.mode;
  if (begins) {
    for (TransmitPdo& pdo : transmit_pdos_) pdo.value = PdoValue{};
    told_toggle_ = false;
    answered_ = false;
    if (mode == ErrorControlMode::kGuarding) guard_.start(boot_.fresh(), now);
  }
  if (watch == NodeBoot::Watch::kWatch && mode == ErrorControlMode::kHeartbeat) {
    timers_.set(NodeTimer::kHeartbeat, now + config_.error_control.heartbeat_timeout);
    pace_.start();
  }
  if (watch == NodeBoot::Watch::kWatch && config_.silence > Duration::zero()) {
    timers_.set(NodeTimer::kSilence, now + config_.silence);
  }
  // Taken for granted: once lost, by its silence or with the interface, it may still hear what stops its drive.
  if (watch == NodeBoot::Watch::kWatch && mode == ErrorControlMode::kNone) {
    report_.status().nmt = NmtState::kOperational;
  }
  if (watch != NodeBoot::Watch::kOff) return;
  timers_.stop(NodeTimer::kHeartbeat);
  timers_.stop(NodeTimer::kSilence);
  guard_.stop();
  for (ReceivePdoSlot& pdo : receive_pdos_) pdo.forget();
}

std::optional<Instant> Node::nextDeadline() const noexcept {
  std::optional<Instant> next = timers_.nextTimeout();
  for (const SdoPort& port : ports_) next = earlier(next, port.nextDeadline());
  return next;
}

}  // namespace nord_driver::canopen
