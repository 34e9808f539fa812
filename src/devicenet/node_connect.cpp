#include "devicenet/node_connect.h"

#include "devicenet/error_codes.h"

namespace nord_driver::devicenet {

NodeConnect::NodeConnect(const NodeConfig& config, const ScannerConfig& bus, NodeReport& report,
                         ExplicitChannel& channel) noexcept
    : config_(config),
      bus_(bus),
      report_(report),
      channel_(channel),
      io_choice_(ioChoice(config.io)),
      inputs_instance_(connectionInstance(config.io.kind)),
      outputs_instance_(outputsInstance(config.io)),
      instance_(outputs_instance_) {}

void NodeConnect::start(Instant now) noexcept {
  failures_ = 0;
  of_before_ = {};
  foreign_mac_.reset();
  channel_.close();
  timers_.stopAll();
  report_.status().owner.reset();
  // The try begins with a release of what is ours from before.
  if (now < own_time_out_) return awaitOwnTimeOutOfBefore(now);
  report_.enter(NodeState::kAbsent, Sentence{}, now);
  beginTry(now);
}

void NodeConnect::beginTry(Instant now) noexcept {
  let_go_first_ = false;
  held_ = 0;
  conflicts_ = 0;
  enter(Phase::kAllocateExplicit, now);
}

void NodeConnect::stop(const Sentence& why, Instant now) noexcept {
  const bool was_exchanging = exchanging(), outputs_went = sendsOutputs();
  const NodeState state = report_.status().state;
  held_ = 0;
  channel_.silence();
  timers_.stopAll();
  phase_ = Phase::kOff;
  if (outputs_went) awaitOwnTimeOut(now);
  // Who has no words that stop a motor leaves it to what a driver that was killed has told its device.
  if (config_.io.kind == IoKind::kNone) own_time_out_ = now + longestOwnTimeOut(*config_.io.expected_packet_rate);
  if (was_exchanging) {
    ++report_.status().counters.losses;
    report_.tell(DevicenetEventKind::kNodeLost, why, 0, now);
  }
  report_.enter(state == NodeState::kAbsent ? state : NodeState::kLost, why, now);
}

void NodeConnect::release(Instant now) noexcept {
  channel_.close();
  timers_.stopAll();
  report_.enter(NodeState::kReleased, Sentence{}, now);
  // One that may still run on our last words stops by its own time-out, which a release would take away.
  const bool may_run = phase_ == Phase::kAwaitOwnTimeOut || phase_ == Phase::kLastOutputs;
  if (held_ == 0 || phase_ == Phase::kOff || may_run || isPolledByAnother(now)) {
    channel_.cancelOwn();
    phase_ = Phase::kReleased;
  } else {
    enter(Phase::kReleasing, now);
  }
}

void NodeConnect::handleSign(Instant now) noexcept {
  if (phase_ == Phase::kPause && report_.status().state != NodeState::kRefused) timers_.set(Timer::kRetry, now);
}

void NodeConnect::enter(Phase phase, Instant now) noexcept {
  phase_ = phase;
  if (phase == Phase::kAllocateExplicit) held_ |= choice::kExplicit;
  const std::optional<ConnectRequest> asked = requestOf(phase);
  if (asked) channel_.ask(asked->request, asked->port, config_.connect_timeout, now);
}

std::optional<ConnectRequest> NodeConnect::requestOf(Phase phase) const noexcept {
  switch (phase) {
    case Phase::kAllocateExplicit:
    case Phase::kReopen:
      return allocateRequest(choice::kExplicit, bus_.mac);
    case Phase::kAskOwner:
      return ownerRequest(ExplicitPort::kUnconnected);
    case Phase::kAskOwnerConnected:
      return ownerRequest(ExplicitPort::kConnected);
    case Phase::kReleaseStale:
    case Phase::kReleaseStaleIo:
      return releaseRequest(stale_);
    case Phase::kVendorId:
      return identityRequest(identity_attribute::kVendorId);
    case Phase::kDeviceType:
      return identityRequest(identity_attribute::kDeviceType);
    case Phase::kProductCode:
      return identityRequest(identity_attribute::kProductCode);
    case Phase::kRevision:
      return identityRequest(identity_attribute::kRevision);
    case Phase::kExplicitRate:
      return connectionRequest(kExplicitInstance, connection_attribute::kExpectedPacketRate);
    case Phase::kAllocateIo:
      return allocateRequest(io_choice_, bus_.mac);
    case Phase::kReleaseIo:
      return releaseRequest(io_choice_ & choice::kConnections);
    case Phase::kProducedSize:
      return connectionRequest(instance_, connection_attribute::kProducedSize);
    case Phase::kSecondState:
      return connectionRequest(kConsumingInstance, connection_attribute::kState);
    case Phase::kConsumedSize:
      return connectionRequest(instance_, connection_attribute::kConsumedSize);
    case Phase::kSupervisor:
      return supervisorRequest(supervisor_);
    case Phase::kWriteRate:
      return rateRequest(instance_,
                         static_cast<std::uint16_t>(*config_.io.expected_packet_rate / std::chrono::milliseconds{1}));
    case Phase::kShortenIoRate:
      return rateRequest(instance_, kShortRateOfBefore);
    case Phase::kReadRate:
    case Phase::kIoRate:
      return connectionRequest(instance_, connection_attribute::kExpectedPacketRate);
    case Phase::kKeepAlive:
    case Phase::kIoState:
      return connectionRequest(instance_, connection_attribute::kState);
    case Phase::kReleaseAll:
    case Phase::kReleasing:
      return releaseRequest(held_ & choice::kConnections);
    case Phase::kOff:
    case Phase::kPause:
    case Phase::kLastOutputs:
    case Phase::kAwaitOwnTimeOut:
    case Phase::kAwaitIoOfBefore:
    case Phase::kRunning:
    case Phase::kRefusedPause:
    case Phase::kReleased:
      break;
  }
  return std::nullopt;
}

void NodeConnect::poll(Instant now) noexcept {
  if (timers_.takeDue(Timer::kRetry, now)) {
    if (phase_ == Phase::kRefusedPause) {
      // Another one may stand there by now, or the explicit connection may be gone.
      channel_.close();
      conflicts_ = 0;
      enter(Phase::kVendorId, now);
    } else if (phase_ == Phase::kAwaitIoOfBefore) {
      askIoState(kFirstIoInstance, now);
    } else if (held_ != 0 && !isPolledByAnother(now)) {
      // It was held when it fell silent, or was allocated in a way that is not spoken here.
      let_go_first_ = true;
      letGo(now);
    } else {
      beginTry(now);
    }
  }
  pollKeepAlive(now);
  while (const auto answer = channel_.takeOwnAnswer()) handleAnswer(*answer, now);
}

void NodeConnect::handleAnswer(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) ++report_.busCounters().request_timeouts;
  if (answer.end == ExplicitEnd::kRefused) ++report_.busCounters().request_errors;
  switch (phase_) {
    case Phase::kAllocateExplicit:
      return handleAllocated(answer, now);
    case Phase::kAskOwner:
    case Phase::kAskOwnerConnected:
      return handleOwner(answer, now);
    case Phase::kIoState:
      return handleIoState(answer, now);
    case Phase::kIoRate:
      return handleIoRate(answer, now);
    case Phase::kShortenIoRate:
      ofBefore().written = answer.end != ExplicitEnd::kTimedOut;
      return enter(Phase::kIoRate, now);  // whatever has come of it
    case Phase::kReleaseStale:
      if (answer.end == ExplicitEnd::kTimedOut) return fail("gave no answer to a release", now);
      if (answer.end == ExplicitEnd::kRefused && answer.additional == allocate_error::kConflict) {
        return refuse("is allocated to another master and does not tell to which", now);
      }
      held_ = 0;
      ++conflicts_;
      return enter(Phase::kAllocateExplicit, now);
    case Phase::kVendorId:
    case Phase::kDeviceType:
    case Phase::kProductCode:
    case Phase::kRevision:
      return handleIdentity(answer, now);
    case Phase::kExplicitRate:
      return handleExplicitRate(answer, now);
    case Phase::kAllocateIo:
      return handleIoAllocated(answer, now);
    case Phase::kReleaseStaleIo:
      if (answer.end == ExplicitEnd::kTimedOut) return fail("gave no answer to a release", now);
      ++conflicts_;
      return enter(Phase::kAllocateIo, now);
    case Phase::kProducedSize:
    case Phase::kConsumedSize:
      return handleSize(answer, now);
    case Phase::kSecondState:
      return handleSecondState(answer, now);
    case Phase::kSupervisor:
      return handleSupervisor(answer, now);
    case Phase::kWriteRate:
    case Phase::kReadRate:
      return handleRate(answer, now);
    case Phase::kKeepAlive:
      return handleState(answer, now);
    case Phase::kReopen:
      return handleReopened(answer, now);
    case Phase::kReleaseIo:
      held_ = static_cast<std::uint8_t>(held_ & ~io_choice_);
      phase_ = Phase::kRefusedPause;
      return timers_.set(Timer::kRetry, now + bus_.longest_retry);
    case Phase::kReleaseAll:
      return handleLetGo(answer, now);
    case Phase::kReleasing:
      held_ = 0;
      phase_ = Phase::kReleased;
      return;
    case Phase::kOff:
    case Phase::kPause:
    case Phase::kLastOutputs:
    case Phase::kAwaitOwnTimeOut:
    case Phase::kAwaitIoOfBefore:
    case Phase::kRunning:
    case Phase::kRefusedPause:
    case Phase::kReleased:
      return;
  }
}

}  // namespace nord_driver::devicenet
