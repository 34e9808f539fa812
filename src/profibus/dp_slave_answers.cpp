// What the answers of a slave mean.
#include <algorithm>

#include "dp_slave_texts.h"
#include "nord_driver/profibus/dp_slave.h"

namespace nord_driver::profibus {

namespace {

using namespace std::chrono_literals;

// A slave that is parameterised and configured is asked for its diagnosis once per cycle at first, then more rarely;
// after the limit it gets its parameters anew, because it may have lost them.
constexpr Duration kAskOften = 1s;
constexpr Duration kAskRarely = 250ms;
constexpr Duration kReadyLimit = 5s;
constexpr Duration kOwnerLimit = 500ms;

}  // namespace

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
  forgetFaults();
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

}  // namespace nord_driver::profibus
