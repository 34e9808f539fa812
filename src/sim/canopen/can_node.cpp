// Network management, error control and emergencies of a node; its data are in can_node_data.cpp.

#include "sim/canopen/can_node.h"

#include <algorithm>

#include "sim/canopen/can_factory_settings.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kNmtStart = 0x01;
constexpr std::uint8_t kNmtStop = 0x02;
constexpr std::uint8_t kNmtPreOperational = 0x80;
constexpr std::uint8_t kNmtResetNode = 0x81;
constexpr std::uint8_t kNmtResetCommunication = 0x82;

constexpr std::uint32_t kErrorControl = 0x700;
constexpr std::uint8_t kGenericError = 0x01;  // 1001h; BU 0060 p. 93: 00 81 01 ...
// CiA 402: drive (0192h) of the kind frequency converter. What 1000h says in NORD's devices is printed nowhere.
constexpr std::uint32_t kCia402FrequencyConverter = 0x00010192;

/// The EMCY of an inverter that is missing behind the gateway: 1001h is set then (BU 0260 p. 50), no row of the table
/// of BU 0060 p. 93 fits, so it is "unknown to the module".
constexpr std::uint16_t kMissing = 0xFFFF;

}  // namespace

CanNode::CanNode(const CanNodeSettings& settings, const Drives& drives, CanReferee& referee)
    : settings_(settings),
      drives_(drives),
      referee_(referee),
      identity_(settings.can.identity),
      communication_objects_(communication_, emergency_, identity_, settings.can.connection),
      pdo_objects_(communication_, *this, settings.can.fixed_mapping,
                   settings.can.connection == CanConnection::kGateway ? SdoAbort::kNotStored : SdoAbort::kValueRange),
      process_(drives, settings.can.connection) {
  if (settings.can.connection == CanConnection::kGateway) module_.emplace();
  for (std::size_t i = 0; i < servers_.size(); ++i) servers_[i].bind(*this, i);
  const auto missing = std::count(drives.begin(), drives.end(), nullptr);
  referee_.nodeExists(settings_.node, drives.size() - static_cast<std::size_t>(missing));
}

Supply CanNode::supply() const noexcept {
  switch (settings_.can.connection) {
    case CanConnection::kGateway:
      return Supply::kOwn;
    case CanConnection::kOption:
      return Supply::kInverter;
    default:
      return Supply::kPartOfInverter;
  }
}

void CanNode::setPowered(bool on) noexcept {
  supply_ = on;
  showLinks();
}

bool CanNode::hasSupply() const noexcept {
  return supply_ &&
         std::any_of(drives_.begin(), drives_.end(), [](DriveUnit* drive) { return drive && drive->plugged(); });
}

void CanNode::initialise(Duration time, bool application) noexcept {
  alive_ = true;
  enter(NmtState::kInitialising);
  starting_ = time;
  if (application) {
    // The drive profile exists on the technology units only, not on the CAN port of the inverter (BU 0060 p. 57).
    const DriveUnit* drive = drives_[0];
    const bool cia402 =
        settings_.can.connection == CanConnection::kOption && drive != nullptr && drive->parameters().value(551) == 1;
    if (!factory_for_cia402_ || *factory_for_cia402_ != cia402) {
      factory_for_cia402_ = cia402;
      communication_objects_.useFactorySettings(factoryCommunication(
          settings_.node, settings_.can.connection, cia402, settings_.swap_words_2_3, settings_.can.servers_set));
    }
    communication_objects_.setDeviceType(settings_.can.device_type.value_or(cia402 ? kCia402FrequencyConverter : 0));
    process_.setCia402(cia402);
    process_.clear();
    if (module_) module_->restart();
    emergency_.forget();
  }
  communication_ = communication_objects_.saved();
  for (Server& server : servers_) {
    server.protocol.reset();
    server.answer.reset();
  }
  consumers_ = {};
  guarded_ = false;
  toggle_ = false;
}

void CanNode::enter(NmtState state) noexcept {
  if (state == NmtState::kOperational && state_ != state) {
    for (CanTpdo& tpdo : tpdos_) tpdo.start();
    process_.beginExchange();
  }
  if (state != NmtState::kOperational) waiting_for_sync_ = {};
  state_ = state;
  communication_objects_.setPreOperational(state == NmtState::kPreOperational);
}

void CanNode::bootUp(CanSink& sink) noexcept {
  const FixedBytes<1> nothing{0};
  ++counters_.boot_ups;
  since_heartbeat_ = Duration::zero();
  enter(NmtState::kPreOperational);
  send(kErrorControl + id(), nothing, sink);
}

void CanNode::receive(const CanFrame& frame, bool judged, CanSink& sink) noexcept {
  if (!alive_ || state_ == NmtState::kInitialising || frame.extended) return;
  judged_ = judged;
  if (frame.id == 0) return manage(frame);
  if (frame.id == kErrorControl + id()) return answerGuard(frame, judged, sink);
  if (frame.remote) return;  // bit 30 of every COB-ID is 1: no PDO is given on request
  if (frame.id > kErrorControl && frame.id <= kErrorControl + 127) return consumeHeartbeat(frame);
  if (frame.id == (communication_.sync_cob_id & kCobIdMask)) return synchronise(sink);
  if (state_ == NmtState::kOperational) {
    for (const PdoSettings& pdo : communication_.rpdos) {
      if (pdo.enabled() && pdo.id() == frame.id) takePdo(pdo, frame, judged);
    }
  } else if (judged && claim(frame.id) == Claim::kReceives) {
    for (const PdoSettings& pdo : communication_.rpdos) {
      if (pdo.enabled() && pdo.id() == frame.id) referee_.rpdo(id(), frame.size, pdo.length());
    }
  }
  for (std::size_t i = 0; i < communication_.servers.size(); ++i) {
    const SdoCobIds& ids = communication_.servers[i];
    if (ids.request == frame.id) answerSdo(servers_[i], ids, frame, judged);
  }
}

void CanNode::manage(const CanFrame& frame) noexcept {
  if (frame.remote || frame.size != 2 || (frame.data[1] != 0 && frame.data[1] != id())) return;
  switch (frame.data[0]) {
    case kNmtStart:
      return enter(NmtState::kOperational);
    case kNmtStop:
      return enter(NmtState::kStopped);
    case kNmtPreOperational:
      return enter(NmtState::kPreOperational);
    case kNmtResetNode:
      return initialise(settings_.start_time, true);
    case kNmtResetCommunication:
      return initialise(settings_.reset_time, false);
    default:
      return;
  }
}

std::uint8_t CanNode::guardByte() noexcept {
  const auto byte = static_cast<std::uint8_t>((toggle_ ? 0x80u : 0u) | static_cast<unsigned>(state_));
  toggle_ = !toggle_;
  return byte;
}

// Heartbeat wins when both are set (CiA 301 7.2.8.3).
void CanNode::answerGuard(const CanFrame& frame, bool judged, CanSink& sink) noexcept {
  if (!frame.remote) return;
  if (communication_.heartbeat != 0) {
    if (judged) referee_.broken(CanRule::kGuardingBesideHeartbeat);
    return;
  }
  guarded_ = true;
  since_guard_ = Duration::zero();
  const FixedBytes<1> answer{guardByte()};
  send(kErrorControl + id(), answer, sink);
}

void CanNode::consumeHeartbeat(const CanFrame& frame) noexcept {
  for (std::size_t i = 0; i < consumers_.size(); ++i) {
    const std::uint32_t entry = communication_.consumers[i];
    if ((entry & 0xFFFFu) == 0 || (entry >> 16) != frame.id - kErrorControl) continue;
    consumers_[i] = {true, Duration::zero()};
  }
}

void CanNode::watchMaster(Duration span) noexcept {
  if (module_) module_->watch(span, drives_);
  since_guard_ += span;
  const Duration life = std::chrono::milliseconds{communication_.guard_time} * communication_.life_factor;
  if (guarded_ && life > Duration::zero() && since_guard_ >= life) {
    guarded_ = false;
    masterLost();
  }
  for (std::size_t i = 0; i < consumers_.size(); ++i) {
    Consumer& consumer = consumers_[i];
    consumer.since += span;
    const std::chrono::milliseconds limit{communication_.consumers[i] & 0xFFFFu};
    if (!consumer.heard || limit == Duration::zero() || consumer.since < limit) continue;
    consumer.heard = false;  // watched again from the next heartbeat on
    masterLost();
  }
}

// The inverters trip unless P513 = -0.1, behind a gateway unless its P151 = -1; the node falls back to pre-operational
// (CiA 301 7.5.2.32, 1029h as delivered).
void CanNode::masterLost() noexcept {
  ++counters_.masters_lost;
  if (state_ == NmtState::kOperational) enter(NmtState::kPreOperational);
  for (std::size_t place = 0; place < drives_.size(); ++place) {
    DriveUnit* drive = drives_[place];
    if (drive == nullptr) continue;
    exchanged_[place].control_before_loss = process_.control(place);
    exchanged_[place].status_at_loss = drive->inverter().statusWord();
    if (!module_ && drive->inverterLink()) drive->inverter().masterLost();
  }
  if (module_) module_->masterLost(drives_);
}

void CanNode::advance(Duration span, CanSink& sink) noexcept {
  master_may_look_ = std::max(Duration::zero(), master_may_look_ - span);
  if (hasSupply() != alive_) {
    if (alive_) {
      alive_ = false;
      enter(NmtState::kInitialising);
      showStatus();
      return;
    }
    initialise(settings_.start_time, true);
  }
  if (!alive_) return;
  if (state_ == NmtState::kInitialising) {
    starting_ -= span;
    if (starting_ <= Duration::zero()) bootUp(sink);
    return;
  }
  advanceServers(span, sink);
  watchMaster(span);
  watchFaults(sink);
  sendHeartbeat(span, sink);
  sendPdos(span, sink);
  showStatus();
}

void CanNode::sendHeartbeat(Duration span, CanSink& sink) noexcept {
  since_heartbeat_ += span;
  const std::chrono::milliseconds period{communication_.heartbeat};
  if (period == Duration::zero() || since_heartbeat_ < period) return;
  since_heartbeat_ = Duration::zero();
  const FixedBytes<1> state{static_cast<std::uint8_t>(state_)};
  send(kErrorControl + id(), state, sink);
}

// One message when an inverter's fault comes, one with code 0 when it is gone (BU 0060 p. 93).
void CanNode::watchFaults(CanSink& sink) noexcept {
  if (state_ == NmtState::kStopped) return;
  std::array<std::uint16_t, CanProcessObjects::kInverters> faults{};
  bool any = false;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const DriveUnit* drive = drives_[i];
    if (drive == nullptr) continue;
    const bool missing = !drive->inverter().powered() || !drive->inverterLink();
    faults[i] = missing ? kMissing : drive->inverter().faultNumber();
    any = any || faults[i] != 0;
  }
  emergency_.setRegister(any ? kGenericError : 0);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (faults[i] == told_faults_[i]) continue;
    told_faults_[i] = faults[i];
    const std::uint16_t code = faults[i] == 0 ? 0 : emergencyCode(faults[i]);
    if (code != 0) emergency_.remember(code);
    const bool gateway = settings_.can.connection == CanConnection::kGateway;
    const FixedBytes<8> data{static_cast<std::uint8_t>(code & 0xFFu),
                             static_cast<std::uint8_t>(code >> 8),
                             emergency_.errorRegister(),
                             static_cast<std::uint8_t>(gateway ? i : 0),  // BU 0260 p. 78
                             0,
                             0,
                             0,
                             0};
    ++counters_.emergencies;
    if ((communication_.emergency_cob_id & kCobIdOff) == 0) {
      send(communication_.emergency_cob_id & kCobIdMask, data, sink);
    }
  }
}

// P746: module id 0Ch in the high byte, bit 0 ready, bit 1 operational. P748: bit 0 supply, 6 CANopen, 8 boot-up sent,
// 9 and 10 the NMT state (BU 0060 p. 89 and 91).
void CanNode::showStatus() noexcept {
  const bool operational = state_ == NmtState::kOperational;
  const int nmt = operational ? 2 : state_ == NmtState::kPreOperational ? 1 : 0;
  for (std::size_t place = 0; place < drives_.size(); ++place) {
    DriveUnit* drive = drives_[place];
    if (drive == nullptr) continue;
    drive->parameters().show(746, 0, 0x0C01 | (operational ? 2 : 0));
    drive->parameters().show(748, 0, 0x0141 | nmt << 9);
  }
}

ExchangeCounters CanNode::countersOf(unsigned place) const noexcept {
  ExchangeCounters counters = exchanged_[place];
  counters.telegrams = counters_.rpdos + counters_.sdo_requests;
  counters.data_exchanges = counters_.rpdos;
  counters.watchdog_trips = counters_.masters_lost;
  counters.zero_control_words = counters_.zero_control_words;
  counters.last_control = process_.control(place);
  return counters;
}

void CanNode::send(std::uint32_t id, ByteView data, CanSink& sink) noexcept {
  if (!mute()) sink.transmit(dataFrame(id, data));
}

void CanNode::mappingOrderBroken() noexcept {
  if (judged_) referee_.broken(CanRule::kMappingOrder);
}

CanNode::Claim CanNode::claim(std::uint32_t id) const noexcept {
  if (id == kErrorControl + settings_.node || id == (communication_.emergency_cob_id & kCobIdMask))
    return Claim::kSends;
  for (const PdoSettings& pdo : communication_.tpdos) {
    if (pdo.enabled() && pdo.id() == id) return Claim::kSends;
  }
  for (const SdoCobIds& server : communication_.servers) {
    if (server.answer == id) return Claim::kSends;
    if (server.request == id) return Claim::kReceives;
  }
  for (const PdoSettings& pdo : communication_.rpdos) {
    if (pdo.enabled() && pdo.id() == id) return Claim::kReceives;
  }
  return Claim::kNone;
}

}  // namespace nord_driver::sim
