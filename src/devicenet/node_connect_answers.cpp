// What a device's answers lead to, step by step.
#include <algorithm>
#include <cstring>

#include "devicenet/node_connect.h"

namespace nord_driver::devicenet {
namespace {

/// Of an explicit connection, unless the device says otherwise.
constexpr Duration kUsualExplicitRate = std::chrono::milliseconds{2500};
/// Without process data the questions are all that tells whether the device is there.
constexpr Duration kExplicitOnlyRate = std::chrono::seconds{1};
constexpr unsigned kMostDoublings = 10;
/// So often in a row a device is believed to have lost its explicit connection between the two allocations.
constexpr unsigned kMostLostExplicit = 3;

Sentence sentence(const char* what, const ExplicitAnswer& answer, std::uint8_t asked) noexcept {
  Sentence text;
  text.format("%s: %.200s", what, explicitText(answer, asked).c_str());
  return text;
}

}  // namespace

void NodeConnect::handleAllocated(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("does not answer", now);
  if (!answer.ok()) {
    held_ = 0;
    if (saysAllocated(answer) && conflicts_ == 0) return enter(Phase::kAskOwner, now);
    return refuse(sentence("does not let itself be allocated", answer, service::kAllocate), now);
  }
  if (answer.data.size() != 1 || answer.data[0] >= kKnownBodyFormats) {
    Sentence why;
    why.format("wants explicit messages of body format %u in %zu bytes; 0 to 3 in one byte is spoken here",
               answer.data.empty() ? 0u : unsigned{answer.data[0]}, answer.data.size());
    return refuse(why, now);
  }
  channel_.setFormat(static_cast<BodyFormat>(answer.data[0]));
  channel_.handleNewConnection(now);
  conflicts_ = 0;
  NodeStatus& status = report_.status();
  ++status.counters.allocations;
  status.owner.reset();
  status.heard_at = now;
  if (status.state == NodeState::kAbsent || status.state == NodeState::kLost) {
    report_.tell(DevicenetEventKind::kNodeFound, "answers", 0, now);
    report_.enter(NodeState::kConnecting, Sentence{}, now);
  }
  enter(Phase::kVendorId, now);
}

void NodeConnect::handleIdentity(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("does not tell its identity", now);
  NodeStatus& status = report_.status();
  if (phase_ == Phase::kRevision) {
    // Not every device has it.
    if (answer.ok() && answer.data.size() == 2) {
      status.major_revision = answer.data[0];
      status.minor_revision = answer.data[1];
    }
    return compareIdentity(now);
  }
  if (!answer.ok() || answer.data.size() != 2) {
    return refuse(sentence("does not tell its identity", answer, service::kGetAttributeSingle), now);
  }
  const auto value = static_cast<std::uint16_t>(*answer.number());
  switch (phase_) {
    case Phase::kVendorId:
      status.vendor_id = value;
      return enter(Phase::kDeviceType, now);
    case Phase::kDeviceType:
      status.device_type = value;
      return enter(Phase::kProductCode, now);
    default:
      status.product_code = value;
      return enter(Phase::kRevision, now);
  }
}

void NodeConnect::compareIdentity(Instant now) noexcept {
  const NodeStatus& status = report_.status();
  const bool same = config_.vendor_id.value_or(status.vendor_id) == status.vendor_id &&
                    config_.device_type.value_or(status.device_type) == status.device_type &&
                    config_.product_code.value_or(status.product_code) == status.product_code;
  if (same) return enter(Phase::kExplicitRate, now);
  Sentence why;
  why.format(
      "is another device than configured: vendor %u, device type %u, product code %u; expected vendor %u, device type "
      "%u, product code %u",
      unsigned{status.vendor_id}, unsigned{status.device_type}, unsigned{status.product_code},
      unsigned{config_.vendor_id.value_or(status.vendor_id)},
      unsigned{config_.device_type.value_or(status.device_type)},
      unsigned{config_.product_code.value_or(status.product_code)});
  refuse(why, now);
}

void NodeConnect::handleExplicitRate(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("does not tell the rate of its explicit connection", now);
  const std::uint32_t told = answer.number().value_or(0);
  report_.status().explicit_rate = told == 0 ? kUsualExplicitRate : Duration{std::chrono::milliseconds{told}};
  if (config_.io.kind == IoKind::kNone) return run(now);
  enter(Phase::kAllocateIo, now);
}

void NodeConnect::handleIoAllocated(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("gave no answer to the allocation of its process data", now);
  if (answer.ok()) {
    held_ |= io_choice_;
    of_before_ = {};
    outputs_instance_ = outputsInstance(config_.io);
    instance_ = outputs_instance_;
    return enter(Phase::kProducedSize, now);
  }
  // The explicit connection is ours: so is this one, from before.
  if (saysAllocated(answer) && conflicts_ == 0) {
    stale_ = io_choice_ & choice::kConnections;
    return askIoState(kFirstIoInstance, now);
  }
  // Without an explicit connection there is none for process data: it may have started anew in between.
  if (saysAllocated(answer) && lost_explicit_++ < kMostLostExplicit) {
    return fail(sentence("lost its explicit connection", answer, service::kAllocate), now);
  }
  Sentence what;
  what.format("does not exchange process data by %s", toText(config_.io.kind));
  refuseIo(sentence(what.c_str(), answer, service::kAllocate), now);
}

void NodeConnect::handleSize(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("does not tell the sizes of its process data", now);
  if (!answer.ok() || answer.data.size() != 2) {
    return refuseIo(sentence("does not tell the sizes of its process data", answer, service::kGetAttributeSingle), now);
  }
  const auto size = static_cast<std::uint16_t>(*answer.number());
  if (phase_ == Phase::kProducedSize) {
    produced_ = size;
    return enter(mayTakeBySecond(config_.io) ? Phase::kSecondState : Phase::kConsumedSize, now);
  }
  if (instance_ == outputs_instance_) {
    report_.status().produced_size = produced_;
    report_.status().consumed_size = size;
  }
  compareSizes(size, now);
}

// However it is refused: there is none, and then the first one must take the outputs, which its size tells.
void NodeConnect::handleSecondState(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) {
    return fail("does not tell whether it takes process data by connection object 2", now);
  }
  if (answer.ok() && answer.number().value_or(kNonexistent) != kNonexistent) outputs_instance_ = kConsumingInstance;
  instance_ = outputs_instance_;
  enter(Phase::kConsumedSize, now);
}

void NodeConnect::compareSizes(std::uint16_t consumed, Instant now) noexcept {
  const std::size_t expected = consumedSize(config_.io, instance_);
  const bool polled_beside = isPolledBesideStrobe(config_.io) && instance_ == outputs_instance_;
  if (produced_ == config_.io.input_bytes && consumed == expected) {
    // A connection runs from its rate on: the rates of both come last, one right after the other.
    instance_ = inputs_instance_;
    if (polled_beside) return enter(Phase::kProducedSize, now);
    report_.status().supervisors = {};
    return askSupervisor(1, now);
  }
  const bool by_second = mayTakeBySecond(config_.io) && outputs_instance_ != inputs_instance_;
  Sentence why;
  why.format("sends %u and takes %u bytes of process data by %s%s; %zu and %zu are configured", unsigned{produced_},
             unsigned{consumed}, toText(polled_beside ? IoKind::kPoll : config_.io.kind),
             by_second ? " (connection objects 4 and 2)" : "", config_.io.input_bytes, expected);
  refuseIo(why, now);
}

void NodeConnect::askSupervisor(std::uint8_t first, Instant now) noexcept {
  for (supervisor_ = first; supervisor_ <= kMostSupervisors; ++supervisor_) {
    if ((config_.asked_supervisors >> (supervisor_ - 1) & 1u) != 0) return enter(Phase::kSupervisor, now);
  }
  enter(Phase::kWriteRate, now);
}

// Who does not tell it is connected all the same.
void NodeConnect::handleSupervisor(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.ok() && !answer.data.empty()) report_.status().supervisors[supervisor_ - 1u] = answer.data[0];
  askSupervisor(static_cast<std::uint8_t>(supervisor_ + 1), now);
}

void NodeConnect::handleRate(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return fail("gave no answer to its expected packet rate", now);
  if (answer.ok() && answer.data.empty() && phase_ == Phase::kWriteRate) return enter(Phase::kReadRate, now);
  if (!answer.ok() || answer.data.size() != 2) {
    return refuseIo(sentence("does not take its expected packet rate", answer, service::kSetAttributeSingle), now);
  }
  useRate(std::chrono::milliseconds{*answer.number()}, now);
}

void NodeConnect::useRate(Duration rate, Instant now) noexcept {
  rate_ = rate;
  report_.status().packet_rate = rate;
  Sentence why;
  if (rate == Duration::zero()) {
    why = "answers an expected packet rate of 0: it would never notice that we are gone";
  } else if (kRatesUntilTimeout * rate < 2 * bus_.cycle_time) {
    why.format(
        "answers an expected packet rate of %.0f ms: it gives up after four times that, less than two of our "
        "cycles of %.1f ms",
        toSeconds(rate) * 1e3, toSeconds(bus_.cycle_time) * 1e3);
  } else if (rate > *config_.io.expected_packet_rate + kCoarsestStep) {
    why.format(
        "answers an expected packet rate of %.0f ms where %.0f ms was asked for: it would stop only %.0f ms after "
        "we are gone",
        toSeconds(rate) * 1e3, toSeconds(*config_.io.expected_packet_rate) * 1e3,
        toSeconds(kRatesUntilTimeout * rate) * 1e3);
  } else if (instance_ != outputs_instance_) {
    instance_ = outputs_instance_;
    return enter(Phase::kWriteRate, now);
  } else {
    return run(now);
  }
  refuseIo(why, now);
}

void NodeConnect::run(Instant now) noexcept {
  phase_ = Phase::kRunning;
  channel_.open();
  failures_ = 0;
  lost_explicit_ = 0;
  ++report_.status().counters.connections;
  report_.enter(NodeState::kExchanging, Sentence{}, now);
  Sentence text;
  if (config_.io.kind == IoKind::kNone) {
    text = "is connected for explicit messages";
  } else {
    text.format("exchanges process data by %s, expected packet rate %.0f ms", toText(config_.io.kind),
                toSeconds(rate_) * 1e3);
  }
  report_.tell(DevicenetEventKind::kNodeExchanging, text, 0, now);
  armKeepAlive(now);
}

void NodeConnect::armKeepAlive(Instant now) noexcept {
  Duration span = report_.status().explicit_rate;
  if (config_.io.kind == IoKind::kNone) span = std::min(span, kExplicitOnlyRate);
  timers_.set(Timer::kKeepAlive, std::max(now, channel_.usedAt() + span));
}

void NodeConnect::pollKeepAlive(Instant now) noexcept {
  if (!timers_.takeDue(Timer::kKeepAlive, now) || phase_ != Phase::kRunning) return;
  const Duration idle = now - channel_.usedAt();
  if (idle < std::min(report_.status().explicit_rate, kExplicitOnlyRate)) return armKeepAlive(now);
  ++report_.status().counters.keep_alives;
  enter(Phase::kKeepAlive, now);
}

void NodeConnect::checkSoon(Instant now) noexcept {
  if (phase_ != Phase::kRunning) return;
  timers_.stop(Timer::kKeepAlive);
  enter(Phase::kKeepAlive, now);
}

void NodeConnect::handleState(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.end == ExplicitEnd::kTimedOut) return enter(Phase::kReopen, now);
  const char* const lost = lostStateText(answer);
  // One that may be another request's lets go of nothing: it is asked again, and process data have a time-out of their own.
  if (lost != nullptr && !answer.may_be_late) {
    Sentence why;
    why.format("says that its connection for %s is %s", toText(config_.io.kind), lost);
    return handleLoss(why, now);
  }
  phase_ = Phase::kRunning;
  armKeepAlive(now);
}

// The explicit connection can be gone while process data are exchanged: those have a time-out of their own.
void NodeConnect::handleReopened(const ExplicitAnswer& answer, Instant now) noexcept {
  const bool there = answer.ok() || saysAllocated(answer);
  if (!there && !answer.may_be_late && config_.io.kind == IoKind::kNone) return handleLoss("does not answer", now);
  if (answer.ok()) {
    ++report_.status().counters.reopened;
    channel_.handleNewConnection(now);
  }
  phase_ = Phase::kRunning;
  timers_.set(Timer::kKeepAlive, now + report_.status().explicit_rate);
}

void NodeConnect::handleLoss(const Sentence& why, Instant now, Loss loss) noexcept {
  if (!exchanging()) return;
  ++report_.status().counters.losses;
  report_.enter(NodeState::kLost, why, now);
  report_.tell(DevicenetEventKind::kNodeLost, why, 0, now);
  failures_ = 0;
  if (loss == Loss::kTold) return letGo(now);
  // It may hear us all the same. Released it would be watched by nobody, with the last words it has heard: its own
  // time-out comes first.
  timers_.stopAll();
  channel_.close();
  phase_ = Phase::kLastOutputs;
  if (loss == Loss::kSilent) endOutputs(now);
}

void NodeConnect::endOutputs(Instant now) noexcept {
  if (phase_ != Phase::kLastOutputs) return;
  awaitOwnTimeOut(now);
  pause(own_time_out_ - now, now, Phase::kAwaitOwnTimeOut);
}

// Our last output may have gone out just now, or wait in the link yet, and the device counts in steps of its own: released
// in the moment in which its time-out is due by our clock, it may go on without one.
void NodeConnect::awaitOwnTimeOut(Instant now) noexcept {
  own_time_out_ = now + kRatesUntilTimeout * rate_ + kCoarsestStep;
}

Duration NodeConnect::retryPause() const noexcept {
  const unsigned doublings = std::min(failures_ - 1, kMostDoublings);
  return std::min(bus_.longest_retry, bus_.first_retry * (1 << doublings));
}

void NodeConnect::pause(Duration span, Instant now, Phase phase) noexcept {
  phase_ = phase;
  timers_.set(Timer::kRetry, now + span);
}

void NodeConnect::fail(const Sentence& why, Instant now) noexcept {
  const NodeState state = report_.status().state;
  ++failures_;
  report_.enter(state == NodeState::kAbsent ? state : NodeState::kLost, why, now);
  if (explicitHeld()) return letGo(now);
  // What was asked for last may have been done, and nobody has said so. The next try asks whose it is then: released unasked,
  // it may be another master's by now.
  held_ = 0;
  pause(retryPause(), now);
}

void NodeConnect::tellRefused(const Sentence& why, Instant now) noexcept {
  NodeStatus& status = report_.status();
  const bool known = status.state == NodeState::kRefused && std::strcmp(status.reason.c_str(), why.c_str()) == 0;
  ++status.counters.refusals;
  report_.enter(NodeState::kRefused, why, now);
  if (!known) report_.tell(DevicenetEventKind::kNodeRefused, why, 0, now);
}

void NodeConnect::refuse(const Sentence& why, Instant now) noexcept {
  tellRefused(why, now);
  ++failures_;
  if (explicitHeld()) return letGo(now);
  pause(bus_.longest_retry, now);
}

void NodeConnect::refuseIo(const Sentence& why, Instant now) noexcept {
  tellRefused(why, now);
  channel_.open();
  if ((held_ & io_choice_ & choice::kConnections) != 0) return enter(Phase::kReleaseIo, now);
  phase_ = Phase::kRefusedPause;
  timers_.set(Timer::kRetry, now + bus_.longest_retry);
}

void NodeConnect::handleLetGo(const ExplicitAnswer& answer, Instant now) noexcept {
  held_ = 0;
  if (answer.end == ExplicitEnd::kTimedOut) {
    ++failures_;
    return pause(retryPause(), now);
  }
  // It is there. After a loss there is nothing to wait for.
  if (failures_ == 0 || let_go_first_) return beginTry(now);
  pause(pauseAfterRelease(), now);
}

}  // namespace nord_driver::devicenet
