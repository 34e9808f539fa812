#include "sim/profibus/dp_station.h"

#include "sim/profibus/services.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kWatchdogUnit = std::chrono::milliseconds(10);  // T = factor 1 * factor 2 * 10 ms
constexpr Duration kShortWatchdogUnit = std::chrono::milliseconds(1);
constexpr std::uint8_t kNoOwner = 0xFF;

bool carriesFrameCount(unsigned code) noexcept {
  return code == kSdaLow || code == kSdaHigh || code == kSrdLow || code == kSrdHigh;
}

}  // namespace

std::optional<WireBytes> DpStation::handle(const Telegram& request) noexcept {
  if (state_ == SlaveState::kOff) return std::nullopt;
  if (request.kind == TelegramKind::kToken || request.kind == TelegramKind::kShortAcknowledge) return std::nullopt;
  if (!request.isRequest()) return std::nullopt;
  const bool own = request.destination == address_;
  if (!own && request.destination != kBroadcast) return std::nullopt;

  const unsigned code = request.code();
  if (code == kSdnLow || code == kSdnHigh) {
    if (request.destination_sap == kSapGlobalControl) globalControl(request);
    return std::nullopt;  // sent without acknowledgement
  }
  if (!own) return std::nullopt;
  ++counters_.telegrams;
  if (code == kFdlStatus) {
    if (mute()) return std::nullopt;
    return answerWithout(request, kAnswerOk);  // station type 00: slave
  }
  if (!carriesFrameCount(code)) {
    if (mute()) return std::nullopt;
    return answerWithout(request, kUserError);
  }

  // The first request to a station comes with FCV = 0 and FCB = 1, also after another master.
  if (!request.fcv()) {
    if (!request.fcb()) return std::nullopt;
  } else {
    if (!frame_count_known_ || frame_count_master_ != request.source) return std::nullopt;
    if (request.fcb() == frame_count_) {  // repeated: answered from the store, not executed again
      ++counters_.repeated;
      if (request.source == owner_) silence_ = Duration::zero();
      if (mute()) return std::nullopt;
      return stored_answer_;
    }
  }
  frame_count_known_ = true;
  frame_count_ = request.fcb();
  frame_count_master_ = request.source;
  if (request.source == owner_) silence_ = Duration::zero();
  stored_answer_ = execute(request);
  showStatus();
  if (mute()) return std::nullopt;
  return stored_answer_;
}

WireBytes DpStation::execute(const Telegram& request) noexcept {
  if (!request.destination_sap) return exchangeData(request);
  switch (*request.destination_sap) {
    case kSapRecords:
      return record(request);
    case kSapDiagnosis:
      return diagnosis(request);
    case kSapSetParameters:
      return setParameters(request);
    case kSapCheckConfiguration:
      return checkConfiguration(request);
    case kSapGetConfiguration:
      return getConfiguration(request);
    default:
      return class2Record(request);
  }
}

WireBytes DpStation::diagnosis(const Telegram& request) noexcept {
  const bool missing = inverterMissing();
  unsigned first = 0;
  if (state_ != SlaveState::kDataExchange) first |= kNotReady;
  if (configuration_fault_) first |= kConfigurationFault;
  if (parameter_fault_) first |= kParameterFault;
  if (missing) first |= kExtendedDiagnosis;
  unsigned second = kAlwaysOne;
  if (state_ == SlaveState::kWaitParameters) second |= kParametersRequired;
  if (watchdog_ > Duration::zero()) second |= kWatchdogRunning;
  if (freeze_) second |= kFreezeMode;
  if (sync_) second |= kSyncMode;

  Telegram answer = answerTo(request, kDataLow);
  ByteWriter<246> writer{answer.data};
  writer.u8(static_cast<std::uint8_t>(first));
  writer.u8(static_cast<std::uint8_t>(second));
  writer.u8(0);
  writer.u8(owner_);
  writer.u16be(ident_);
  if (missing) {  // device-related block: the link to the inverter is broken (BU 0020 8.2)
    writer.u8(0x02);
    writer.u8(0x04);
  }
  reported_missing_ = missing;
  return encodeTelegram(answer);
}

WireBytes DpStation::setParameters(const Telegram& request) noexcept {
  if (owner_ != kNoOwner && owner_ != request.source) return answerWithout(request, kServiceNotActive);
  const FixedBytes<246>& data = request.data;
  if (!acceptsParameters(data)) {
    toWaitParameters();
    parameter_fault_ = true;
    return shortAcknowledge();
  }
  const std::uint8_t flags = data[0];
  if ((flags & kUnlockRequest) != 0) {
    toWaitParameters();
    return shortAcknowledge();
  }
  if ((flags & kLockRequest) == 0) return shortAcknowledge();  // may change minTsdr only
  if (state_ == SlaveState::kDataExchange) clearOutputs();
  endModes();
  parameter_fault_ = configuration_fault_ = false;
  owner_ = request.source;
  const std::uint8_t dpv1 =
      records() != nullptr && data.size() > kSetParametersMinimum ? data[kSetParametersMinimum] : std::uint8_t{0};
  records_enabled_ = (dpv1 & kDpv1Enable) != 0;
  const Duration unit = (dpv1 & kWatchdogBase1ms) != 0 ? kShortWatchdogUnit : kWatchdogUnit;
  watchdog_ = (flags & kWatchdogOn) != 0 ? unit * (data[1] * data[2]) : Duration::zero();
  silence_ = Duration::zero();
  sync_allowed_ = (flags & kSyncRequest) != 0;
  freeze_allowed_ = (flags & kFreezeRequest) != 0;
  groups_ = data[6];
  state_ = SlaveState::kWaitConfiguration;
  return shortAcknowledge();
}

bool DpStation::acceptsParameters(ByteView data) noexcept {
  if (data.size() < kSetParametersMinimum) return false;
  if ((static_cast<unsigned>(data[4]) << 8 | data[5]) != ident_) return false;
  if ((data[0] & kWatchdogOn) != 0 && (data[1] == 0 || data[2] == 0)) return false;
  // A DP-V1 slave takes its three bytes or none of them; none: it works as DP-V0.
  const std::size_t user = data.size() - kSetParametersMinimum;
  return records() == nullptr || user == 0 || user >= kDpv1StatusBytes;
}

WireBytes DpStation::checkConfiguration(const Telegram& request) noexcept {
  if (state_ == SlaveState::kWaitParameters) return answerWithout(request, kServiceNotActive);
  // In data exchange the same configuration changes nothing, another one is a fault.
  const bool same = ByteView{request.data} == ByteView{configuration()};
  const bool taken = state_ == SlaveState::kDataExchange ? same : takeConfiguration(request.data);
  if (!taken) {
    toWaitParameters();
    configuration_fault_ = true;
    return shortAcknowledge();
  }
  if (state_ == SlaveState::kWaitConfiguration) {
    state_ = SlaveState::kDataExchange;
    if (referee_ != nullptr) referee_->outputLength(address_, dataLength());
    enterDataExchange();
  }
  return shortAcknowledge();
}

WireBytes DpStation::getConfiguration(const Telegram& request) const noexcept {
  Telegram answer = answerTo(request, kDataLow);
  for (const std::uint8_t byte : configuration()) answer.data.push_back(byte);
  return encodeTelegram(answer);
}

WireBytes DpStation::exchangeData(const Telegram& request) noexcept {
  if (state_ != SlaveState::kDataExchange || request.source != owner_) {
    return answerWithout(request, kServiceNotActive);
  }
  if (request.data.size() != dataLength()) {
    toWaitParameters();
    configuration_fault_ = true;
    return answerWithout(request, kServiceNotActive);
  }
  // The answer does not yet contain the reaction to what came with the request (BU 0020 7.4).
  Telegram answer = answerTo(request, inverterMissing() != reported_missing_ ? kDataHigh : kDataLow);
  if (freeze_) {
    answer.data = frozen_inputs_;
  } else {
    appendInputs(answer.data);
  }
  outputsArrived(request.data);
  if (sync_) {
    waiting_outputs_ = request.data;
    outputs_wait_ = true;
  } else {
    takeOutputs(request.data);
  }
  ++counters_.data_exchanges;
  return encodeTelegram(answer);
}

// The server is there for the master the station exchanges data with, and only when that asked for DP-V1.
WireBytes DpStation::record(const Telegram& request) noexcept {
  RecordServer* server = records();
  const bool active = server != nullptr && server->settings().active && records_enabled_;
  if (!active || state_ != SlaveState::kDataExchange || request.source != owner_) {
    return answerWithout(request, kServiceNotActive);
  }
  if (!request.data.empty() && server->outstanding()) return answerWithout(request, kNoResource);
  const std::optional<RecordServer::Pdu> response = server->handle(request.data);
  if (!response) return shortAcknowledge();
  Telegram answer = answerTo(request, kDataLow);
  for (const std::uint8_t byte : *response) answer.data.push_back(byte);
  return encodeTelegram(answer);
}

// A connection of class 2 asks neither for parameters nor for data exchange.
WireBytes DpStation::class2Record(const Telegram& request) noexcept {
  Class2Server* server = class2();
  const std::uint8_t access_point = *request.destination_sap;
  if (server == nullptr || access_point > kSapResourceManager || request.source_sap != kSapOfClass2Master) {
    return answerWithout(request, kServiceNotActive);
  }
  const Class2Server::Answer said = access_point == kSapResourceManager
                                        ? server->manage(request.source, request.data)
                                        : server->serve(access_point, request.source, request.data);
  switch (said.kind) {
    case Class2Server::Kind::kNothingYet:
      return shortAcknowledge();
    case Class2Server::Kind::kNotActive:
      return answerWithout(request, kServiceNotActive);
    case Class2Server::Kind::kNoResource:
      return answerWithout(request, kNoResource);
    case Class2Server::Kind::kData:
      break;
  }
  Telegram answer = answerTo(request, kDataLow);
  for (const std::uint8_t byte : said.pdu) answer.data.push_back(byte);
  return encodeTelegram(answer);
}

// BU 2700 6.3: with SYNC outputs are stored and act on the next SYNC or on UNSYNC, with FREEZE inputs stay as they
// were.
void DpStation::globalControl(const Telegram& request) noexcept {
  ++counters_.global_controls;
  if (request.data.size() < 2 || request.source != owner_ || state_ != SlaveState::kDataExchange) return;
  const std::uint8_t command = request.data[0];
  const std::uint8_t group = request.data[1];
  if (group != 0 && (group & groups_) == 0) return;

  const bool unsync = (command & kUnsync) != 0;
  const bool sync = (command & kSync) != 0 && !unsync && sync_allowed_;
  if ((sync || unsync) && outputs_wait_) {
    takeOutputs(waiting_outputs_);
    outputs_wait_ = false;
  }
  if (unsync) sync_ = false;
  if (sync) sync_ = true;

  if ((command & kUnfreeze) != 0) {
    freeze_ = false;
  } else if ((command & kFreeze) != 0 && freeze_allowed_) {
    freeze_ = true;
    frozen_inputs_.clear();
    appendInputs(frozen_inputs_);
  }
  if ((command & kClearData) != 0) {
    outputs_wait_ = false;
    clearOutputs();
  }
}

void DpStation::endModes() noexcept {
  sync_ = freeze_ = outputs_wait_ = false;
  records_enabled_ = false;
  if (RecordServer* server = records()) server->reset();
}

void DpStation::toWaitParameters() noexcept {
  if (state_ == SlaveState::kDataExchange) clearOutputs();
  endModes();
  state_ = SlaveState::kWaitParameters;
  owner_ = kNoOwner;
  watchdog_ = Duration::zero();
  silence_ = Duration::zero();
}

void DpStation::advance(Duration span) noexcept {
  if (state_ == SlaveState::kOff) return;
  if (Class2Server* server = class2()) server->advance(span);
  watch(span);
  if (watchdog_ == Duration::zero()) return;
  silence_ += span;
  if (silence_ < watchdog_) return;
  const bool exchanging = state_ == SlaveState::kDataExchange;
  if (exchanging) {
    ++counters_.watchdog_trips;
    masterLost();
  }
  toWaitParameters();
}

void DpStation::setPowered(bool on) noexcept {
  if (on == powered()) return;
  toWaitParameters();
  state_ = on ? SlaveState::kWaitParameters : SlaveState::kOff;
  parameter_fault_ = configuration_fault_ = reported_missing_ = false;
  frame_count_known_ = false;
  if (Class2Server* server = class2()) server->reset();
  supplyChanged(on);
}

Telegram DpStation::answerTo(const Telegram& request, std::uint8_t code) const noexcept {
  Telegram answer;
  answer.destination = request.source;
  answer.source = address_;
  answer.function = code;
  answer.destination_sap = request.source_sap;
  answer.source_sap = request.destination_sap;
  return answer;
}

WireBytes DpStation::answerWithout(const Telegram& request, std::uint8_t code) const noexcept {
  Telegram answer;
  answer.destination = request.source;
  answer.source = address_;
  answer.function = code;
  return encodeTelegram(answer);
}

}  // namespace nord_driver::sim
