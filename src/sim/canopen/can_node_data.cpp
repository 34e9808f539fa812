// What a node exchanges: SDOs, PDOs, SYNC.

#include <algorithm>

#include "sim/canopen/can_node.h"

namespace nord_driver::sim {

namespace {

/// How often a module looks at its inverter: process data take 1-3 ms (BU 0060 p. 50).
constexpr Duration kSample = std::chrono::milliseconds{2};
/// Control words the master sent before it learnt of a standstill are taken first, and it may have stood still itself.
constexpr Duration kMasterMayLook = std::chrono::milliseconds{100};
constexpr std::uint8_t kLongestSynchronous = 240;

}  // namespace

void CanNode::Server::bind(CanNode& node, std::size_t inverter) noexcept {
  node_ = &node;
  inverter_ = inverter;
  DriveUnit* drive = node.drives_[inverter];
  if (drive != nullptr) parameters_.emplace(drive->parameters(), drive, node.settings_.can.array_sub_by_table);
}

CanObjects* CanNode::Server::part(std::uint16_t index) noexcept {
  if (CanPdoObjects::has(index)) return &node_->pdo_objects_;
  if (index < 0x2000) return &node_->communication_objects_;
  if (node_->module_ && CanGatewayModule::hasParameter(index)) return &node_->module_->objects();
  if (CanParameterObjects::has(index)) return parameters_ ? &*parameters_ : nullptr;
  return node_->process_.has(index) ? &node_->process_ : nullptr;
}

SdoAbort CanNode::Server::read(ObjectId id, ObjectBytes& bytes) noexcept {
  CanObjects* objects = part(id.index);
  if (objects != nullptr) return objects->read(id, bytes);
  // A parameter of an inverter that is not there: it could be reached if it were.
  return CanParameterObjects::has(id.index) ? SdoAbort::kHardware : SdoAbort::kNoObject;
}

SdoAbort CanNode::Server::write(ObjectId id, ByteView bytes) noexcept {
  CanObjects* objects = part(id.index);
  if (objects == nullptr) return CanParameterObjects::has(id.index) ? SdoAbort::kHardware : SdoAbort::kNoObject;
  const SdoAbort refusal = objects->write(id, bytes);
  if (objects == &node_->process_) node_->commit();
  return refusal;
}

void CanNode::answerSdo(Server& server, const SdoCobIds& ids, const CanFrame& frame, bool judged) noexcept {
  if (judged) referee_.sdoRequest(id(), frame, server.answer.has_value());
  if (state_ == NmtState::kStopped || frame.size != 8 || (ids.answer & kCobIdOff) != 0) return;
  ++counters_.sdo_requests;
  const bool abort = frame.data[0] >> 5 == 4;
  if (server.answer && !abort) return;  // one at a time
  server.answer.reset();
  const auto answer = server.protocol.handle(frame.data, server);
  if (!answer) return;
  const bool parameter = CanParameterObjects::has(server.protocol.object().index);
  const std::size_t place = static_cast<std::size_t>(&server - servers_.data());
  const DriveUnit* drive = drives_[place] != nullptr ? drives_[place] : drives_[0];
  server.remaining = answerDelay() + (parameter ? settings_.parameter_time : settings_.object_time);
  if (drive != nullptr) {
    if (parameter && drive->parameterSwitches().silent) return;
    if (parameter) server.remaining += std::chrono::milliseconds{drive->parameterSwitches().delay};
  }
  server.answer = dataFrame(ids.answer & kCobIdMask, ByteView{*answer});
}

void CanNode::advanceServers(Duration span, CanSink& sink) noexcept {
  for (Server& server : servers_) {
    if (!server.answer) continue;
    server.remaining -= span;
    if (server.remaining > Duration::zero()) continue;
    const CanFrame frame = *server.answer;
    server.answer.reset();
    send(frame.id, frame.bytes(), sink);
  }
}

unsigned CanNode::mappableBits(ObjectId id, bool receive) const noexcept {
  return process_.mappableBits(id, receive);
}

void CanNode::takePdo(const PdoSettings& pdo, const CanFrame& frame, bool judged) noexcept {
  if (judged) referee_.rpdo(id(), frame.size, pdo.length());
  if (frame.size < pdo.length()) return;
  if (pdo.type <= kLongestSynchronous) {
    PdoData data;
    for (const std::uint8_t byte : frame.bytes()) data.push_back(byte);
    waiting_for_sync_[static_cast<std::size_t>(&pdo - communication_.rpdos.data())] = data;
    return;
  }
  apply(pdo, frame.bytes());
}

void CanNode::apply(const PdoSettings& pdo, ByteView data) noexcept {
  ++counters_.rpdos;
  std::size_t position = 0;
  for (std::size_t i = 0; i < pdo.count; ++i) {
    const std::uint32_t entry = pdo.mapping[i];
    const std::size_t length = (entry & 0xFFu) / 8;
    const ObjectId object{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xFFu)};
    static_cast<void>(process_.write(object, data.sub(position, length)));
    position += length;
  }
  commit();
}

void CanNode::stoodStill() noexcept {
  master_may_look_ = kMasterMayLook;
}

void CanNode::commit() noexcept {
  if (master_may_look_ > Duration::zero()) process_.beginExchange();
  const CanProcessObjects::Commit commit = process_.commit();
  if (commit.valid && module_) module_->validWord();
  if (!commit.zero) return;
  ++counters_.zero_control_words;
  if (judged_) referee_.broken(CanRule::kZeroControlWord);
}

void CanNode::synchronise(CanSink& sink) noexcept {
  if (state_ != NmtState::kOperational) return;
  for (std::size_t i = 0; i < communication_.rpdos.size(); ++i) {
    if (!waiting_for_sync_[i]) continue;
    const PdoData data = *waiting_for_sync_[i];
    waiting_for_sync_[i].reset();
    apply(communication_.rpdos[i], data);
  }
  for (std::size_t i = 0; i < communication_.tpdos.size(); ++i) {
    const PdoSettings& pdo = communication_.tpdos[i];
    if (pdo.enabled() && tpdos_[i].dueOnSync(pdo, valuesOf(pdo))) sendPdo(i, sink);
  }
}

void CanNode::sendPdos(Duration span, CanSink& sink) noexcept {
  if (state_ != NmtState::kOperational) return;
  for (CanTpdo& tpdo : tpdos_) tpdo.advance(span);
  since_sample_ += span;
  if (since_sample_ < kSample) return;
  since_sample_ = Duration::zero();
  for (std::size_t i = 0; i < communication_.tpdos.size(); ++i) {
    const PdoSettings& pdo = communication_.tpdos[i];
    if (pdo.enabled() && tpdos_[i].due(pdo, valuesOf(pdo))) sendPdo(i, sink);
  }
}

void CanNode::sendPdo(std::size_t number, CanSink& sink) noexcept {
  const PdoSettings& pdo = communication_.tpdos[number];
  const PdoData data = valuesOf(pdo);
  tpdos_[number].sent(data);
  ++counters_.tpdos;
  send(pdo.id(), data, sink);
}

PdoData CanNode::valuesOf(const PdoSettings& pdo) noexcept {
  PdoData data;
  for (std::size_t i = 0; i < pdo.count; ++i) {
    const std::uint32_t entry = pdo.mapping[i];
    const ObjectId object{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xFFu)};
    ObjectBytes bytes;
    if (process_.read(object, bytes) != SdoAbort::kNone) bytes.resize((entry & 0xFFu) / 8);
    for (const std::uint8_t byte : bytes) data.push_back(byte);
  }
  return data;
}

}  // namespace nord_driver::sim
