#include "devicenet/scanner.h"

#include <algorithm>

#include "devicenet/device_message.h"

namespace nord_driver::devicenet {
namespace {

ScannerConfig checked(const ScannerConfig& config) {
  ScannerConfig complete = completed(config);
  checkConfig(complete);
  return complete;
}

}  // namespace

Scanner::Scanner(const ScannerConfig& config)
    : config_(checked(config)), watch_(counters_, events_), check_(config_.mac, config_.own, config_.fault_pause) {
  node_of_mac_.fill(kNoNode);
  nodes_.reserve(config_.nodes.size());
  for (std::size_t i = 0; i < config_.nodes.size(); ++i) {
    nodes_.push_back(std::make_unique<NodeHandler>(i, config_, counters_, events_));
    node_of_mac_[config_.nodes[i].mac] = i;
  }
}

NodeHandler* Scanner::nodeOf(std::uint8_t mac) noexcept {
  return node_of_mac_[mac] == kNoNode ? nullptr : nodes_[node_of_mac_[mac]].get();
}

void Scanner::enterBusState(BusState state, const Sentence& reason) noexcept {
  bus_state_ = state;
  bus_reason_ = reason;
}

void Scanner::restart(Instant now) noexcept {
  now_ = now;
  given_ = Given{};
  watch_.restart();
  stopNodes("the bus was opened anew", now);
  check_.restart();
  enterBusState(BusState::kCheckingMac, Sentence{});
}

void Scanner::handleBusLost(const Sentence& why, Instant now) noexcept {
  now_ = now;
  if (bus_state_ == BusState::kLost || bus_state_ == BusState::kOff) return;
  check_.stop();
  stopNodes(why, now);
  enterBusState(BusState::kLost, why);
  watch_.tell(DevicenetEventKind::kBusLost, why, 0, now);
}

void Scanner::stopNodes(const Sentence& why, Instant now) noexcept {
  deadline_.reset();
  output_refused_ = false;
  dropStrobe();
  for (const auto& node : nodes_) node->stop(why, now);
}

void Scanner::releaseAll(Instant now) noexcept {
  now_ = now;
  output_refused_ = false;
  dropStrobe();
  for (const auto& node : nodes_) {
    node->release(now);
    touched(*node);
  }
}

bool Scanner::released() const noexcept {
  return std::all_of(nodes_.begin(), nodes_.end(), [](const auto& node) { return node->released(); });
}

void Scanner::followCheck(Instant now) noexcept {
  deadline_ = earlier(deadline_, check_.nextDeadline());
  if (check_.state() == DuplicateMacCheck::State::kFirst && bus_state_ == BusState::kCommunicationFault) {
    enterBusState(BusState::kCheckingMac, bus_reason_);
  }
  if (check_.online() && bus_state_ == BusState::kCheckingMac) {
    enterBusState(BusState::kOnline, Sentence{});
    watch_.tell(DevicenetEventKind::kOnline, "nobody else has our MAC id", config_.mac, now);
    for (const auto& node : nodes_) {
      node->start(now);
      touched(*node);
    }
  }
  const bool fault = check_.state() == DuplicateMacCheck::State::kCommFault;
  if (!fault || bus_state_ == BusState::kCommunicationFault) return;
  ++counters_.own_mac_used;
  Sentence why;
  why.format("communication fault: another device has our MAC id %u, vendor %u, serial number %08Xh",
             unsigned{config_.mac}, unsigned{check_.rival().vendor_id}, check_.rival().serial_number);
  stopNodes(why, now);
  deadline_ = earlier(deadline_, check_.nextDeadline());
  enterBusState(BusState::kCommunicationFault, why);
  watch_.tell(DevicenetEventKind::kCommunicationFault, why, check_.rival().serial_number, now);
}

void Scanner::startCycle(Instant now) noexcept {
  now_ = now;
  ++counters_.cycles;
  dropStrobe();
  for (const auto& node : nodes_) {
    strobe_due_ = strobe_due_ || node->io().takesStrobe();
    node->io().startCycle(now);
    deadline_ = earlier(deadline_, node->io().nextDeadline());
  }
  output_maybe_ = true;
  output_refused_ = false;
  first_output_.reset();
}

void Scanner::dropStrobe() noexcept {
  if (strobe_due_) ++counters_.superseded;
  strobe_due_ = false;
}

void Scanner::handleFrame(const CanFrame& frame, Instant now) noexcept {
  now_ = now;
  ++counters_.frames_received;
  const std::optional<Identifier> id = readIdentifier(frame.id);
  if (frame.extended || frame.size > kCanDataLength || !id) {
    ++counters_.foreign;
    return;
  }
  if (id->group == 2) return handleGroup2(*id, frame, now);
  NodeHandler* node = id->group == 4 ? nullptr : nodeOf(id->mac);
  if (node != nullptr && id->group == 1 && id->message >= static_cast<std::uint8_t>(Group1::kChangeOfStateOrCyclic)) {
    // It gives process data or takes a timer forward: there is nothing to send but an acknowledge.
    node->handleIo(id->message, frame, now);
    acknowledge_maybe_ = acknowledge_maybe_ || node->io().acknowledgeDue();
    deadline_ = earlier(deadline_, node->io().nextDeadline());
    return;
  }
  if (node != nullptr && id->group == 3 && id->message == static_cast<std::uint8_t>(Group3::kUnconnectedResponse) &&
      isDeviceMessage(frame, node->mac())) {
    node->handleExplicit(frame, now);
    return touched(*node);
  }
  ++counters_.foreign;
}

void Scanner::handleGroup2(const Identifier& id, const CanFrame& frame, Instant now) noexcept {
  const auto message = static_cast<Group2>(id.message);
  NodeHandler* node = nodeOf(id.mac);
  switch (message) {
    case Group2::kStrobeCommand:
      return watch_.secondScanner(frame, message, id.mac, now);
    case Group2::kMulticastPoll:
      ++counters_.foreign;
      return;
    case Group2::kDuplicateMac:
      return handleDuplicateMac(id.mac, frame, now);
    case Group2::kSlaveExplicit:
      if (node == nullptr) return watch_.foreignNode(id.mac, now);
      node->handleExplicit(frame, now);
      return touched(*node);
    case Group2::kMasterAcknowledge:
    case Group2::kMasterExplicit:
    case Group2::kMasterIo:
    case Group2::kUnconnected:
      break;
  }
  if (node == nullptr) {
    ++counters_.foreign;
    return;
  }
  node->handleForeignRequest(frame, message, now);
  touched(*node);
  watch_.secondScanner(frame, message, id.mac, now);
}

void Scanner::handleDuplicateMac(std::uint8_t mac, const CanFrame& frame, Instant now) noexcept {
  const auto message = readDuplicateMac(frame);
  if (!message) return watch_.malformed(frame, now);
  if (mac == config_.mac) {
    if (check_.online() && !message->response) ++counters_.mac_answers;
    check_.handle(*message, now);
    return followCheck(now);
  }
  NodeHandler* node = nodeOf(mac);
  if (node == nullptr) return watch_.foreignNode(mac, now);
  node->handleDuplicateMac(*message, now);
  touched(*node);
}

void Scanner::poll(Instant now) noexcept {
  now_ = now;
  if (!deadline_ || now < *deadline_) return;
  deadline_.reset();
  check_.poll(now);
  followCheck(now);
  for (const auto& node : nodes_) {
    node->poll(now);
    touched(*node);
  }
}

void Scanner::touched(const NodeHandler& node) noexcept {
  deadline_ = earlier(deadline_, node.nextDeadline());
  output_maybe_ = true;
  explicit_maybe_ = true;
}

bool Scanner::pollTransmit(CanFrame& frame) noexcept {
  // Outputs first: where the link takes a frame only now and then, a word that stops is what it takes. One that it has refused
  // comes again with the next cycle, and nothing else takes its room until then.
  const bool given = pollDuplicateMac() ||
                     (bus_state_ == BusState::kOnline &&
                      (pollOutput() || (!output_refused_ && (pollStrobe() || pollAcknowledge() || pollExplicit()))));
  if (!given) {
    given_.kind = Given::Kind::kNothing;
    return false;
  }
  frame = given_.frame;
  ++counters_.frames_sent;
  return true;
}

bool Scanner::give(Given::Kind kind, std::size_t node) noexcept {
  given_.kind = kind;
  given_.node = node;
  return true;
}

bool Scanner::pollDuplicateMac() noexcept {
  if (!check_.pollTransmit(given_.frame, now_)) return false;
  deadline_ = earlier(deadline_, check_.nextDeadline());
  return give(Given::Kind::kDuplicateMac, 0);
}

bool Scanner::pollAcknowledge() noexcept {
  if (!acknowledge_maybe_) return false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i]->io().pollAcknowledge(given_.frame)) return give(Given::Kind::kAcknowledge, i);
  }
  acknowledge_maybe_ = false;
  return false;
}

bool Scanner::pollStrobe() noexcept {
  if (!strobe_due_) return false;
  strobe_due_ = false;
  std::array<std::uint8_t, kStrobeCommandLength> bits{};
  for (const auto& node : nodes_) {
    if (!node->io().takesStrobe()) continue;
    if (node->io().strobeBit()) bits[node->mac() / 8u] |= static_cast<std::uint8_t>(1u << node->mac() % 8u);
    node->io().noteStrobed(now_);
    touched(*node);
  }
  given_.frame = dataFrame(identifier(Group2::kStrobeCommand, config_.mac), bits);
  ++counters_.strobes;
  return give(Given::Kind::kStrobe, 0);
}

// It stays with a device until its message is out: the fragments of one message stand together.
bool Scanner::pollOutput() noexcept {
  if (!output_maybe_) return false;
  for (std::size_t tried = 0; tried < nodes_.size(); ++tried) {
    NodeHandler& node = *nodes_[next_output_];
    given_.continues = node.io().hasBegunOutput();
    if (node.io().pollOutput(given_.frame, now_)) {
      if (!first_output_) first_output_ = next_output_;
      deadline_ = earlier(deadline_, node.io().nextDeadline());
      return give(Given::Kind::kOutput, next_output_);
    }
    next_output_ = (next_output_ + 1) % nodes_.size();
  }
  if (!output_refused_) next_output_ = 0;
  output_maybe_ = false;
  return false;
}

bool Scanner::pollExplicit() noexcept {
  if (!explicit_maybe_) return false;
  for (std::size_t tried = 0; tried < nodes_.size(); ++tried) {
    const std::size_t i = next_explicit_;
    next_explicit_ = (next_explicit_ + 1) % nodes_.size();
    if (!nodes_[i]->channel().pollTransmit(given_.frame, now_)) continue;
    deadline_ = earlier(deadline_, nodes_[i]->nextDeadline());
    return give(Given::Kind::kExplicit, i);
  }
  explicit_maybe_ = false;
  return false;
}

void Scanner::notSent() noexcept {
  const Given given = given_;
  given_.kind = Given::Kind::kNothing;
  if (given.kind == Given::Kind::kNothing) return;
  --counters_.frames_sent;
  ++counters_.not_sent;
  NodeHandler& node = *nodes_[given.node];
  switch (given.kind) {
    case Given::Kind::kNothing:
      break;
    case Given::Kind::kDuplicateMac:
      check_.notSent(given.frame);
      break;
    case Given::Kind::kAcknowledge:
      node.io().acknowledgeNotSent();
      acknowledge_maybe_ = true;
      break;
    case Given::Kind::kStrobe:
      --counters_.strobes;
      ++counters_.superseded;
      for (const auto& each : nodes_) {
        if (each->io().takesStrobe()) each->io().strobeNotSent();
      }
      break;
    case Given::Kind::kOutput:
      node.io().outputNotSent();
      // The next cycle begins here, else the first device would have the room of all. A message that began this one and of
      // which only a part left has had its turn: another one may be shorter.
      if (given.continues && given.node == first_output_) next_output_ = (given.node + 1) % nodes_.size();
      output_refused_ = true;
      break;
    case Given::Kind::kExplicit:
      node.channel().notSent(given.frame);
      explicit_maybe_ = true;
      break;
  }
  // Process data that stay would be old when there is room again.
  dropStrobe();
  for (const auto& each : nodes_) each->io().dropOutput();
}

bool Scanner::submit(std::size_t node, const ExplicitRequest& request) noexcept {
  if (!nodes_[node]->submit(request, now_)) return false;
  touched(*nodes_[node]);
  return true;
}

std::optional<NodeAnswer> Scanner::pollAnswer() noexcept {
  for (std::size_t tried = 0; tried < nodes_.size(); ++tried) {
    const std::size_t i = next_answer_;
    next_answer_ = (next_answer_ + 1) % nodes_.size();
    const std::optional<ExplicitAnswer> answer = nodes_[i]->channel().pollAnswer();
    if (!answer) continue;
    if (answer->end == ExplicitEnd::kTimedOut) ++counters_.request_timeouts;
    if (answer->end == ExplicitEnd::kRefused) ++counters_.request_errors;
    return NodeAnswer{i, *answer};
  }
  return std::nullopt;
}

std::vector<std::uint32_t> Scanner::receivedIds() const {
  std::vector<std::uint32_t> ids;
  // In the order of need: our exchange, our MAC id, other devices, other masters.
  for (const auto& node : nodes_) {
    for (const Group1 message : {Group1::kChangeOfStateOrCyclic, Group1::kStrobeResponse, Group1::kPollResponse}) {
      if (node->io().takes(message)) ids.push_back(identifier(message, node->mac()));
    }
    ids.push_back(identifier(Group2::kSlaveExplicit, node->mac()));
    ids.push_back(identifier(Group3::kUnconnectedResponse, node->mac()));  // heartbeat and shutdown
  }
  for (std::uint8_t mac = 0; mac < kMacIds; ++mac) ids.push_back(identifier(Group2::kDuplicateMac, mac));
  for (const Group2 message :
       {Group2::kUnconnected, Group2::kMasterIo, Group2::kMasterExplicit, Group2::kMasterAcknowledge}) {
    for (const auto& node : nodes_) ids.push_back(identifier(message, node->mac()));
  }
  for (std::uint8_t mac = 0; mac < kMacIds; ++mac) ids.push_back(identifier(Group2::kStrobeCommand, mac));
  if (ids.size() > kMostIds) ids.resize(kMostIds);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace nord_driver::devicenet
