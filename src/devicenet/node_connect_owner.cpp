// Whose a device is, and what of before is let go.
#include "devicenet/error_codes.h"
#include "devicenet/node_connect.h"

namespace nord_driver::devicenet {
namespace {

/// The master's MAC id of a device that has none.
constexpr std::uint8_t kNobody = 0xFF;
/// So long after a frame of another master the device is taken to be its.
constexpr Duration kForeignMemory = std::chrono::seconds{5};
/// Of a short rate, where nobody answers.
constexpr int kMostWritings = 3;
/// ms: of one that does not tell it.
constexpr std::uint32_t kLongestPacketRate = 0xFFFF;

}  // namespace

// It is not known to run: who waits for it is told why.
void NodeConnect::awaitOwnTimeOutOfBefore(Instant now) noexcept {
  report_.enter(
      NodeState::kAbsent,
      "is asked for nothing before its own time-out must have run out: whoever had it before may have left its "
      "motor turning",
      now);
  pause(own_time_out_ - now, now, Phase::kAwaitOwnTimeOut);
}

void NodeConnect::handleForeignMaster(std::uint8_t mac, Instant now) noexcept {
  foreign_mac_ = mac;
  foreign_at_ = now;
}

void NodeConnect::handleForeignIo(Instant now) noexcept {
  polled_at_ = now;
  stopReleasing(now);
}

void NodeConnect::handleForeignGrant(Instant now) noexcept {
  held_ = 0;
  if (asksForIoOfBefore()) return leave(now);
  stopReleasing(now);
}

bool NodeConnect::isPolledByAnother(Instant now) const noexcept {
  return polled_at_ && now - *polled_at_ < kForeignMemory;
}

void NodeConnect::stopReleasing(Instant now) noexcept {
  const bool unknown = phase_ == Phase::kReleaseStale && !report_.status().owner;
  if (unknown || phase_ == Phase::kReleaseAll) {
    leave(now);
  } else if (phase_ == Phase::kReleasing) {
    leave(now);
    timers_.stopAll();
    phase_ = Phase::kReleased;
  }
}

void NodeConnect::leave(Instant now) noexcept {
  held_ = 0;
  channel_.cancelOwn();
  pause(pauseAfterRelease(), now);
}

Duration NodeConnect::pauseAfterRelease() const noexcept {
  return report_.status().state == NodeState::kRefused ? bus_.longest_retry : bus_.first_retry;
}

void NodeConnect::letGo(Instant now) noexcept {
  timers_.stopAll();
  channel_.close();
  if (held_ == 0 || isPolledByAnother(now)) return leave(now);
  enter(Phase::kReleaseAll, now);
}

void NodeConnect::handleOwner(const ExplicitAnswer& answer, Instant now) noexcept {
  report_.status().owner.reset();
  const bool foreign = foreign_mac_ && now - foreign_at_ < kForeignMemory;
  if (!answer.ok() || answer.data.size() != 2) {
    if (foreign) {
      report_.status().owner = foreign_mac_;
    } else if (phase_ == Phase::kAskOwner) {
      return enter(Phase::kAskOwnerConnected, now);
    }
  } else if (answer.data[1] != kNobody) {
    report_.status().owner = answer.data[1];
  }
  const std::optional<std::uint8_t> owner = report_.status().owner;
  if (owner && *owner != bus_.mac) {
    Sentence why;
    why.format("is allocated to another master, MAC id %u", unsigned{*owner});
    return refuse(why, now);
  }
  if (!owner && isPolledByAnother(now)) return refuse("is polled by another master", now);
  // Ours from before, as far as anybody knows: released with the bits that are allocated. Without process data of our own
  // those that are there are left alone: their time-out may be all that stops the device.
  const bool told = answer.ok() && answer.data.size() == 2 && (answer.data[0] & choice::kConnections) != 0;
  stale_ = told && config_.io.kind != IoKind::kNone
               ? static_cast<std::uint8_t>(answer.data[0] & choice::kConnections)
               : static_cast<std::uint8_t>((io_choice_ & choice::kConnections) | choice::kExplicit);
  if (config_.io.kind == IoKind::kNone) return enter(Phase::kReleaseStale, now);
  if (answer.end == ExplicitEnd::kTimedOut) return handleNoIoState(answer, now);
  askIoState(kFirstIoInstance, now);
}

// On the explicit connection of before, or on a new one where that was gone already.
void NodeConnect::askIoState(std::uint8_t instance, Instant now) noexcept {
  instance_ = instance;
  if (instance <= kLastIoInstance) return enter(Phase::kIoState, now);
  enter(held_ == 0 ? Phase::kReleaseStale : Phase::kReleaseStaleIo, now);
}

void NodeConnect::handleIoState(const ExplicitAnswer& answer, Instant now) noexcept {
  const bool is_state = answer.ok() && answer.data.size() == 1;
  const bool is_none = answer.end == ExplicitEnd::kRefused && answer.general == general_error::kNoObject;
  if (answer.may_be_late) return handleNoIoState(answer, now);
  if (is_state && answer.data[0] == kEstablished) return enter(Phase::kIoRate, now);
  if (is_state || is_none) return askIoState(static_cast<std::uint8_t>(instance_ + 1), now);
  handleNoIoState(answer, now);
}

// What has no time-out, or a long one, is given a short one: the motor stops by that, whatever comes of our start. What has
// none and takes none is stopped by words alone: nothing is waited for.
void NodeConnect::handleIoRate(const ExplicitAnswer& answer, Instant now) noexcept {
  if (answer.may_be_late) return handleNoIoState(answer, now);
  if (answer.end == ExplicitEnd::kTimedOut) return handleNoIoState(answer, now);
  const Duration rate = std::chrono::milliseconds{answer.number().value_or(kLongestPacketRate)};
  OfBefore& before = ofBefore();
  const bool is_short = rate > Duration::zero() && rate <= std::chrono::milliseconds{kShortRateOfBefore};
  // Once only: each writing begins the time-out anew, and a device may round what is written.
  if (!is_short && !before.written && before.writings < kMostWritings) {
    ++before.writings;
    return enter(Phase::kShortenIoRate, now);
  }
  if (rate == Duration::zero()) return askIoState(static_cast<std::uint8_t>(instance_ + 1), now);
  // What runs on is fed by somebody, as by our bit strobe for other devices, or begins anew by itself.
  const Instant over = now + kRatesUntilTimeout * rate + kCoarsestStep + bus_.first_retry;
  if (!before.over || over < *before.over) before.over = over;
  if (now >= *before.over) return askIoState(static_cast<std::uint8_t>(instance_ + 1), now);
  awaitIoOfBefore(rate, now);
}

void NodeConnect::awaitIoOfBefore(Duration rate, Instant now) noexcept {
  Sentence why;
  why.format(
      "has process data of ours from before, with a time-out of %.1f s: they are not released before that has run out, "
      "since it may be all that stops the motor",
      toSeconds(kRatesUntilTimeout * rate));
  report_.enter(report_.status().state == NodeState::kLost ? NodeState::kLost : NodeState::kAbsent, why, now);
  pause(bus_.first_retry, now, Phase::kAwaitIoOfBefore);
}

// The explicit connection of before may be gone, or another one's, or its answers are those of before: a new one is asked by,
// and process data stay as they are. Who tells it there neither is taken to have none that run.
void NodeConnect::handleNoIoState(const ExplicitAnswer& answer, Instant now) noexcept {
  if (held_ == 0 || answer.may_be_late) {
    stale_ = choice::kExplicit;
    return enter(Phase::kReleaseStale, now);
  }
  if (answer.end != ExplicitEnd::kTimedOut) return askIoState(static_cast<std::uint8_t>(instance_ + 1), now);
  // Most likely it has started anew since.
  if (failures_++ == 0) return beginTry(now);
  fail("does not tell whether process data of before run yet", now);
}

}  // namespace nord_driver::devicenet
