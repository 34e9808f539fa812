// Whose a device is, and what of before is let go.
#include "devicenet/node_connect.h"

namespace nord_driver::devicenet {
namespace {

/// The master's MAC id of a device that has none.
constexpr std::uint8_t kNobody = 0xFF;
/// So long after a frame of another master the device is taken to be its.
constexpr Duration kForeignMemory = std::chrono::seconds{5};

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
  enter(Phase::kReleaseStale, now);
}

}  // namespace nord_driver::devicenet
