// The requests of a slave, and how it moves between its phases.
#include "profibus/slave_handler.h"

#include <algorithm>

#include "profibus/configuration_bytes.h"
#include "profibus/slave_handler_texts.h"

namespace nord_driver::profibus {

namespace {

using namespace std::chrono_literals;

constexpr Duration kFirstPause = 250ms;
constexpr Duration kLongestPause = 1500ms;  // and a start-up: back within 2 s
// A slave with a longer watchdog is found in time without haste.
constexpr Duration kHasteLimit = 1s;

}  // namespace

SlaveHandler::SlaveHandler(std::size_t index, const SlaveConfig& config, const BusParameters& bus)
    : index_(index),
      config_(config),
      services_(bus),
      master_(bus.master.value()),
      probe_interval_(bus.probe_interval),
      records_(index, config.record_timeout),
      outputs_(config.output_length, 0),
      inputs_(config.input_length, 0),
      back_off_(kFirstPause, kLongestPause) {
  status_.note = texts::kNoAnswer;
}

void SlaveHandler::restart(Instant now, DpEvents& events) noexcept {
  // Whatever the line did, it may run on as it was told last: see nextService().
  if (status_.phase == SlavePhase::kDataExchange || resuming_) mayRunUntilWatchdogOf(last_request_);
  if (status_.phase == SlavePhase::kDataExchange) lose(LossCause::kLinkRestarted, texts::kLinkOpened, now, events);
  forgetFaults();
  told_found_ = false;
  startCycle();
  fallSilent(now, texts::kNoAnswer);
}

// What it is told from now on is not known: nothing is gone on with afterwards. Who is left to its watchdog is so still.
void SlaveHandler::giveWay(Instant now, DpEvents& events) noexcept {
  if (isLeftToItsWatchdog()) return;
  if (status_.phase == SlavePhase::kDataExchange) lose(LossCause::kGivenWay, texts::kGivenWay, now, events);
  timers_.stop(Timer::kWatchdog);
  timers_.stop(Timer::kHaste);
  forgetFaults();
  told_found_ = false;
  startCycle();
  fallSilent(now, texts::kGivenWay);
}

void SlaveHandler::startCycle() noexcept {
  stepped_ = false;
  status_.exchanged_this_cycle = false;
}

bool SlaveHandler::wantsExchange() const noexcept {
  return status_.phase == SlavePhase::kDataExchange && !stepped_;
}

bool SlaveHandler::wantsStartUpStep(Instant now) const noexcept {
  const bool starting = status_.phase != SlavePhase::kSilent && status_.phase != SlavePhase::kDataExchange;
  return starting && !stepped_ && !timers_.isRunning(Timer::kNextRequest, now);
}

bool SlaveHandler::wantsDiagnosis() const noexcept {
  return status_.phase == SlavePhase::kDataExchange && stepped_ && status_.heard && diagnosis_due_;
}

bool SlaveHandler::wantsProbe(Instant now) const noexcept {
  return status_.phase == SlavePhase::kSilent && !stepped_ && !timers_.isRunning(Timer::kNextRequest, now);
}

SlaveHandler::Service SlaveHandler::nextService() noexcept {
  switch (status_.phase) {
    case SlavePhase::kSilent:
      return Service::kFdlStatus;
    case SlavePhase::kBackOff:
      startOver(status_.note);  // the reason stays readable until it is gone
      return Service::kSlaveDiag;
    // Its watchdog had not run out when it was found again: it is in data exchange with us, and its drive may turn as it
    // was told last. Set_Prm would start the watchdog anew and clear the outputs, which stops nothing (BU 2700 7.1.1: a
    // control word without bit 10 is not evaluated); where start-ups are broken off again and again it would turn on for
    // ever. The next word reaches it at once.
    case SlavePhase::kFirstDiagnosis:
      return resuming_ ? Service::kDataExchange : Service::kSlaveDiag;
    case SlavePhase::kAwaitReady:
      return Service::kSlaveDiag;
    case SlavePhase::kReadConfiguration:
      return Service::kGetCfg;
    case SlavePhase::kParameters:
      return Service::kSetPrm;
    case SlavePhase::kConfiguration:
      return Service::kChkCfg;
    case SlavePhase::kDataExchange:
      return stepped_ ? Service::kSlaveDiag : Service::kDataExchange;
  }
  return Service::kFdlStatus;
}

void SlaveHandler::prepare(FdlRequest& request, Instant now) noexcept {
  asked_ = nextService();
  stepped_ = true;
  switch (asked_) {
    case Service::kRecord:  // prepareAcyclic()
      break;
    case Service::kFdlStatus:
      timers_.set(Timer::kNextRequest, isUrgent(now) ? now : now + probe_interval_);
      services_.fdlStatus(request, config_.address);
      break;
    case Service::kSlaveDiag:
      services_.slaveDiag(request, config_.address, frame_count_.bits());
      break;
    case Service::kGetCfg:
      services_.getCfg(request, config_.address, frame_count_.bits());
      break;
    case Service::kSetPrm:
      services_.setPrm(request, config_,
                       config_.expect_exact_ident ? config_.ident_number : status_.ident.value_or(config_.ident_number),
                       frame_count_.bits());
      break;
    case Service::kChkCfg:
      services_.chkCfg(request, config_, frame_count_.bits());
      break;
    case Service::kDataExchange:
      services_.dataExchange(request, config_, outputs_, frame_count_.bits());
      break;
  }
}

bool SlaveHandler::wantsAcyclic(Instant now) noexcept {
  if (status_.phase != SlavePhase::kDataExchange || !status_.heard) return false;
  return configuration_wanted_ || records_.wantsTelegram(now);
}

void SlaveHandler::prepareAcyclic(FdlRequest& request, Instant now) noexcept {
  if (configuration_wanted_) {
    configuration_wanted_ = false;
    asked_ = Service::kGetCfg;
    return services_.getCfg(request, config_.address, frame_count_.bits());
  }
  asked_ = Service::kRecord;
  services_.record(request, config_.address, records_.pollTelegram(now), frame_count_.bits());
}

bool SlaveHandler::requestConfiguration() noexcept {
  configuration_wanted_ = status_.phase == SlavePhase::kDataExchange;
  return configuration_wanted_;
}

Sentence SlaveHandler::configurationText() const noexcept {
  if (status_.configuration.empty()) return "has not been asked for its configuration, or did not tell";
  return compareConfigurations(config_.configuration, status_.configuration);
}

bool SlaveHandler::submitRecord(const RecordRequest& request) noexcept {
  std::optional<RecordOutcome> unusable;
  if (status_.phase != SlavePhase::kDataExchange) unusable = RecordOutcome::kOffline;
  if (!config_.dpv1) unusable = RecordOutcome::kNotSupported;
  return records_.submit(request, unusable);
}

// Its watchdog runs from the last request on that it heard.
void SlaveHandler::mayRunUntilWatchdogOf(Instant heard) noexcept {
  timers_.set(Timer::kWatchdog, heard + config_.watchdog);
  timers_.set(Timer::kHaste, heard + std::min(config_.watchdog, kHasteLimit));
}

void SlaveHandler::fallSilent(Instant due, const char* note) noexcept {
  resuming_ = false;
  diagnosis_due_ = false;
  timers_.stop(Timer::kUndiagnosedLimit);
  timers_.stop(Timer::kRefusedLimit);
  status_.phase = SlavePhase::kSilent;
  status_.heard = false;
  status_.note = note;
  timers_.set(Timer::kNextRequest, due);
}

// The only way into a start-up: the first request has FCV = 0 and FCB = 1 again.
void SlaveHandler::startOver(const char* note, bool resumes) noexcept {
  resuming_ = resumes;
  if (exchanged_ && !resumes) {
    exchanged_ = false;
    ++status_.counters.departures;
  }
  frame_count_.reset();
  diagnosis_due_ = false;
  timers_.stop(Timer::kUndiagnosedLimit);
  timers_.stop(Timer::kRefusedLimit);
  status_.phase = SlavePhase::kFirstDiagnosis;
  status_.note = note;
  timers_.stop(Timer::kNextRequest);
}

void SlaveHandler::enterDataExchange(DpEvents& events) noexcept {
  // Gone on with after a silence: what stood before it need not stand still, and what was announced meanwhile, or before
  // without being heard, is not announced again.
  diagnosis_due_ = resuming_ || status_.diagnosis.staticDiagnosis();
  resuming_ = false;
  exchanged_ = true;
  status_.phase = SlavePhase::kDataExchange;
  status_.note = "";
  events.push(event(DpEventKind::kDataExchangeEntered, ""));
}

void SlaveHandler::lose(LossCause cause, const char* text, Instant now, DpEvents& events) noexcept {
  ++status_.counters.losses;
  records_.handleOffline(now);
  configuration_wanted_ = false;
  status_.exchanged_this_cycle = false;
  told_found_ = false;
  DpEvent lost = event(DpEventKind::kSlaveLost, text);
  lost.cause = cause;
  events.push(lost);
}

void SlaveHandler::backOff(const Fault& fault, Instant now, DpEvents& events) noexcept {
  ++status_.counters.refusals;
  if (fault.kind == DpEventKind::kConfigurationFault) configuration_doubted_ = true;
  startOver(fault.text);
  status_.phase = SlavePhase::kBackOff;
  timers_.set(Timer::kNextRequest, now + back_off_.next());
  if (told_fault_ == fault.kind) return;
  told_fault_ = fault.kind;
  events.push(event(fault.kind, fault.text));
}

void SlaveHandler::forgetFaults() noexcept {
  back_off_.reset();
  told_configuration_ = false;
  configuration_doubted_ = false;
  told_fault_.reset();
}

DpEvent SlaveHandler::event(DpEventKind kind, const char* text) const noexcept {
  DpEvent told;
  told.kind = kind;
  told.slave = index_;
  told.master = status_.diagnosis.empty() ? kNoOwner : status_.diagnosis.owner();
  told.ident = status_.ident.value_or(0);
  told.text = text;
  return told;
}

void SlaveHandler::setSilenceLimit(Duration limit) noexcept {
  const bool watched = config_.watchdog > Duration::zero();
  silence_limit_ = watched ? std::min(limit, config_.watchdog) : limit;
}

void SlaveHandler::setOutputs(ByteView outputs) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = i < outputs.size() ? outputs[i] : std::uint8_t{0};
}

}  // namespace nord_driver::profibus
