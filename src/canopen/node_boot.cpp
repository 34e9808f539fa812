#include "canopen/node_boot.h"

#include <algorithm>
#include <cstring>

#include "canopen/error_control_objects.h"

namespace nord_driver::canopen {
namespace {

constexpr Duration kFirstAskPause = std::chrono::milliseconds{100};
constexpr Duration kFirstRefusePause = std::chrono::seconds{1};
constexpr Duration kLongestRefusePause = std::chrono::seconds{4};
/// Boot-ups closer together than this belong together; more than so many of them are no start any more.
constexpr Duration kBootUpsBelongTogether = std::chrono::seconds{2};
constexpr std::uint32_t kMostBootUps = 3;

/// A frame may be received twice (ISO 11898-1: an error in its last bit but one), but not most of the answers.
constexpr std::uint32_t kSurplusOfTwoNodes = 4;

/// Two nodes with one id get stop words for so long.
constexpr Duration kStopBoth = std::chrono::seconds{4};

/// Bounds the end of a driver whose node does not answer.
constexpr Duration kLongestRelease = std::chrono::seconds{1};

constexpr std::uint16_t kErrorRegisterIndex = 0x1001;
constexpr std::uint16_t kErrorFieldIndex = 0x1003;

Sentence doubleId() noexcept {
  return Sentence{"two nodes answer with this id: is it set twice, by switches or P515?"};
}

NmtCommand resetCommand(BootReset reset) noexcept {
  return reset == BootReset::kResetNode ? NmtCommand::kResetNode : NmtCommand::kResetCommunication;
}

Duration startTimeout(const NodeConfig& config) noexcept {
  const Duration period = config.error_control.mode == ErrorControlMode::kHeartbeat
                              ? config.error_control.heartbeat_timeout
                              : config.error_control.guard_time * 2;
  return std::max(config.start_timeout, period);
}

}  // namespace

NodeBoot::NodeBoot(const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, NodeReport& report,
                   SdoPort& port) noexcept
    : config_(config),
      ask_interval_(ask_interval),
      report_(report),
      port_(port),
      script_(config, own_id),
      release_script_(config.error_control) {}

void NodeBoot::restart(Instant now) noexcept {
  report_.enter(NodeState::kAbsent, {}, now);
  report_.status().nmt = NmtState::kUnknown;
  command_.reset();
  fresh_ = false;
  was_operational_ = false;
  doubled_ = false;
  lost_why_.clear();
  boot_ups_in_a_row_ = 0;
  last_boot_up_.reset();
  ask_pause_ = kFirstAskPause;
  refuse_pause_ = kFirstRefusePause;
  reset_due_ = config_.reset != BootReset::kNone;
  if (reset_due_) {
    reset(now);
  } else {
    ask(now);
  }
}

void NodeBoot::release(Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  const bool ever_there = report_.status().state != NodeState::kAbsent;
  report_.enter(NodeState::kReleased, {}, now);
  if (config_.reset != BootReset::kNone) return endRelease(NmtCommand::kResetCommunication, now);
  guards_ = watch() != Watch::kOff;
  release_script_.begin();
  if (!ever_there || release_script_.done()) return endRelease(NmtCommand::kEnterPreOperational, now);
  phase_ = Phase::kRelease;
  command_.reset();
  deadline_ = now + kLongestRelease;
  submit(release_script_.request(), now);
}

void NodeBoot::endRelease(NmtCommand command, Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  phase_ = Phase::kOff;
  deadline_.reset();
  command_ = command;
}

NodeBoot::Watch NodeBoot::watch() const noexcept {
  if (phase_ == Phase::kStart || (phase_ == Phase::kRelease && guards_)) return Watch::kVerify;
  return phase_ == Phase::kRunning ? Watch::kWatch : Watch::kOff;
}

void NodeBoot::reset(Instant now) noexcept {
  reset_due_ = false;
  port_.cancel(SdoOwner::kBoot, now);
  command_ = resetCommand(config_.reset);
  report_.status().nmt = NmtState::kUnknown;  // it hears no RPDO any more, also before its boot-up says so
  phase_ = Phase::kAwaitBootUp;
  deadline_ = now + config_.boot_up_timeout;
}

void NodeBoot::ask(Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  phase_ = Phase::kScript;
  deadline_.reset();
  answered_ = false;
  answers_are_ours_ = true;
  answers_ = 0;
  surplus_answers_ = 0;
  two_answer_ = false;
  script_.begin();
  tries_left_ = 0;
  submit(script_.request(), now);
}

void NodeBoot::submit(const SdoRequest& request, Instant now) noexcept {
  request_ = request;
  guard_question_ = guard_question_ || (phase_ == Phase::kScript && !fresh_ && setsLifeTime(request));
  port_.submit(SdoOwner::kBoot, request, now);
}

void NodeBoot::handleBootUp(Instant now) noexcept {
  ++report_.status().counters.boot_ups;
  report_.status().nmt = NmtState::kBootUp;
  report_.status().booted_up_at = now;
  if (phase_ == Phase::kOff) return;
  // It has forgotten whom it watched.
  if (phase_ == Phase::kRelease) return endRelease(NmtCommand::kEnterPreOperational, now);
  Sentence why;
  if (phase_ == Phase::kRunning) {
    why.format("has restarted by itself: it sent its boot-up");
    leave(why, now);
  }
  if (repeated(now)) {
    why.format(
        "sends its boot-up again and again: two nodes with this id, or a heartbeat that says 0, or a supply that "
        "breaks down");
    if (report_.status().state != NodeState::kRefused) report_.tell(CanopenEventKind::kBootUpRepeated, why, 0, now);
    refuse_pause_ = kFirstRefusePause;
    return refuse(why, now);
  }
  fresh_ = true;
  reset_due_ = false;
  refuse_pause_ = kFirstRefusePause;
  command_.reset();
  if (report_.status().state == NodeState::kRefused) report_.enter(NodeState::kBooting, {}, now);
  found(now);
  ask(now);
}

bool NodeBoot::repeated(Instant now) noexcept {
  const bool together = last_boot_up_ && now - *last_boot_up_ < kBootUpsBelongTogether;
  boot_ups_in_a_row_ = together ? boot_ups_in_a_row_ + 1 : 1;
  last_boot_up_ = now;
  return boot_ups_in_a_row_ > kMostBootUps;
}

void NodeBoot::handleState(NmtState state, Instant now) noexcept {
  report_.status().nmt = state;
  if (phase_ == Phase::kStart) {
    heard_ = true;
    if (state == NmtState::kOperational) run(now);
  } else if (phase_ == Phase::kRunning && state != NmtState::kOperational) {
    Sentence why;
    why.format("is %s now, which we did not tell it", toText(state));
    leave(why, now);
    ask(now);
    leadBack();
  } else if (phase_ == Phase::kSilent) {
    ask(now);
    leadBack();
  }
}

void NodeBoot::handleStrayAnswer(Instant now) noexcept {
  if (phase_ != Phase::kScript || !answers_are_ours_ || two_answer_) return;
  ++surplus_answers_;
  if (surplus_answers_ < kSurplusOfTwoNodes || 2 * surplus_answers_ < answers_) return;
  two_answer_ = true;
  if (report_.status().state != NodeState::kRefused && !doubled_) {
    report_.tell(CanopenEventKind::kDoubleId, doubleId(), 0, now);
  }
  if (!was_operational_ || doubled_) refuseBoth(now);
}

// Two nodes with one id take the same control words: they must not run. One that was in operation may turn, though, and
// hears a stop word in no other state.
void NodeBoot::refuseBoth(Instant now) noexcept {
  was_operational_ = false;
  doubled_ = false;
  refuse(doubleId(), now);
}

void NodeBoot::handleLoss(const Sentence& why, Instant now) noexcept {
  if (phase_ != Phase::kRunning) return;
  leave(why, now);
  report_.enter(NodeState::kLost, why, now);
  reset_due_ = config_.reset != BootReset::kNone;
  ask(now);
}

// What it was told it does at once: its next RPDO would go nowhere. Error control tells a guard time later, or never.
void NodeBoot::handleForeignCommand(NmtCommand command, Instant now) noexcept {
  if (command == NmtCommand::kStart || phase_ == Phase::kOff || phase_ == Phase::kRelease) return;
  report_.status().nmt = stateAfter(command);
  if (phase_ == Phase::kRunning) {
    Sentence why;
    why.format("was told \"%s\" by another master", toText(command));
    leave(why, now);
    ask(now);
  }
  leadBack();
}

// A stopped node answers no SDO: without this it would be asked in vain for ever.
void NodeBoot::leadBack() noexcept {
  if (report_.status().nmt == NmtState::kStopped && !command_) command_ = NmtCommand::kEnterPreOperational;
}

void NodeBoot::poll(Instant now) noexcept {
  while (const std::optional<SdoAnswer> answer = port_.take(SdoOwner::kBoot)) handleAnswer(*answer, now);
  if (!deadline_ || now < *deadline_) return;
  deadline_.reset();
  handleDeadline(now);
}

void NodeBoot::handleDeadline(Instant now) noexcept {
  if (phase_ == Phase::kRelease) return endRelease(NmtCommand::kEnterPreOperational, now);
  if (phase_ == Phase::kRunning) report_.enter(NodeState::kBooting, doubleId(), now);
  if (phase_ != Phase::kStart) return ask(now);
  if (tries_left_ == 0) return diagnose(now);
  --tries_left_;
  command_ = NmtCommand::kStart;
  deadline_ = now + startTimeout(config_);
}

void NodeBoot::handleAnswer(const SdoAnswer& answer, Instant now) noexcept {
  NodeCounters& counters = report_.status().counters;
  ++answers_;
  if (phase_ == Phase::kRelease) {
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
  if (phase_ == Phase::kScript) return handleScriptAnswer(answer, now);
  if (phase_ == Phase::kReadErrorRegister) {
    if (const auto value = numberOf(answer, 1)) error_register_ = static_cast<std::uint8_t>(*value);
    phase_ = Phase::kReadErrorField;
    return submit(sdoRead(0, kErrorFieldIndex, 1), now);
  }
  if (const auto value = numberOf(answer, 4)) last_error_ = static_cast<std::uint16_t>(*value & 0xFFFFu);
  refuseStart(now);
}

void NodeBoot::handleScriptAnswer(const SdoAnswer& answer, Instant now) noexcept {
  if (!answered_) {
    answered_ = true;
    if (reset_due_) return reset(now);
    found(now);
    // PDOs may be changed in this state only. A node that sent its boot-up is there by itself.
    if (!fresh_) command_ = NmtCommand::kEnterPreOperational;
  }
  switch (script_.handle(answer, report_.status())) {
    case Progress::kGoOn:
      tries_left_ = config_.sdo_retries;
      return submit(script_.request(), now);
    case Progress::kFailed:
      return refuse(script_.reason(), now);
    case Progress::kDone:
      return start(now);
  }
}

void NodeBoot::handleNoAnswer(Instant now) noexcept {
  answers_are_ours_ = false;  // some may come late
  if (phase_ == Phase::kReadErrorRegister || phase_ == Phase::kReadErrorField) return refuseStart(now);
  if (tries_left_ > 0) {
    --tries_left_;
    return submit(request_, now);
  }
  Sentence why;
  if (answered_) {
    why.format("stopped answering in its start-up (SDO %04Xh:%u)", unsigned{request_.index},
               unsigned{request_.sub_index});
  } else if (!lost_why_.empty()) {
    why.format("%s; since then it does not answer: is it powered and connected?", lost_why_.c_str());
  } else {
    why.format("does not answer: is it powered, and are its node id and bit rate right?");
  }
  silent(why, now);
}

void NodeBoot::found(Instant now) noexcept {
  lost_why_.clear();
  ask_pause_ = kFirstAskPause;
  const NodeState state = report_.status().state;
  if (state == NodeState::kRefused) return;  // with its reason, until it gets further
  const bool was_there = state == NodeState::kBooting;
  report_.enter(NodeState::kBooting, {}, now);
  if (!was_there) report_.tell(CanopenEventKind::kNodeFound, Sentence{"answers"}, 0, now);
}

void NodeBoot::silent(const Sentence& why, Instant now) noexcept {
  report_.enter(was_operational_ ? NodeState::kLost : NodeState::kAbsent, why, now);
  fresh_ = false;
  phase_ = Phase::kSilent;
  deadline_ = now + ask_pause_;
  ask_pause_ = std::min(ask_pause_ * 2, ask_interval_);
}

void NodeBoot::start(Instant now) noexcept {
  doubled_ = two_answer_;
  command_ = NmtCommand::kStart;
  heard_ = false;
  if (config_.error_control.mode == ErrorControlMode::kNone) return run(now);
  phase_ = Phase::kStart;
  tries_left_ = 1;
  deadline_ = now + startTimeout(config_);
}

void NodeBoot::run(Instant now) noexcept {
  phase_ = Phase::kRunning;
  deadline_.reset();
  fresh_ = false;
  was_operational_ = true;
  refuse_pause_ = kFirstRefusePause;
  ++report_.status().counters.boots;
  report_.enter(NodeState::kOperational, doubled_ ? doubleId() : Sentence{}, now);
  report_.status().doubled = doubled_;
  if (doubled_) deadline_ = now + kStopBoth;
  report_.tell(CanopenEventKind::kNodeOperational, Sentence{"is operational"}, 0, now);
}

void NodeBoot::leave(const Sentence& why, Instant now) noexcept {
  phase_ = Phase::kSilent;
  fresh_ = false;
  ask_pause_ = kFirstAskPause;
  lost_why_ = why;
  ++report_.status().counters.losses;
  report_.enter(NodeState::kBooting, why, now);
  report_.tell(CanopenEventKind::kNodeLost, why, 0, now);
}

void NodeBoot::diagnose(Instant now) noexcept {
  phase_ = Phase::kReadErrorRegister;
  error_register_.reset();
  last_error_.reset();
  submit(sdoRead(0, kErrorRegisterIndex, 0), now);
}

void NodeBoot::refuseStart(Instant now) noexcept {
  Sentence why;
  if (heard_) {
    why.format("does not become operational after NMT start: it stays %s", toText(report_.status().nmt));
  } else {
    why.format("was started, but is not heard by %s",
               config_.error_control.mode == ErrorControlMode::kHeartbeat ? "heartbeat" : "guarding");
  }
  if (error_register_) {
    const Sentence state = why;
    why.format("%s, error register %02Xh", state.c_str(), unsigned{*error_register_});
  }
  if (last_error_) {
    const Sentence state = why;
    why.format("%s, last error %04Xh", state.c_str(), unsigned{*last_error_});
  }
  refuse(why, now);
}

void NodeBoot::refuse(const Sentence& why, Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  ++report_.status().counters.refusals;
  const NodeStatus& status = report_.status();
  const bool told = status.state == NodeState::kRefused && std::strcmp(status.reason.c_str(), why.c_str()) == 0;
  report_.enter(NodeState::kRefused, why, now);
  if (!told) report_.tell(CanopenEventKind::kNodeRefused, why, 0, now);
  phase_ = Phase::kRefused;
  deadline_ = now + refuse_pause_;
  refuse_pause_ = std::min(refuse_pause_ * 2, kLongestRefusePause);
}

}  // namespace nord_driver::canopen
