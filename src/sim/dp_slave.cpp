#include "nord_driver/sim/dp_slave.h"

#include "services.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kWatchdogUnit = std::chrono::milliseconds(10);  // T = factor 1 * factor 2 * 10 ms
constexpr std::uint8_t kNoOwner = 0xFF;
constexpr std::size_t kPkwBytes = 8;

// P746, BU 2700 7.2: bit 0 ready, bit 1 connected to the master, high byte 06h PROFIBUS.
constexpr std::int32_t kModuleReady = 0x0601;
constexpr std::int32_t kModuleConnected = 0x0603;

bool carriesFrameCount(unsigned code) noexcept {
  return code == kSdaLow || code == kSdaHigh || code == kSrdLow || code == kSrdHigh;
}

}  // namespace

DpSlave::DpSlave(const SlaveSettings& settings, ParameterStore& parameters, InverterModel& inverter, PkwServer& pkw,
                 Referee* referee)
    : settings_(settings), parameters_(parameters), inverter_(inverter), pkw_(pkw), referee_(referee) {
  if (referee_ != nullptr) referee_->outputLength(settings_.address, dataLength());
}

std::optional<WireBytes> DpSlave::handle(const Telegram& request) noexcept {
  if (state_ == SlaveState::kOff) return std::nullopt;
  if (request.kind == TelegramKind::kToken || request.kind == TelegramKind::kShortAcknowledge) return std::nullopt;
  if (!request.isRequest()) return std::nullopt;
  const bool own = request.destination == settings_.address;
  if (!own && request.destination != kBroadcast) return std::nullopt;

  const unsigned code = request.code();
  if (code == kSdnLow || code == kSdnHigh) {
    if (request.destination_sap == kSapGlobalControl) ++counters_.global_controls;
    return std::nullopt;  // sent without acknowledgement
  }
  if (!own) return std::nullopt;
  ++counters_.telegrams;
  if (code == kFdlStatus) {
    if (mute_) return std::nullopt;
    return answerWithout(request, kAnswerOk);  // station type 00: slave
  }
  if (!carriesFrameCount(code)) {
    if (mute_) return std::nullopt;
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
      if (mute_) return std::nullopt;
      return stored_answer_;
    }
  }
  frame_count_known_ = true;
  frame_count_ = request.fcb();
  frame_count_master_ = request.source;
  if (request.source == owner_) silence_ = Duration::zero();
  stored_answer_ = execute(request);
  showStatus();
  if (mute_) return std::nullopt;
  return stored_answer_;
}

WireBytes DpSlave::execute(const Telegram& request) noexcept {
  if (!request.destination_sap) return exchangeData(request);
  switch (*request.destination_sap) {
    case kSapDiagnosis:
      return diagnosis(request);
    case kSapSetParameters:
      return setParameters(request);
    case kSapCheckConfiguration:
      return checkConfiguration(request);
    case kSapGetConfiguration:
      return getConfiguration(request);
    default:
      return answerWithout(request, kServiceNotActive);
  }
}

WireBytes DpSlave::diagnosis(const Telegram& request) noexcept {
  const bool waiting = state_ == SlaveState::kWaitParameters;
  const bool unreachable = !inverterReachable();
  unsigned first = 0;
  if (state_ != SlaveState::kDataExchange) first |= kNotReady;
  if (configuration_fault_) first |= kConfigurationFault;
  if (parameter_fault_) first |= kParameterFault;
  if (unreachable) first |= kExtendedDiagnosis;
  unsigned second = kAlwaysOne;
  if (waiting) second |= kParametersRequired;
  if (watchdog_ > Duration::zero()) second |= kWatchdogRunning;

  Telegram answer = answerTo(request, kDataLow);
  ByteWriter<246> writer{answer.data};
  writer.u8(static_cast<std::uint8_t>(first));
  writer.u8(static_cast<std::uint8_t>(second));
  writer.u8(0);
  writer.u8(owner_);
  writer.u16be(settings_.ident);
  if (unreachable) {  // device-related block: the link to the inverter is broken (BU 0020 8.2)
    writer.u8(0x02);
    writer.u8(0x04);
  }
  reported_unreachable_ = unreachable;
  return encodeTelegram(answer);
}

WireBytes DpSlave::setParameters(const Telegram& request) noexcept {
  if (owner_ != kNoOwner && owner_ != request.source) return answerWithout(request, kServiceNotActive);
  const FixedBytes<246>& data = request.data;
  const std::uint8_t flags = data.empty() ? std::uint8_t{0} : data[0];
  bool good = data.size() >= kSetParametersMinimum;
  if (good) {
    const unsigned ident = static_cast<unsigned>(data[4]) << 8 | data[5];
    good = ident == settings_.ident && !((flags & kWatchdogOn) != 0 && (data[1] == 0 || data[2] == 0));
  }
  if (!good) {
    toWaitParameters();
    parameter_fault_ = true;
    return shortAcknowledge();
  }
  if ((flags & kUnlockRequest) != 0) {
    toWaitParameters();
    return shortAcknowledge();
  }
  if ((flags & kLockRequest) == 0) return shortAcknowledge();  // may change minTsdr only
  if (state_ == SlaveState::kDataExchange) clearOutputs();
  parameter_fault_ = configuration_fault_ = false;
  owner_ = request.source;
  watchdog_ = (flags & kWatchdogOn) != 0 ? kWatchdogUnit * (data[1] * data[2]) : Duration::zero();
  silence_ = Duration::zero();
  state_ = SlaveState::kWaitConfiguration;
  return shortAcknowledge();
}

WireBytes DpSlave::checkConfiguration(const Telegram& request) noexcept {
  if (state_ == SlaveState::kWaitParameters) return answerWithout(request, kServiceNotActive);
  const FixedBytes<2> expected = configuration();
  if (ByteView{request.data} != ByteView{expected}) {
    toWaitParameters();
    configuration_fault_ = true;
    return shortAcknowledge();
  }
  if (state_ == SlaveState::kWaitConfiguration) {
    state_ = SlaveState::kDataExchange;
    valid_data_seen_ = false;
  }
  return shortAcknowledge();
}

WireBytes DpSlave::getConfiguration(const Telegram& request) const noexcept {
  Telegram answer = answerTo(request, kDataLow);
  for (const std::uint8_t byte : configuration()) answer.data.push_back(byte);
  return encodeTelegram(answer);
}

WireBytes DpSlave::exchangeData(const Telegram& request) noexcept {
  if (state_ != SlaveState::kDataExchange || request.source != owner_) {
    return answerWithout(request, kServiceNotActive);
  }
  if (request.data.size() != dataLength()) {
    toWaitParameters();
    configuration_fault_ = true;
    return answerWithout(request, kServiceNotActive);
  }
  // The answer does not yet contain the reaction to what came with the request (BU 0020 7.4).
  const bool diagnosis_waits = inverterReachable() == reported_unreachable_;
  Telegram answer = answerTo(request, diagnosis_waits ? kDataHigh : kDataLow);
  appendInputs(answer.data);
  takeOutputs(request.data);
  ++counters_.data_exchanges;
  return encodeTelegram(answer);
}

void DpSlave::appendInputs(FixedBytes<246>& data) const noexcept {
  const std::size_t length = dataLength();
  if (inverterReachable()) {
    ByteWriter<246> writer{data};
    if (settings_.ppo_type <= 2) {
      const PkwWords& answer = pkw_.answer();
      writer.u16be(answer.pke);
      writer.u16be(answer.ind);
      writer.u16be(answer.pwe1);
      writer.u16be(answer.pwe2);
    }
    writer.u16be(inverter_.statusWord());
    writer.u16be(inverter_.actualValue(0));
    if (data.size() < length) {
      writer.u16be(inverter_.actualValue(settings_.swap_words_3_4 ? 2 : 1));
      writer.u16be(inverter_.actualValue(settings_.swap_words_3_4 ? 1 : 2));
    }
  }
  data.resize(length);  // words without use, and everything of an inverter that is off, are zero
}

void DpSlave::takeOutputs(ByteView data) noexcept {
  ByteReader reader{data};
  if (settings_.ppo_type <= 2) {
    PkwWords order;
    order.pke = reader.u16be();
    order.ind = reader.u16be();
    order.pwe1 = reader.u16be();
    order.pwe2 = reader.u16be();
    if (inverterReachable()) {
      if (referee_ != nullptr) referee_->parameterChannel(settings_.address, order, pkw_.hasAnswered(order));
      pkw_.receive(order);
    }
  }
  ProcessData process;
  process.control = reader.u16be();
  process.setpoints[0] = reader.u16be();
  if (reader.remaining() >= 4) {
    process.setpoints[settings_.swap_words_3_4 ? 2 : 1] = reader.u16be();
    process.setpoints[settings_.swap_words_3_4 ? 1 : 2] = reader.u16be();
  }
  if ((process.control & stw::kDataValid) != 0) {
    valid_data_seen_ = true;
  } else if (valid_data_seen_) {
    ++counters_.zero_control_words;
    if (referee_ != nullptr) referee_->broken(Rule::kZeroControlWord);
  }
  counters_.last_control = process.control;
  if (!inverterReachable()) return;
  inverter_.receive(process);
  parameters_.show(740, 0, process.control);
  for (unsigned i = 0; i < 3; ++i) parameters_.show(740, displayElement(i), process.setpoints[i]);
}

void DpSlave::showStatus() noexcept {
  if (!inverterReachable()) return;
  parameters_.show(741, 0, inverter_.statusWord());
  for (unsigned i = 0; i < 3; ++i) parameters_.show(741, displayElement(i), inverter_.actualValue(i));
  parameters_.show(746, 0, state_ == SlaveState::kDataExchange ? kModuleConnected : kModuleReady);
}

// P740 and P741 of SK 700E and 750E have the high word of a 32-bit value 1 in between (BU 0020 6.1.3).
unsigned DpSlave::displayElement(unsigned value) const noexcept {
  const Series series = parameters_.device().series;
  const bool gap = series == Series::kSk700e || series == Series::kSk750e;
  return 1 + value + (gap && value > 0 ? 1u : 0u);
}

// "A safe state, in which all outputs are switched to 0" (BU 2700 8.1.1): bit 10 is 0 then, so the inverter does not
// evaluate them. What stops the drive is the fault, not the zeros.
void DpSlave::clearOutputs() noexcept {
  inverter_.receive(ProcessData{});
  pkw_.receive(PkwWords{});
}

void DpSlave::toWaitParameters() noexcept {
  if (state_ == SlaveState::kDataExchange) clearOutputs();
  state_ = SlaveState::kWaitParameters;
  owner_ = kNoOwner;
  watchdog_ = Duration::zero();
  silence_ = Duration::zero();
}

void DpSlave::advance(Duration span) noexcept {
  if (state_ == SlaveState::kOff || watchdog_ == Duration::zero()) return;
  silence_ += span;
  if (silence_ < watchdog_) return;
  const bool exchanging = state_ == SlaveState::kDataExchange;
  if (exchanging) {
    ++counters_.watchdog_trips;
    counters_.control_before_loss = counters_.last_control;
    counters_.status_at_loss = inverter_.statusWord();
  }
  toWaitParameters();
  if (exchanging && inverter_link_) inverter_.masterLost();
}

std::optional<Duration> DpSlave::untilWatchdog() const noexcept {
  if (state_ == SlaveState::kOff || watchdog_ == Duration::zero()) return std::nullopt;
  return watchdog_ - silence_;
}

void DpSlave::setPowered(bool on) noexcept {
  if (on == (state_ != SlaveState::kOff)) return;
  toWaitParameters();
  state_ = on ? SlaveState::kWaitParameters : SlaveState::kOff;
  parameter_fault_ = configuration_fault_ = valid_data_seen_ = reported_unreachable_ = false;
  frame_count_known_ = false;
}

void DpSlave::setInverterLink(bool intact) noexcept {
  inverter_link_ = intact;
  inverter_.setModuleLink(intact);
}

// BU 0020 7.2 with the ident number 7531h: PPO types 2 and 4 reserve six words for the process data, two of them
// unused.
FixedBytes<2> DpSlave::configuration() const noexcept {
  switch (settings_.ppo_type) {
    case 1:
      return {0xF3, 0xF1};
    case 2:
      return {0xF3, 0xF5};
    case 3:
      return {0xF1};
    default:
      return {0xF5};
  }
}

std::size_t DpSlave::dataLength() const noexcept {
  const std::size_t parameters = settings_.ppo_type <= 2 ? kPkwBytes : 0;
  const std::size_t words = settings_.ppo_type % 2 == 1 ? 2 : 6;
  return parameters + 2 * words;
}

Telegram DpSlave::answerTo(const Telegram& request, std::uint8_t code) const noexcept {
  Telegram answer;
  answer.destination = request.source;
  answer.source = settings_.address;
  answer.function = code;
  answer.destination_sap = request.source_sap;
  answer.source_sap = request.destination_sap;
  return answer;
}

WireBytes DpSlave::answerWithout(const Telegram& request, std::uint8_t code) const noexcept {
  Telegram answer;
  answer.destination = request.source;
  answer.source = settings_.address;
  answer.function = code;
  return encodeTelegram(answer);
}

}  // namespace nord_driver::sim
