// Life of a module on the bus and its explicit messages; its process data are in dn_module_data.cpp.

#include "sim/devicenet/dn_module.h"

#include <algorithm>

#include "sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kCheckTime = std::chrono::seconds(1);
constexpr unsigned kChecks = 2;
constexpr std::uint8_t kDeviceNetClass = 3;
constexpr std::uint8_t kBodyFormat = 0;  // 8/8: class and instance of 8 bits (BU 0280 4)
constexpr std::uint8_t kNothingMore = 0xFF;
constexpr std::int32_t kAddressTaken = 5211;  // P170
constexpr std::uint8_t kFirstParameterClass = 100;
constexpr Duration kMayLook = std::chrono::milliseconds(100);

CipBytes refusal(CipStatus status, std::uint8_t additional = kNothingMore) noexcept {
  return {dn::kError | dn::kAnswer, static_cast<std::uint8_t>(status), additional};
}

}  // namespace

DnModule::DnModule(const DnModuleSettings& settings, DnReferee& referee)
    : settings_(settings),
      referee_(referee),
      parameters_(dnModuleParameterDefinitions()),
      drive_objects_(process_),
      parameter_objects_(process_, settings.kind == DnModuleKind::kGateway ? &parameters_ : nullptr),
      connections_(settings.packet_rate_steps, settings.cos_instance_4_alone) {
  for (const ParameterPreset& preset : settings_.parameters) {
    parameters_.preset(preset.number, preset.set, preset.element, preset.raw);
  }
  settings_.parameters.clear();
  process_.setInputs(settings_.inputs);
  referee_.nodeExists(settings_.mac);
}

void DnModule::connected(unsigned place) noexcept {
  process_.connect(place, *driveAt(place));
}

Supply DnModule::supply() const noexcept {
  return isGateway() ? Supply::kOwn : Supply::kInverter;
}

void DnModule::setPowered(bool on) noexcept {
  supply_ = on;
  showLinks();
}

bool DnModule::hasSupply() const noexcept {
  if (isGateway()) return supply_;
  return supply_ && driveAt(0) != nullptr && driveAt(0)->plugged();
}

void DnModule::switchOn() noexcept {
  parameters_.restoreFromEeprom();
  parameters_.show(180, 0, settings_.mac);
  parameters_.show(181, 0, bitRateCode());
  seen_.fill(false);
  error_ = 0;
  phase_ = Phase::kStarting;
  in_phase_ = Duration::zero();
}

void DnModule::switchOff() noexcept {
  phase_ = Phase::kOff;
  connections_.forget();
  process_.forget();
  parameter_objects_.forget();
  explicit_in_.reset();
  explicit_out_.reset();
  request_.reset();
  io_in_.reset();
  outgoing_.clear();
  production_ = Production{};
  valid_data_seen_ = cause_stands_ = timed_out_ = false;
}

void DnModule::stoodStill() noexcept {
  master_may_look_ = kMayLook;
  process_.beginExchange();
}

void DnModule::advance(Duration span, CanSink& sink) noexcept {
  master_may_look_ = std::max(Duration::zero(), master_may_look_ - span);
  if (hasSupply() != alive()) alive() ? switchOff() : switchOn();
  if (!alive()) return;
  in_phase_ += span;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < outgoing_.size(); ++i) {
    Outgoing& waiting = outgoing_[i];
    waiting.remaining -= span;
    if (waiting.remaining > Duration::zero()) {
      outgoing_[kept++] = waiting;
    } else if (!mute()) {
      sink.transmit(waiting.frame);
    }
  }
  outgoing_.resize(kept);
  check(span, sink);
  if (phase_ == Phase::kOnline) {
    advanceExplicit(span, sink);
    if (connections_.advance(span)) masterLost();
    produce(span, sink);
  }
  watch(span);
  showStatus();
}

// Two requests a second apart, and a second more.
void DnModule::check(Duration /*span*/, CanSink& sink) noexcept {
  const bool starts = phase_ == Phase::kStarting && in_phase_ >= settings_.start_time;
  const bool again = phase_ == Phase::kChecking && in_phase_ >= kCheckTime;
  if (!starts && !again) return;
  if (starts) checks_ = 0;
  in_phase_ = Duration::zero();
  if (checks_ == kChecks) {
    phase_ = Phase::kOnline;
    return;
  }
  phase_ = Phase::kChecking;
  ++checks_;
  CipBytes data;
  put(data, 0, 1);
  put(data, settings_.identity.vendor, 2);
  put(data, settings_.identity.serial, 4);
  send(dn::group2(dn::kDuplicateMac, mac()), data, sink);
}

void DnModule::duplicateMac(const CanFrame& frame, CanSink& sink) noexcept {
  if (frame.size != 7) return;
  const bool response = (frame.data[0] & dn::kAnswer) != 0;
  if (phase_ == Phase::kChecking || (phase_ == Phase::kOnline && response)) return communicationFault();
  if (phase_ != Phase::kOnline) return;
  CipBytes data;
  put(data, dn::kAnswer, 1);
  put(data, settings_.identity.vendor, 2);
  put(data, settings_.identity.serial, 4);
  send(dn::group2(dn::kDuplicateMac, mac()), data, sink);
}

void DnModule::communicationFault() noexcept {
  const bool exchanged = connections_.anyIoEstablished();
  connections_.forget();
  explicit_out_.reset();
  request_.reset();
  phase_ = Phase::kCommunicationFault;
  if (exchanged) masterLost();
  error_ = kAddressTaken;
}

void DnModule::receive(const CanFrame& frame, bool judged, CanSink& sink) noexcept {
  const bool listens = phase_ == Phase::kChecking || phase_ == Phase::kOnline;
  if (!listens || frame.extended || frame.remote || !dn::isGroup2(frame.id)) return;
  const unsigned message = dn::messageOfGroup2(frame.id);
  const unsigned address = dn::macOfGroup2(frame.id);
  if (message == dn::kStrobeCommand && phase_ == Phase::kOnline && address == connections_.owner()) {
    return strobe(frame, judged, sink);
  }
  if (address != mac()) return;
  if (message == dn::kDuplicateMac) return duplicateMac(frame, sink);
  if (phase_ != Phase::kOnline) return;
  switch (message) {
    case dn::kUnconnected:
      return unconnected(frame, sink);
    case dn::kMasterExplicit:
      return explicitFrame(frame, sink);
    case dn::kPoll:
      return poll(frame, judged, sink);
    case dn::kAcknowledge:
      if (connections_[DnConnectionKind::kChangeOfState].established()) {
        connections_.feed(DnConnectionKind::kChangeOfState);
        production_.waits = false;
      }
      return;
    default:
      return;
  }
}

// Allocate and release come unconnected and are answered as if the explicit connection were there.
void DnModule::unconnected(const CanFrame& frame, CanSink& sink) noexcept {
  if (frame.size < 4 || (frame.data[0] & dn::kFragmented) != 0) return;
  const std::uint8_t service = frame.data[1];
  const bool known = service == dn::kAllocate || service == dn::kRelease;
  CipBytes body;
  DnAllocation done;
  if (!known) {
    done = {CipStatus::kServiceNotSupported, 0x03};
  } else if (frame.data[2] != kDeviceNetClass || frame.data[3] != 1) {
    done = {CipStatus::kNoObject, kNothingMore};
  } else if (frame.size < (service == dn::kAllocate ? 6 : 5)) {
    done = {CipStatus::kNotEnoughData, kNothingMore};
  } else if (service == dn::kAllocate && refused_allocation_) {
    done = *refused_allocation_;
  } else if (service == dn::kAllocate) {
    running_layout_ = inDataExchange() ? running_layout_ : layout();
    done = connections_.allocate(frame.data[4], frame.data[5], running_layout_.inputs(), running_layout_.outputs());
    if (done.status == CipStatus::kOk) {
      ++counters_.allocations;
      if (!inDataExchange()) process_.beginExchange();
      io_in_.reset();
      production_ = Production{};
    }
  } else if (connections_.owner() != dn::kNoMac && (frame.data[0] & dn::kMacMask) != connections_.owner()) {
    done = {CipStatus::kStateConflict, 0x01};
  } else {
    done = connections_.release(frame.data[4]);
  }
  if (done.status != CipStatus::kOk) {
    body = refusal(done.status, done.additional);
  } else {
    body.push_back(service | dn::kAnswer);
    if (service == dn::kAllocate) body.push_back(kBodyFormat);
  }
  DnFrameData data{frame.data[0]};
  for (const std::uint8_t byte : body) data.push_back(byte);
  send(dn::group2(dn::kSlaveExplicit, mac()), data, sink);
}

void DnModule::explicitFrame(const CanFrame& frame, CanSink& sink) noexcept {
  if (!connections_.has(dn::kChoiceExplicit) || frame.size < 2) return;
  if ((frame.data[0] & dn::kMacMask) != connections_.owner()) return;
  connections_.feed(DnConnectionKind::kExplicit);
  const DnExplicitReceiver::Heard heard = explicit_in_.receive(frame.bytes());
  const std::uint32_t id = dn::group2(dn::kSlaveExplicit, mac());
  if (heard.acknowledge) send(id, *heard.acknowledge, sink);
  if (heard.acknowledged) {
    if (const auto next = explicit_out_.acknowledged(heard.count)) send(id, *next, sink);
  }
  if (!heard.complete) return;
  ++counters_.explicit_requests;
  explicit_out_.reset();  // a new request ends what was still being told
  request_ = explicit_in_.request();
  remaining_ = timeFor(request_->body);
}

Duration DnModule::timeFor(const CipBytes& body) noexcept {
  if (body.size() < 3 || body[1] < kFirstParameterClass) return settings_.object_time;
  Duration time = settings_.parameter_time;
  const DriveUnit* drive = parameter_objects_.driveOf({body[1], body[2], 0});
  if (drive == nullptr) return time;
  // One telegram is what an order takes anyway.
  const unsigned delay = drive->parameterSwitches().delay;
  return time + std::chrono::milliseconds(delay > 1 ? delay - 1 : 0);
}

void DnModule::advanceExplicit(Duration span, CanSink& sink) noexcept {
  const std::uint32_t id = dn::group2(dn::kSlaveExplicit, mac());
  const DnExplicitSender::Waited waited = explicit_out_.advance(span);
  if (waited.again) send(id, *waited.again, sink);
  if (!request_) return;
  remaining_ -= span;
  if (remaining_ > Duration::zero()) return;
  const DnRequest request = *request_;
  request_.reset();
  if (!connections_.has(dn::kChoiceExplicit)) return;
  const CipBytes answer = execute(request.body);
  if (answer.empty()) return;
  send(id, explicit_out_.begin(request.header, answer), sink);
}

DnObjects* DnModule::objectsOf(std::uint8_t class_id) noexcept {
  if (hasClass(class_id)) return this;
  if (drive_objects_.hasClass(class_id)) return &drive_objects_;
  if (parameter_objects_.hasClass(class_id)) return &parameter_objects_;
  return nullptr;
}

/// The body of the answer; none: the inverter never answers.
CipBytes DnModule::execute(const CipBytes& body) noexcept {
  if (body.size() < 3) return refusal(CipStatus::kNotEnoughData);
  const std::uint8_t service = body[0];
  CipAddress at{body[1], body[2], 0};
  DnObjects* objects = objectsOf(at.class_id);
  if (objects == nullptr) return refusal(CipStatus::kNoObject);
  if (service != dn::kGetSingle && service != dn::kSetSingle) return refusal(CipStatus::kServiceNotSupported);
  if (body.size() < 4) return refusal(CipStatus::kNotEnoughData);
  at.attribute = body[3];
  if (at.class_id >= kFirstParameterClass) {
    const DriveUnit* drive = parameter_objects_.driveOf(at);
    if (drive != nullptr && drive->parameterSwitches().silent) return {};
  }
  CipBytes value;
  const ByteView rest = ByteView{body}.sub(4);
  CipStatus status = CipStatus::kOk;
  if (service == dn::kGetSingle) {
    status = rest.empty() ? objects->get(at, value) : CipStatus::kTooMuchData;
  } else {
    status = objects->set(at, rest, value);
  }
  if (status != CipStatus::kOk) return refusal(status);
  CipBytes answer{static_cast<std::uint8_t>(service | dn::kAnswer)};
  for (const std::uint8_t byte : value) answer.push_back(byte);
  return answer;
}

void DnModule::send(std::uint32_t id, ByteView data, CanSink& sink) noexcept {
  if (mute()) return;
  const CanFrame frame = dataFrame(id, data);
  if (answerDelay() <= Duration::zero()) return sink.transmit(frame);
  outgoing_.push_back({frame, answerDelay()});
}

}  // namespace nord_driver::sim
