#include "nord_driver/profibus/dp_slave.h"

#include <algorithm>

namespace nord_driver::profibus {

namespace {

using namespace std::chrono_literals;

constexpr Duration kFirstPause = 250ms;
constexpr Duration kLongestPause = 2s;
// A slave that is parameterised and configured is asked for its diagnosis once per cycle at first, then more rarely;
// after the limit it gets its parameters anew, because it may have lost them.
constexpr Duration kAskOften = 1s;
constexpr Duration kAskRarely = 250ms;
constexpr Duration kReadyLimit = 5s;
constexpr Duration kOwnerLimit = 500ms;

constexpr const char* kNoAnswer =
    "does not answer: check its power, its address, the baud rate, the cable and its termination";
constexpr const char* kStarting = "answers, and is being parameterised";
constexpr const char* kWaiting = "has its parameters, and reports that it is not ready yet";
constexpr const char* kNoValidData = "reports that it has no valid data for the moment (Stat_Diag)";
constexpr const char* kMasterThere = "is a master, not a slave: check the addresses";
constexpr const char* kFellSilent = "fell silent: check its power and the cable";
constexpr const char* kGarbled =
    "answered with telegrams that are no answer: check the cable, and that no other station has its address";
constexpr const char* kLeft = "left data exchange by itself: its watchdog ran out, or it was switched off and on";
constexpr const char* kAsksAgain = "asks for its parameters again: it was restarted, or another master took it";
constexpr const char* kLinkOpened = "the bus device was opened anew";
constexpr const char* kWrongLength =
    "exchanges data of another length than configured: the PPO type or module list set at the device differs";
constexpr const char* kWrongIdent = "is another device than configured: its ident number differs";
constexpr const char* kLocked = "is locked by another master";
constexpr const char* kPrmFault =
    "refuses its parameters (Prm_Fault): the ident number, the user parameters or the watchdog do not suit it";
constexpr const char* kCfgFault =
    "refuses its configuration (Cfg_Fault): the PPO type or module list set at the device differs from the configured "
    "one";
constexpr const char* kServiceRefused =
    "refuses a service of its start-up: it is no DP slave, or is busy with another master";
constexpr const char* kNotReady = "has its parameters, but does not become ready for data exchange";
constexpr const char* kForgot = "was given its parameters, and asks for them again (Prm_Req)";

}  // namespace

DpSlave::DpSlave(std::size_t index, const SlaveConfig& config, const BusParameters& bus)
    : index_(index),
      config_(config),
      services_(bus),
      master_(bus.master.value()),
      probe_interval_(bus.probe_interval),
      outputs_(config.output_length, 0),
      inputs_(config.input_length, 0),
      pause_(kFirstPause) {
  status_.note = kNoAnswer;
}

void DpSlave::restart(Instant now, DpEvents& events) noexcept {
  if (status_.phase == SlavePhase::DataExchange) lose(LossCause::LinkRestarted, kLinkOpened, events);
  pause_ = kFirstPause;
  told_fault_.reset();
  told_found_ = false;
  startCycle();
  fallSilent(now, kNoAnswer);
}

void DpSlave::startCycle() noexcept {
  stepped_ = false;
  diagnosed_ = false;
  status_.exchanged_this_cycle = false;
}

bool DpSlave::wantsExchange() const noexcept {
  return status_.phase == SlavePhase::DataExchange && !stepped_;
}

bool DpSlave::wantsStartUpStep(Instant now) const noexcept {
  const bool starting = status_.phase != SlavePhase::Silent && status_.phase != SlavePhase::DataExchange;
  return starting && !stepped_ && now >= due_;
}

bool DpSlave::wantsDiagnosis() const noexcept {
  return status_.phase == SlavePhase::DataExchange && stepped_ && diagnosis_due_ && !diagnosed_;
}

bool DpSlave::wantsProbe(Instant now) const noexcept {
  return status_.phase == SlavePhase::Silent && !stepped_ && now >= due_;
}

DpSlave::Service DpSlave::nextService() noexcept {
  switch (status_.phase) {
    case SlavePhase::Silent:
      return Service::FdlStatus;
    case SlavePhase::BackOff:
      startOver(status_.note);  // the reason stays readable until it is gone
      return Service::SlaveDiag;
    case SlavePhase::FirstDiagnosis:
    case SlavePhase::AwaitReady:
      return Service::SlaveDiag;
    case SlavePhase::Parameters:
      return Service::SetPrm;
    case SlavePhase::Configuration:
      return Service::ChkCfg;
    case SlavePhase::DataExchange:
      return stepped_ ? Service::SlaveDiag : Service::DataExchange;
  }
  return Service::FdlStatus;
}

void DpSlave::prepare(FdlRequest& request, Instant now) noexcept {
  asked_ = nextService();
  if (stepped_) diagnosed_ = true;
  stepped_ = true;
  switch (asked_) {
    case Service::FdlStatus:
      due_ = now + probe_interval_;
      services_.fdlStatus(request, config_.address);
      break;
    case Service::SlaveDiag:
      services_.slaveDiag(request, config_.address, frame_count_.bits());
      break;
    case Service::SetPrm:
      services_.setPrm(request, config_,
                       config_.expect_exact_ident ? config_.ident_number : status_.ident.value_or(config_.ident_number),
                       frame_count_.bits());
      break;
    case Service::ChkCfg:
      services_.chkCfg(request, config_, frame_count_.bits());
      break;
    case Service::DataExchange:
      services_.dataExchange(request, config_, outputs_, frame_count_.bits());
      break;
  }
}

void DpSlave::handleAnswer(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  if (asked_ != Service::FdlStatus) frame_count_.answered();
  switch (asked_) {
    case Service::FdlStatus:
      return onFdlStatus(answer, now, events);
    case Service::SlaveDiag:
      return onDiagnosis(answer, now, events);
    case Service::SetPrm:
    case Service::ChkCfg:
      return onAcknowledge(answer, now, events);
    case Service::DataExchange:
      return onExchange(answer, now, events);
  }
}

void DpSlave::handleNoAnswer(Mismatch mismatch, Instant now, DpEvents& events) noexcept {
  frame_count_.reset();
  if (status_.phase == SlavePhase::Silent) return;
  if (status_.phase != SlavePhase::DataExchange) return fallSilent(now + probe_interval_, kNoAnswer);

  const bool other_length =
      asked_ == Service::DataExchange && (mismatch == Mismatch::Length || mismatch == Mismatch::Acknowledge);
  if (other_length) {
    lose(LossCause::WrongAnswers, kWrongLength, events);
    return backOff({DpEventKind::ConfigurationFault, kWrongLength}, now, events);
  }
  if (mismatch == Mismatch::None || mismatch == Mismatch::Stranger) {
    lose(LossCause::Silence, kFellSilent, events);
  } else {
    lose(LossCause::WrongAnswers, kGarbled, events);
  }
  fallSilent(now, kNoAnswer);  // asked again in the next cycle: most silences are short
}

void DpSlave::onFdlStatus(const FdlAnswer& answer, Instant, DpEvents& events) noexcept {
  if (answer.kind != FdlAnswer::Kind::Acknowledge) return;
  if (answer.station_type != StationType::Slave) {
    status_.note = kMasterThere;
    if (told_fault_ == DpEventKind::ForeignMaster) return;
    told_fault_ = DpEventKind::ForeignMaster;
    DpEvent told = event(DpEventKind::ForeignMaster, kMasterThere);
    told.master = config_.address.value();
    events.push(told);
    return;
  }
  status_.ident.reset();
  startOver(kStarting);
  if (!told_found_) events.push(event(DpEventKind::SlaveFound, kStarting));
  told_found_ = true;
}

void DpSlave::onDiagnosis(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  const bool exchanging = status_.phase == SlavePhase::DataExchange;
  const auto diagnosis = answer.kind == FdlAnswer::Kind::Data ? Diagnosis::from(answer.data) : std::nullopt;
  if (!diagnosis) {
    if (!exchanging) return backOff({DpEventKind::ServiceRefused, kServiceRefused}, now, events);
    if (answer.code != ResponseCode::NotActivated) return;  // asked for again after the next exchange
    lose(LossCause::LeftDataExchange, kLeft, events);
    return startOver(kLeft);
  }
  ++status_.counters.diagnoses;
  status_.diagnosis = *diagnosis;
  status_.ident = diagnosis->ident();
  if (exchanging) return judgeInExchange(now, events);
  if (status_.phase == SlavePhase::AwaitReady) return judgeReady(now, events);
  judgeFirst(now, events);
}

void DpSlave::onAcknowledge(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  if (answer.kind != FdlAnswer::Kind::Acknowledge) {
    return backOff({DpEventKind::ServiceRefused, kServiceRefused}, now, events);
  }
  if (asked_ == Service::SetPrm) {
    status_.phase = SlavePhase::Configuration;
    return;
  }
  // That SC came says nothing about the content: the next diagnosis does.
  status_.phase = SlavePhase::AwaitReady;
  ready_since_ = now;
}

void DpSlave::onExchange(const FdlAnswer& answer, Instant, DpEvents& events) noexcept {
  if (answer.kind == FdlAnswer::Kind::Refusal) {
    if (answer.code == ResponseCode::NotActivated) {
      lose(LossCause::LeftDataExchange, kLeft, events);
      return startOver(kLeft);
    }
    diagnosis_due_ = true;  // no data, no reason: ask for it
    return;
  }
  ++status_.counters.exchanges;
  pause_ = kFirstPause;
  told_fault_.reset();
  if (answer.code == ResponseCode::DataHigh) diagnosis_due_ = true;
  if (status_.diagnosis.staticDiagnosis()) return;  // its inputs mean nothing
  std::copy(answer.data.begin(), answer.data.end(), inputs_.begin());
  status_.exchanged_this_cycle = true;
}

std::optional<DpSlave::Fault> DpSlave::strangerIn(const Diagnosis& diagnosis) const noexcept {
  if (config_.expect_exact_ident && diagnosis.ident() != config_.ident_number) {
    return Fault{DpEventKind::WrongIdent, kWrongIdent};
  }
  if (diagnosis.owner() != kNoOwner && diagnosis.owner() != master_) return Fault{DpEventKind::LockedByMaster, kLocked};
  return std::nullopt;
}

std::optional<DpSlave::Fault> DpSlave::faultIn(const Diagnosis& diagnosis) const noexcept {
  if (const auto stranger = strangerIn(diagnosis)) return stranger;
  if (diagnosis.parameterFault()) return Fault{DpEventKind::ParameterFault, kPrmFault};
  if (diagnosis.configurationFault()) return Fault{DpEventKind::ConfigurationFault, kCfgFault};
  return std::nullopt;
}

// Faults shown here are those of an earlier start-up, perhaps of another master: Set_Prm takes them away.
void DpSlave::judgeFirst(Instant now, DpEvents& events) noexcept {
  if (const auto stranger = strangerIn(status_.diagnosis)) return backOff(*stranger, now, events);
  status_.phase = SlavePhase::Parameters;
}

void DpSlave::judgeReady(Instant now, DpEvents& events) noexcept {
  const Diagnosis& diagnosis = status_.diagnosis;
  if (const auto fault = faultIn(diagnosis)) return backOff(*fault, now, events);
  const Duration waited = now - ready_since_;
  const bool ours = !diagnosis.parameterRequest() && diagnosis.owner() == master_;
  if (ours && !diagnosis.notReady() && !diagnosis.staticDiagnosis()) {
    status_.phase = SlavePhase::DataExchange;
    status_.note = "";
    diagnosis_due_ = false;
    events.push(event(DpEventKind::DataExchangeEntered, ""));
    return;
  }
  if (!ours && waited >= kOwnerLimit) return backOff({DpEventKind::NotReady, kForgot}, now, events);
  if (waited >= kReadyLimit) return backOff({DpEventKind::NotReady, kNotReady}, now, events);
  status_.note = diagnosis.staticDiagnosis() ? kNoValidData : kWaiting;
  if (waited >= kAskOften) due_ = now + kAskRarely;
}

void DpSlave::judgeInExchange(Instant now, DpEvents& events) noexcept {
  const Diagnosis& diagnosis = status_.diagnosis;
  if (const auto fault = faultIn(diagnosis)) {
    lose(LossCause::ParametersRequested, fault->text, events);
    return backOff(*fault, now, events);
  }
  if (diagnosis.parameterRequest() || diagnosis.owner() != master_) {
    lose(LossCause::ParametersRequested, kAsksAgain, events);
    return startOver(kAsksAgain);
  }
  // While Stat_Diag stands, outputs go on (a stop must reach the drive), inputs do not count, and the diagnosis is
  // fetched after every exchange until it has gone.
  diagnosis_due_ = diagnosis.staticDiagnosis();
  if (diagnosis.staticDiagnosis()) status_.exchanged_this_cycle = false;
  status_.note = diagnosis.staticDiagnosis() ? kNoValidData : "";
}

void DpSlave::fallSilent(Instant due, const char* note) noexcept {
  frame_count_.reset();
  diagnosis_due_ = false;
  status_.phase = SlavePhase::Silent;
  status_.note = note;
  due_ = due;
}

void DpSlave::startOver(const char* note) noexcept {
  frame_count_.reset();
  diagnosis_due_ = false;
  status_.phase = SlavePhase::FirstDiagnosis;
  status_.note = note;
  due_ = Instant{};
}

void DpSlave::lose(LossCause cause, const char* text, DpEvents& events) noexcept {
  ++status_.counters.losses;
  status_.exchanged_this_cycle = false;
  told_found_ = false;
  DpEvent lost = event(DpEventKind::SlaveLost, text);
  lost.cause = cause;
  events.push(lost);
}

void DpSlave::backOff(const Fault& fault, Instant now, DpEvents& events) noexcept {
  ++status_.counters.refusals;
  startOver(fault.text);
  status_.phase = SlavePhase::BackOff;
  due_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  if (told_fault_ == fault.kind) return;
  told_fault_ = fault.kind;
  events.push(event(fault.kind, fault.text));
}

DpEvent DpSlave::event(DpEventKind kind, const char* text) const noexcept {
  DpEvent told;
  told.kind = kind;
  told.slave = index_;
  told.master = status_.diagnosis.empty() ? kNoOwner : status_.diagnosis.owner();
  told.ident = status_.ident.value_or(0);
  told.text = text;
  return told;
}

void DpSlave::setOutputs(ByteView outputs) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = i < outputs.size() ? outputs[i] : std::uint8_t{0};
}

}  // namespace nord_driver::profibus
