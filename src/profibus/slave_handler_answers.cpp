// What the answers of a slave mean.
#include <algorithm>

#include "profibus/slave_handler.h"
#include "profibus/slave_handler_texts.h"
#include "profibus/watchdog_factors.h"

namespace nord_driver::profibus {

namespace {

using namespace std::chrono_literals;

// A slave that is parameterised and configured is asked for its diagnosis once per cycle at first, then more rarely;
// after the limit it gets its parameters anew, because it may have lost them.
constexpr Duration kAskOften = 1s;
constexpr Duration kAskRarely = 250ms;
// Set_Prm has started its watchdog, and until data exchange nothing but Slave_Diag feeds it. The next one comes up to a
// cycle late, which is half of that time at most.
constexpr int kAskedPerWatchdog = 3;
constexpr Duration kReadyLimit = 5s;
constexpr Duration kOwnerLimit = 500ms;

}  // namespace

void SlaveHandler::handleAnswer(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  if (asked_ != Service::kFdlStatus) frame_count_.answered();
  last_answer_ = now;
  status_.heard = true;
  switch (asked_) {
    case Service::kFdlStatus:
      return onFdlStatus(answer, now, events);
    case Service::kSlaveDiag:
      return onDiagnosis(answer, now, events);
    case Service::kGetCfg:
      return onConfiguration(answer, now, events);
    case Service::kSetPrm:
    case Service::kChkCfg:
      return onAcknowledge(answer, now, events);
    case Service::kDataExchange:
      return onExchange(answer, now, events);
    case Service::kRecord:
      return records_.handleAnswer(answer, now);
  }
}

void SlaveHandler::handleNoAnswer(Mismatch mismatch, Instant now, DpEvents& events) noexcept {
  if (asked_ == Service::kRecord || asked_ == Service::kGetCfg) return handleNoOptionalAnswer(now, events);
  status_.heard = false;
  if (status_.phase == SlavePhase::kDataExchange) return handleNoExchange(mismatch, now, events);
  if (status_.phase == SlavePhase::kSilent) {
    status_.note = texts::kNoAnswer;
  } else {
    if (resuming_) timers_.set(Timer::kNoParameters, now + config_.watchdog);
    fallSilent(timers_.isRunning(Timer::kHaste, now) ? now : now + probe_interval_, texts::kNoAnswer);
  }
}

// The exchange or the diagnosis beside it. A slave stays in data exchange until its watchdog runs out: for as long as
// the silence may last, the next cycle asks it again, and whether it took this request is not known, so that the frame
// count begins anew. With another count it might take the new outputs for a repetition of the old. A slave that answers
// with another length, or with E5, may take the outputs all the same: it, too, is sent the stop words until then.
void SlaveHandler::handleNoExchange(Mismatch mismatch, Instant now, DpEvents& events) noexcept {
  const bool exchange = asked_ == Service::kDataExchange;
  if (!exchange && !timers_.isSet(Timer::kUndiagnosedLimit)) {
    timers_.set(Timer::kUndiagnosedLimit, now + silence_limit_);
  }
  const bool ended = exchange ? now - last_answer_ >= silence_limit_ : timers_.isOver(Timer::kUndiagnosedLimit, now);
  if (!ended) {
    if (exchange) status_.note = mismatch == Mismatch::kLength ? texts::kWrongLength : texts::kNoAnswer;
    return frame_count_.reset();
  }
  if (exchange && (mismatch == Mismatch::kLength || mismatch == Mismatch::kAcknowledge)) {
    lose(LossCause::kWrongAnswers, texts::kWrongLength, now, events);
    backOff({DpEventKind::kConfigurationFault, texts::kWrongLength}, now, events);
    return waitForWatchdog();
  }
  if (mismatch == Mismatch::kNone || mismatch == Mismatch::kStranger) {
    lose(LossCause::kSilence, texts::kFellSilent, now, events);
  } else {
    lose(LossCause::kWrongAnswers, texts::kGarbled, now, events);
  }
  mayRunUntilWatchdogOf(now);
  fallSilent(now, texts::kNoAnswer);  // asked again in the next cycle: most silences are short
}

// A service the exchange can do without. Whether the slave took the request is not known: the next one begins the frame
// count anew. If the slave is gone, that one finds out.
void SlaveHandler::handleNoOptionalAnswer(Instant now, DpEvents& events) noexcept {
  frame_count_.reset();
  if (asked_ == Service::kRecord) return records_.handleNoAnswer(now);
  if (status_.phase == SlavePhase::kDataExchange) {
    events.push(event(DpEventKind::kConfigurationRead, texts::kNoConfiguration));
  } else {
    status_.phase = SlavePhase::kParameters;
  }
}

void SlaveHandler::onFdlStatus(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  if (answer.kind != FdlAnswer::Kind::kAcknowledge) return;
  if (answer.station_type != StationType::kSlave) {
    status_.note = texts::kMasterThere;
    if (told_fault_ == DpEventKind::kForeignMaster) return;
    told_fault_ = DpEventKind::kForeignMaster;
    DpEvent told = event(DpEventKind::kForeignMaster, texts::kMasterThere);
    told.master = config_.address.value();
    events.push(told);
    return;
  }
  if (!told_found_) events.push(event(DpEventKind::kSlaveFound, texts::kStarting));
  told_found_ = true;
  const bool exchanges = status_.phase == SlavePhase::kSilent && timers_.isRunning(Timer::kWatchdog, now);
  if (!exchanges && timers_.isRunning(Timer::kNoParameters, now)) {
    status_.note = texts::kMayRun;
    return;
  }
  if (!exchanges) status_.ident.reset();
  startOver(texts::kStarting, exchanges);
}

void SlaveHandler::onDiagnosis(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  const bool exchanging = status_.phase == SlavePhase::kDataExchange;
  const auto diagnosis = answer.kind == FdlAnswer::Kind::kData ? Diagnosis::from(answer.data) : std::nullopt;
  if (!diagnosis) {
    if (!exchanging) return backOff({DpEventKind::kServiceRefused, texts::kServiceRefused}, now, events);
    if (answer.code != ResponseCode::kNotActivated) return;  // asked for again after the next exchange
    lose(LossCause::kLeftDataExchange, texts::kLeft, now, events);
    return startOver(texts::kLeft);
  }
  ++status_.counters.diagnoses;
  timers_.stop(Timer::kUndiagnosedLimit);
  status_.diagnosis = *diagnosis;
  status_.ident = diagnosis->ident();
  if (exchanging) return judgeInExchange(now, events);
  if (status_.phase == SlavePhase::kAwaitReady) return judgeReady(now, events);
  judgeFirst(now, events);
}

// Beside data exchange a difference is only told: what works is not ended.
void SlaveHandler::onConfiguration(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  const bool exchanging = status_.phase == SlavePhase::kDataExchange;
  status_.configuration.clear();
  for (const std::uint8_t byte : answer.data) status_.configuration.push_back(byte);
  const bool told = answer.kind == FdlAnswer::Kind::kData;
  const bool differs = told && ByteView{status_.configuration} != ByteView{config_.configuration};
  if (exchanging) events.push(event(DpEventKind::kConfigurationRead, told ? "" : texts::kNoConfiguration));
  if (differs && !exchanging && config_.configuration_check == ConfigurationCheck::kRequire) {
    return backOff({DpEventKind::kConfigurationDiffers, texts::kOtherConfiguration}, now, events);
  }
  if (differs && !told_configuration_) {
    told_configuration_ = true;
    events.push(event(DpEventKind::kConfigurationDiffers, texts::kOtherConfiguration));
  }
  if (!exchanging) status_.phase = SlavePhase::kParameters;
}

void SlaveHandler::onAcknowledge(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  // A slave that refuses Set_Prm acknowledges it with SC, waits for other parameters, and answers Chk_Cfg with RS there.
  const bool not_activated = answer.kind == FdlAnswer::Kind::kRefusal && answer.code == ResponseCode::kNotActivated;
  const bool parameters_refused = asked_ == Service::kChkCfg && not_activated;
  if (answer.kind != FdlAnswer::Kind::kAcknowledge && !parameters_refused) {
    return backOff({DpEventKind::kServiceRefused, texts::kServiceRefused}, now, events);
  }
  if (asked_ == Service::kSetPrm) {
    records_.handleStartUp();
    status_.phase = SlavePhase::kConfiguration;
    return;
  }
  // Neither SC nor RS says anything about the content: the next diagnosis does.
  status_.phase = SlavePhase::kAwaitReady;
  timers_.set(Timer::kAskOften, now + kAskOften);
  timers_.set(Timer::kOwnerLimit, now + kOwnerLimit);
  timers_.set(Timer::kReadyLimit, now + kReadyLimit);
}

// RR, UE, RDL and RDH: outputs not taken; NR: taken, but no inputs. The first are asked for the reason. Where they last, a
// slave whose requests feed its watchdog would keep its drive as it was told last, though the stop words go out: it is
// lost, as after a silence, and asked for nothing until its watchdog has run out.
void SlaveHandler::handleRefusedExchange(ResponseCode code, Instant now, DpEvents& events) noexcept {
  if (code == ResponseCode::kNotActivated) {
    if (!resuming_) lose(LossCause::kLeftDataExchange, texts::kLeft, now, events);
    return startOver(resuming_ ? texts::kStarting : texts::kLeft);
  }
  if (resuming_) enterDataExchange(events);  // only RS says that it is not in it
  diagnosis_due_ = true;
  if (!timers_.isSet(Timer::kRefusedLimit)) return timers_.set(Timer::kRefusedLimit, now + silence_limit_);
  if (timers_.isRunning(Timer::kRefusedLimit, now)) return;
  lose(LossCause::kRefused, texts::kRefusesExchange, now, events);
  backOff({DpEventKind::kServiceRefused, texts::kRefusesExchange}, now, events);
  waitForWatchdog();
}

// Behind backOff(), of a slave that may be in data exchange with us still: every request feeds its watchdog, Set_Prm
// starts it anew and clears the outputs, which stops nothing, and a refused Chk_Cfg ends it without a trip. It is asked
// for nothing until it has run out.
void SlaveHandler::waitForWatchdog() noexcept {
  mayRunUntilWatchdogOf(last_request_);
  timers_.prolong(Timer::kNextRequest, last_request_ + config_.watchdog + kWatchdogTolerance);
}

void SlaveHandler::onExchange(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept {
  if (answer.kind == FdlAnswer::Kind::kRefusal) return handleRefusedExchange(answer.code, now, events);
  timers_.stop(Timer::kRefusedLimit);
  if (resuming_) enterDataExchange(events);
  ++status_.counters.exchanges;
  forgetFaults();
  status_.note = status_.diagnosis.staticDiagnosis() ? texts::kNoValidData : "";
  if (answer.code == ResponseCode::kDataHigh) diagnosis_due_ = true;
  if (status_.diagnosis.staticDiagnosis()) return;  // its inputs mean nothing
  std::copy(answer.data.begin(), answer.data.end(), inputs_.begin());
  status_.exchanged_this_cycle = true;
}

std::optional<SlaveHandler::Fault> SlaveHandler::strangerIn(const Diagnosis& diagnosis) const noexcept {
  if (config_.expect_exact_ident && diagnosis.ident() != config_.ident_number) {
    return Fault{DpEventKind::kWrongIdent, texts::kWrongIdent};
  }
  if (diagnosis.owner() != kNoOwner && diagnosis.owner() != master_)
    return Fault{DpEventKind::kLockedByMaster, texts::kLocked};
  return std::nullopt;
}

std::optional<SlaveHandler::Fault> SlaveHandler::faultIn(const Diagnosis& diagnosis) const noexcept {
  if (const auto stranger = strangerIn(diagnosis)) return stranger;
  if (diagnosis.parameterFault()) {
    return Fault{DpEventKind::kParameterFault, diagnosis.notSupported() ? texts::kPrmNotSupported : texts::kPrmFault};
  }
  if (diagnosis.configurationFault()) return Fault{DpEventKind::kConfigurationFault, texts::kCfgFault};
  return std::nullopt;
}

// Of a master that brings no watchdog: another one with our address has parameterised it, was killed perhaps, and the
// watchdog that one has brought still runs. It is all that will stop the drive.
bool SlaveHandler::isLeftRunning(const Diagnosis& diagnosis) const noexcept {
  const bool ours = !diagnosis.parameterRequest() && diagnosis.owner() == master_;
  return config_.watchdog == Duration::zero() && ours && diagnosis.watchdogOn();
}

void SlaveHandler::leaveRunning(Instant now, DpEvents& events) noexcept {
  backOff({DpEventKind::kLeftRunning, watchdog_unasked_ ? texts::kWatchdogUnasked : texts::kLeftRunning}, now, events);
  // No diagnosis tells how long its watchdog is, and each request starts it anew.
  timers_.prolong(Timer::kNextRequest, last_request_ + kLongestWatchdog + kWatchdogTolerance);
}

// Faults shown here are those of an earlier start-up, perhaps of another master: Set_Prm takes them away.
void SlaveHandler::judgeFirst(Instant now, DpEvents& events) noexcept {
  if (isLeftRunning(status_.diagnosis)) return leaveRunning(now, events);
  watchdog_unasked_ = false;
  if (const auto stranger = strangerIn(status_.diagnosis)) return backOff(*stranger, now, events);
  const bool always = config_.configuration_check >= ConfigurationCheck::kTell;
  const bool doubted = configuration_doubted_ && config_.configuration_check == ConfigurationCheck::kAfterFault;
  status_.phase = always || doubted ? SlavePhase::kReadConfiguration : SlavePhase::kParameters;
}

void SlaveHandler::judgeReady(Instant now, DpEvents& events) noexcept {
  const Diagnosis& diagnosis = status_.diagnosis;
  if (isLeftRunning(diagnosis)) {
    // None ran before our own Set_Prm. Going on might feed another master's, which has our address, all the same.
    watchdog_unasked_ = true;
    return leaveRunning(now, events);
  }
  if (const auto fault = faultIn(diagnosis)) return backOff(*fault, now, events);
  const bool ours = !diagnosis.parameterRequest() && diagnosis.owner() == master_;
  if (ours && !diagnosis.notReady() && !diagnosis.staticDiagnosis()) return enterDataExchange(events);
  if (!ours && timers_.isOver(Timer::kOwnerLimit, now)) {
    return backOff({DpEventKind::kNotReady, texts::kForgot}, now, events);
  }
  if (timers_.isOver(Timer::kReadyLimit, now)) {
    return backOff({DpEventKind::kNotReady, texts::kNotReady}, now, events);
  }
  status_.note = diagnosis.staticDiagnosis() ? texts::kNoValidData : texts::kWaiting;
  if (timers_.isRunning(Timer::kAskOften, now)) return;
  const bool watched = config_.watchdog > Duration::zero();
  const Duration pause = watched ? std::min(kAskRarely, config_.watchdog / kAskedPerWatchdog) : kAskRarely;
  timers_.set(Timer::kNextRequest, last_request_ + pause);
}

void SlaveHandler::judgeInExchange(Instant now, DpEvents& events) noexcept {
  const Diagnosis& diagnosis = status_.diagnosis;
  const bool left = diagnosis.parameterRequest() || diagnosis.owner() != master_;
  if (isLeftRunning(diagnosis)) {
    lose(LossCause::kParametersRequested, texts::kTaken, now, events);
    return leaveRunning(now, events);
  }
  if (const auto fault = faultIn(diagnosis)) {
    lose(LossCause::kParametersRequested, fault->text, now, events);
    backOff(*fault, now, events);
    if (!left) waitForWatchdog();
    return;
  }
  if (left) {
    lose(LossCause::kParametersRequested, texts::kAsksAgain, now, events);
    return startOver(texts::kAsksAgain);
  }
  // While Stat_Diag stands, outputs go on (a stop must reach the drive), inputs do not count, and the diagnosis is
  // fetched after every exchange until it has gone.
  diagnosis_due_ = diagnosis.staticDiagnosis();
  if (diagnosis.staticDiagnosis()) status_.exchanged_this_cycle = false;
  status_.note = diagnosis.staticDiagnosis() ? texts::kNoValidData : "";
}

}  // namespace nord_driver::profibus
