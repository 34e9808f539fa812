// How the master begins with a node and lets it go. Whoever begins may find drives that turn by the words of somebody who
// is gone: these are stopped before the node is made deaf, by a reset or in pre-operational, to what stops them. A reset
// would also take away the life time that may be about to stop them.
#include "canopen/boot_sentences.h"
#include "canopen/node_boot.h"

namespace nord_driver::canopen {
namespace {

Sentence foundSentence(FoundMotion motion) noexcept {
  if (motion == FoundMotion::kDriven) return stoppedFirst();
  return motion == FoundMotion::kUnknown ? askedBySync() : Sentence{};
}

}  // namespace

// One that rests now keeps the reason until it is begun with.
void NodeBoot::handleMotion(FoundMotion motion) noexcept {
  if (motion == motion_) return;
  motion_ = motion;
  NodeStatus& status = report_.status();
  if (status.stops_first && motion != FoundMotion::kRests) status.reason = foundSentence(motion);
}

void NodeBoot::restart(Instant now) noexcept {
  NodeStatus& status = report_.status();
  const bool found = motion_ != FoundMotion::kRests;
  const bool may_run = found || (past_.was_operational && status.nmt == NmtState::kOperational);
  report_.enter(may_run ? NodeState::kLost : NodeState::kAbsent, foundSentence(motion_), now);
  // In operation only it sends process data, and hears any.
  status.nmt = may_run ? NmtState::kOperational : NmtState::kUnknown;
  status.stops_first = found;
  command_.reset();
  past_ = Past{};
  ask_pause_.reset();
  refuse_pause_.reset();
  if (!may_run) return begin(now);
  past_.was_operational = true;
  tellFirst(now);
}

// It may hear us without being heard, or have been out of reach of a moment's bus: what stops its drive goes out before
// anything that makes it deaf to that.
void NodeBoot::tellFirst(Instant now) noexcept {
  past_.reset_due = config_.reset != BootReset::kNone;
  past_.lost_at = now;
  past_.cycles_to_tell = kCyclesToTell;
  phase_ = Phase{Silent{}};
  port_.cancel(SdoOwner::kBoot, now);
  timers_.set(NodeTimer::kBoot, now + kFirstAskPause);
}

// One that was found driven is told until it rests. A drive that does not obey must not keep its node out for ever.
bool NodeBoot::isTold(Instant now) const noexcept {
  if (past_.cycles_to_tell > 0) return true;
  return isStillDriven() && now - past_.lost_at < config_.only_asked;
}

bool NodeBoot::isStillDriven() const noexcept {
  const NodeStatus& status = report_.status();
  return status.stops_first && motion_ == FoundMotion::kDriven && status.nmt == NmtState::kOperational;
}

void NodeBoot::begin(Instant now) noexcept {
  endStopFirst(now);
  if (config_.reset != BootReset::kNone) {
    reset(now);
  } else {
    ask(now);
  }
}

void NodeBoot::endStopFirst(Instant now) noexcept {
  NodeStatus& status = report_.status();
  motion_ = FoundMotion::kRests;
  if (!status.stops_first) return;
  status.stops_first = false;
  report_.enter(NodeState::kAbsent, {}, now);
  past_.was_operational = false;
}

void NodeBoot::release(Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  if (report_.status().stops_first && motion_ != FoundMotion::kRests) return leaveAsFound();
  const bool ever_there = report_.status().state != NodeState::kAbsent;
  report_.enter(NodeState::kReleased, {}, now);
  if (config_.reset != BootReset::kNone) return endRelease(NmtCommand::kResetCommunication, now);
  const Release release{watch() != Watch::kOff};
  release_script_.begin();
  if (!ever_there || release_script_.done()) return endRelease(NmtCommand::kEnterPreOperational, now);
  phase_ = Phase{release};
  command_.reset();
  timers_.set(NodeTimer::kBoot, now + kLongestRelease);
  submit(release_script_.request(), now);
}

// Its drives slow down by our last word, and whoever it watches has not been us.
void NodeBoot::leaveAsFound() noexcept {
  phase_ = Phase{Off{}};
  timers_.stop(NodeTimer::kBoot);
  command_.reset();
}

void NodeBoot::endRelease(NmtCommand command, Instant now) noexcept {
  port_.cancel(SdoOwner::kBoot, now);
  phase_ = Phase{Off{}};
  timers_.stop(NodeTimer::kBoot);
  command_ = command;
}

}  // namespace nord_driver::canopen
