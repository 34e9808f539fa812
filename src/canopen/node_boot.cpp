#include "canopen/node_boot.h"

#include <cstring>

#include "canopen/boot_sentences.h"
#include "canopen/error_control_objects.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint16_t kErrorRegisterIndex = 0x1001;
constexpr std::uint16_t kErrorFieldIndex = 0x1003;

NmtCommand resetCommand(BootReset reset) noexcept {
  return reset == BootReset::kResetNode ? NmtCommand::kResetNode : NmtCommand::kResetCommunication;
}

}  // namespace

NodeBoot::NodeBoot(const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, NodeReport& report,
                   SdoPort& port, NodeTimers& timers) noexcept
    : config_(config),
      report_(report),
      port_(port),
      timers_(timers),
      script_(config, own_id),
      release_script_(config.error_control),
      ask_pause_(kFirstAskPause, ask_interval),
      refuse_pause_(kFirstRefusePause, kLongestRefusePause) {}

NodeBoot::Watch NodeBoot::watch() const noexcept {
  if (isIn<Running>()) return Watch::kWatch;
  const Release* const release = std::get_if<Release>(&phase_);
  const bool verify = isIn<Start>() || (release != nullptr && release->error_control);
  return verify ? Watch::kVerify : Watch::kOff;
}

void NodeBoot::reset(Instant now) noexcept {
  past_.reset_due = false;
  port_.cancel(SdoOwner::kBoot, now);
  command_ = resetCommand(config_.reset);
  report_.status().nmt = NmtState::kUnknown;  // it hears no RPDO any more, also before its boot-up says so
  phase_ = Phase{AwaitBootUp{}};
  timers_.set(NodeTimer::kBoot, now + config_.boot_up_timeout);
}

void NodeBoot::ask(Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  phase_ = Phase{Script{}};
  timers_.stop(NodeTimer::kBoot);
  script_.begin();
  submit(script_.request(), now);
}

void NodeBoot::submit(const SdoRequest& request, Instant now) noexcept {
  request_ = request;
  const bool question = setsLifeTime(request) || missesQuestions();
  guard_question_ = guard_question_ || (isIn<Script>() && !past_.fresh && question);
  port_.submit(SdoOwner::kBoot, request, now);
}

// Life guarding goes on in pre-operational and stopped (CiA 301 7.2.8.3.2), and a script may take longer than the life
// time. One that was reset waits for its first question, which would begin a life time: it gets none.
bool NodeBoot::missesQuestions() const noexcept {
  if (config_.error_control.mode != ErrorControlMode::kGuarding) return false;
  if (past_.repeats.started()) return true;
  const NmtState state = report_.status().nmt;
  const bool was_reset = state == NmtState::kUnknown || state == NmtState::kBootUp;
  return past_.was_operational && !was_reset;
}

void NodeBoot::handleBootUp(Instant now) noexcept {
  ++report_.status().counters.boot_ups;
  report_.status().nmt = NmtState::kBootUp;
  report_.status().booted_up_at = now;
  if (isIn<Off>()) return;
  endStopFirst(now);
  // It has forgotten whom it watched.
  if (isIn<Release>()) return endRelease(NmtCommand::kEnterPreOperational, now);
  if (isIn<Running>()) leave(restarted(), now);
  if (past_.boot_ups.handleBootUp(now)) {
    const Sentence why = restartsAgainAndAgain();
    if (report_.status().state != NodeState::kRefused) report_.tell(CanopenEventKind::kBootUpRepeated, why, 0, now);
    refuse_pause_.reset();
    return refuse(why, now);
  }
  past_.fresh = true;
  past_.repeats = ScriptRepeats{};
  past_.reset_due = false;
  refuse_pause_.reset();
  command_.reset();
  if (report_.status().state == NodeState::kRefused) report_.enter(NodeState::kBooting, {}, now);
  found(now);
  ask(now);
}

void NodeBoot::handleState(NmtState state, Instant now) noexcept {
  report_.status().nmt = state;
  if (Start* const started = std::get_if<Start>(&phase_)) {
    started->heard = true;
    if (state == NmtState::kOperational) run(now);
  } else if (isIn<Running>() && state != NmtState::kOperational) {
    leave(leftByItself(state), now);
    ask(now);
    leadBack();
  } else if (isIn<Silent>() || isIn<Script>()) {
    if (isIn<Silent>() && past_.cycles_to_tell == 0 && !report_.status().stops_first) ask(now);
    leadBack();
  }
}

void NodeBoot::handleForeignRequest() noexcept {
  if (Script* const script = std::get_if<Script>(&phase_)) script->ids.giveUp();
}

void NodeBoot::handleStrayAnswer(bool again, Instant now) noexcept {
  Script* const script = std::get_if<Script>(&phase_);
  if (script == nullptr || !script->ids.handleSurplus(again)) return;
  if (report_.status().state != NodeState::kRefused && !past_.doubled) {
    report_.tell(CanopenEventKind::kDoubleId, doubleId(), 0, now);
  }
  if (!past_.was_operational || past_.doubled) refuseBoth(now);
}

// What stops them they hear in operation only, and so they are left there for as long as that takes.
void NodeBoot::handleDoubleAnswers(Instant now) noexcept {
  if (!isIn<Running>() || past_.doubled) return;
  report_.tell(CanopenEventKind::kDoubleId, doubleId(), 0, now);
  past_.doubled = true;
  report_.status().doubled = true;
  report_.status().reason = doubleId();
  timers_.set(NodeTimer::kBoot, now + kStopBoth);
}

// Two nodes with one id take the same control words: they must not run. One that was in operation may turn, though, and
// hears a stop word in no other state.
void NodeBoot::refuseBoth(Instant now) noexcept {
  past_.was_operational = false;
  past_.doubled = false;
  refuse(doubleId(), now);
}

void NodeBoot::handleLoss(const Sentence& why, Instant now) noexcept {
  if (!isIn<Running>()) return;
  leave(why, now);
  report_.enter(NodeState::kLost, why, now);
  tellFirst(now);
}

// What it was told it does at once: its next RPDO would go nowhere. Error control tells a guard time later, or never.
void NodeBoot::handleForeignCommand(NmtCommand command, Instant now) noexcept {
  if (command == NmtCommand::kStart || isIn<Off>() || isIn<Release>()) return;
  report_.status().nmt = stateAfter(command);
  if (isIn<Running>()) {
    leave(toldByAnother(command), now);
    ask(now);
  }
  leadBack();
}

// A stopped node answers no SDO: without this it would be asked in vain for ever.
void NodeBoot::leadBack() noexcept {
  if (report_.status().nmt == NmtState::kStopped && !command_) command_ = NmtCommand::kEnterPreOperational;
}

// Stopped by somebody unheard, or before we came, it answers no SDO. Whom we never started is led back at once.
void NodeBoot::askAgain(Instant now) noexcept {
  if (isIn<Silent>() && isTold(now)) return timers_.set(NodeTimer::kBoot, now + kFirstAskPause);
  if (report_.status().stops_first) return begin(now);
  const bool take_back = isIn<Silent>() && now - past_.lost_at >= config_.only_asked;
  guard_question_ = isIn<Silent>() && config_.error_control.mode == ErrorControlMode::kGuarding;
  if (take_back) past_.lost_at = now;  // again after as long
  if (take_back && config_.reset != BootReset::kNone) return reset(now);
  ask(now);
  if (take_back) command_ = NmtCommand::kEnterPreOperational;
  leadBack();  // the command before may have been lost: nothing confirms it
}

void NodeBoot::poll(Instant now) noexcept {
  while (const std::optional<SdoAnswer> answer = port_.take(SdoOwner::kBoot)) handleAnswer(*answer, now);
  if (!timers_.isOver(NodeTimer::kBoot, now)) return;
  timers_.stop(NodeTimer::kBoot);
  handleDeadline(now);
}

void NodeBoot::handleDeadline(Instant now) noexcept {
  if (isIn<Release>()) return endRelease(NmtCommand::kEnterPreOperational, now);
  if (isIn<Running>()) report_.enter(NodeState::kBooting, doubleId(), now);
  Start* const started = std::get_if<Start>(&phase_);
  if (started == nullptr) return askAgain(now);
  if (!past_.repeats.forStart()) return diagnose(started->heard, now);
  past_.fresh = false;  // it may have been asked for its state, and toggled
  ask(now);
}

void NodeBoot::handleAnswer(const SdoAnswer& answer, Instant now) noexcept {
  NodeCounters& counters = report_.status().counters;
  Script* const script = std::get_if<Script>(&phase_);
  if (script != nullptr) script->ids.handleAnswer();
  if (isIn<Release>()) {
    release_script_.handle(answer);
    if (release_script_.done()) return endRelease(NmtCommand::kEnterPreOperational, now);
    return submit(release_script_.request(), now);
  }
  if (answer.end == SdoEnd::kTimedOut || answer.end == SdoEnd::kAbortedByUs) {
    ++counters.sdo_timeouts;
    ++report_.busCounters().sdo_timeouts;
    return handleNoAnswer(now);
  }
  if (!answer.ok()) {
    ++counters.sdo_aborts;
    ++report_.busCounters().sdo_aborts;
  }
  if (script != nullptr) return handleScriptAnswer(*script, answer, now);
  if (StartDiagnosis* const diagnose = std::get_if<StartDiagnosis>(&phase_)) handleDiagnosis(*diagnose, answer, now);
}

void NodeBoot::handleScriptAnswer(Script& script, const SdoAnswer& answer, Instant now) noexcept {
  if (!script.answered) {
    script.answered = true;
    if (past_.reset_due) return reset(now);
    found(now);
    // PDOs may be changed in this state only. A node that sent its boot-up is there by itself.
    if (!past_.fresh) command_ = NmtCommand::kEnterPreOperational;
  }
  switch (script_.handle(answer, report_.status())) {
    case Progress::kGoOn:
      script.tries_left = config_.sdo_retries;
      return submit(script_.request(), now);
    case Progress::kFailed:
      return refuse(script_.reason(), now);
    case Progress::kDone:
      if (script.ids.mixed() && !script.ids.found() && past_.repeats.forSurplus()) return ask(now);
      if (script.missed && past_.repeats.forMissed()) return ask(now);
      return start(script.ids.found(), now);
  }
}

void NodeBoot::handleDiagnosis(StartDiagnosis& diagnose, const SdoAnswer& answer, Instant now) noexcept {
  if (!diagnose.register_asked) {
    diagnose.register_asked = true;
    if (const auto value = numberOf(answer, 1)) diagnose.error_register = static_cast<std::uint8_t>(*value);
    return submit(sdoRead(0, kErrorFieldIndex, 1), now);
  }
  if (const auto value = numberOf(answer, 4)) diagnose.last_error = static_cast<std::uint16_t>(*value & 0xFFFFu);
  refuseStart(diagnose, now);
}

void NodeBoot::handleNoAnswer(Instant now) noexcept {
  if (const StartDiagnosis* const diagnose = std::get_if<StartDiagnosis>(&phase_)) return refuseStart(*diagnose, now);
  Script* const script = std::get_if<Script>(&phase_);
  if (script == nullptr) return;
  script->ids.giveUp();  // some may come late
  script->missed = script->answered;
  if (script->tries_left > 0) {
    --script->tries_left;
    return submit(request_, now);
  }
  silent(script->answered ? stoppedAnswering(request_) : doesNotAnswer(past_.lost_why), now);
}

void NodeBoot::found(Instant now) noexcept {
  past_.lost_why.clear();
  ask_pause_.reset();
  const NodeState state = report_.status().state;
  if (state == NodeState::kRefused) return;  // with its reason, until it gets further
  const bool was_there = state == NodeState::kBooting;
  report_.enter(NodeState::kBooting, {}, now);
  if (!was_there) report_.tell(CanopenEventKind::kNodeFound, Sentence{"answers"}, 0, now);
}

void NodeBoot::silent(const Sentence& why, Instant now) noexcept {
  report_.enter(past_.was_operational ? NodeState::kLost : NodeState::kAbsent, why, now);
  past_.fresh = false;
  past_.repeats = ScriptRepeats{};
  phase_ = Phase{Silent{}};
  timers_.set(NodeTimer::kBoot, now + ask_pause_.next());
}

void NodeBoot::start(bool doubled, Instant now) noexcept {
  past_.repeats.forgetSurplus();
  past_.doubled = doubled;
  command_ = NmtCommand::kStart;
  if (config_.error_control.mode == ErrorControlMode::kNone) return run(now);
  phase_ = Phase{Start{}};
  timers_.set(NodeTimer::kBoot, now + startTimeout(config_));
}

void NodeBoot::run(Instant now) noexcept {
  phase_ = Phase{Running{}};
  timers_.stop(NodeTimer::kBoot);
  past_.fresh = false;
  past_.repeats = ScriptRepeats{};
  past_.was_operational = true;
  refuse_pause_.reset();
  ++report_.status().counters.boots;
  report_.enter(NodeState::kOperational, past_.doubled ? doubleId() : Sentence{}, now);
  report_.status().doubled = past_.doubled;
  if (past_.doubled) timers_.set(NodeTimer::kBoot, now + kStopBoth);
  report_.tell(CanopenEventKind::kNodeOperational, Sentence{"is operational"}, 0, now);
}

void NodeBoot::leave(const Sentence& why, Instant now) noexcept {
  phase_ = Phase{Silent{}};
  past_.fresh = false;
  past_.repeats = ScriptRepeats{};
  ask_pause_.reset();
  past_.lost_why = why;
  past_.lost_at = now;
  ++report_.status().counters.losses;
  report_.enter(NodeState::kBooting, why, now);
  report_.tell(CanopenEventKind::kNodeLost, why, 0, now);
}

void NodeBoot::diagnose(bool heard, Instant now) noexcept {
  StartDiagnosis begun;
  begun.heard = heard;
  phase_ = Phase{begun};
  submit(sdoRead(0, kErrorRegisterIndex, 0), now);
}

void NodeBoot::refuseStart(const StartDiagnosis& diagnosis, Instant now) noexcept {
  refuse(startRefusal(diagnosis, report_.status().nmt, config_.error_control.mode), now);
}

void NodeBoot::refuse(const Sentence& why, Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  past_.fresh = false;  // somebody may have started it meanwhile, which may be why
  past_.repeats = ScriptRepeats{};
  ++report_.status().counters.refusals;
  const NodeStatus& status = report_.status();
  const bool told = status.state == NodeState::kRefused && std::strcmp(status.reason.c_str(), why.c_str()) == 0;
  report_.enter(NodeState::kRefused, why, now);
  if (!told) report_.tell(CanopenEventKind::kNodeRefused, why, 0, now);
  phase_ = Phase{Refused{}};
  timers_.set(NodeTimer::kBoot, now + refuse_pause_.next());
}

}  // namespace nord_driver::canopen
