#include "drive/drive_group.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nord_driver::drive {

namespace {

bool runs(const Drive& drive) noexcept {
  const Phase phase = drive.report().phase;
  return isEnabled(phase) || phase == Phase::kHoldingZero;
}

bool isDown(const Drive& drive) noexcept {
  const Phase phase = drive.report().phase;
  return phase == Phase::kIdle || phase == Phase::kOffline || phase == Phase::kAcknowledging ||
         phase == Phase::kSwitchingSet;
}

/// A bit for each of what stops a motor past its group: fault, OFF2, OFF3, local control.
unsigned stopsIn(profile::StatusWord status) noexcept {
  return (status.fault() ? 1u : 0u) | (status.voltageEnabled() ? 0u : 2u) | (status.quickStopInactive() ? 0u : 4u) |
         (status.busControl() ? 0u : 8u);
}

}  // namespace

DriveGroup::DriveGroup(std::vector<Drive*> members, const GroupConfig& config)
    : members_(std::move(members)), config_(config), heard_(members_.size(), 0) {
  if (members_.empty()) throw std::invalid_argument("a group of drives needs at least one drive");
  for (const Drive* member : members_) {
    if (member == nullptr) throw std::invalid_argument("a group of drives was given a null drive");
  }
}

void DriveGroup::enter(GroupPhase phase, Instant now) noexcept {
  report_.phase = phase;
  phase_since_ = now;
  if (isOnWayDown(phase)) ++stops_;
}

void DriveGroup::latch(StopCause cause, std::size_t member) noexcept {
  if (report_.stop_cause != StopCause::kNone) return;
  report_.stop_cause = cause;
  report_.stop_member = member;
}

GroupRefusal DriveGroup::requestEnable(Instant now) noexcept {
  report_.refusal = {};
  if (report_.phase == GroupPhase::kEnabling || report_.phase == GroupPhase::kEnabled) return report_.refusal;
  if (report_.phase != GroupPhase::kDisabled) report_.refusal.refusal = Refusal::kStopping;
  for (std::size_t i = 0; i < members_.size() && report_.refusal.accepted(); ++i) {
    report_.refusal = {members_[i]->enableRefusal(), i};
  }
  if (!report_.refusal.accepted()) return report_.refusal;
  for (Drive* member : members_) member->requestEnable(now);
  report_.refusal = {};
  report_.stop_cause = StopCause::kNone;
  enter(GroupPhase::kEnabling, now);
  return report_.refusal;
}

void DriveGroup::requestDisable(Instant now) noexcept {
  switch (report_.phase) {
    case GroupPhase::kEnabled:
      return stop(config_.ways.disable, StopCause::kNone, now);
    case GroupPhase::kEnabling:
      report_.refusal = {Refusal::kStopped, 0};
      down_since_ = now;
      return shutdownAll(StopCause::kNone, now);
    case GroupPhase::kRampingDown:
    case GroupPhase::kHalting:
    case GroupPhase::kStopping:  // the bound of the way down runs on
      return disableOnWayDown(now);
    case GroupPhase::kDisabled:  // one may be taught its position
      ++stops_;
      for (Drive* member : members_) member->requestShutdown(now);
      return;
    case GroupPhase::kQuickStopping:
      return;
  }
}

// Who is on a ramp gets the way of a disable. Not who stands, which may be under local control and follow no word, nor who
// stops at once already.
void DriveGroup::disableOnWayDown(Instant now) noexcept {
  const StopWay way = config_.ways.disable;
  if (way != StopWay::kQuickStop && way != StopWay::kCoast) {
    if (report_.phase == GroupPhase::kHalting) shutdownAll(StopCause::kNone, now);
    return;
  }
  bool any = false;
  for (Drive* member : members_) {
    if (!runs(*member) && member->report().phase != Phase::kStopping) continue;
    any = true;
    way == StopWay::kQuickStop ? member->requestQuickStop(now, StopCause::kNone)
                               : member->requestCoast(now, StopCause::kNone);
  }
  if (any) enter(way == StopWay::kQuickStop ? GroupPhase::kQuickStopping : GroupPhase::kStopping, now);
}

// From kEnabled, all members.
void DriveGroup::stop(StopWay way, StopCause cause, Instant now) noexcept {
  down_since_ = now;
  down_for_ = cause;
  switch (way) {
    case StopWay::kSetpointZero:
    case StopWay::kOff1:
      // On a reference run an axis follows no setpoint: it would run on until the ramp is over.
      if (onlyPositions() || isHoming()) return shutdownAll(cause, now);
      setpoint_is_zero_ = false;
      zero_seen_ = false;
      return enter(GroupPhase::kRampingDown, now);
    case StopWay::kQuickStop:
      return quickStopAll(cause, now);
    case StopWay::kCoast:
      return coastAll(cause, now);
  }
}

void DriveGroup::commandIsFresh(bool fresh, Instant now) noexcept {
  const bool too_old = followed_ && !fresh && report_.phase == GroupPhase::kEnabled;
  followed_ = fresh && report_.phase == GroupPhase::kEnabled;
  if (!too_old || config_.ways.command_timeout == StopWay::kSetpointZero) return;
  latch(StopCause::kCommandTimeout, 0);
  stop(config_.ways.command_timeout, StopCause::kCommandTimeout, now);
}

void DriveGroup::requestQuickStop(Instant now) noexcept {
  if (report_.phase == GroupPhase::kEnabling) report_.refusal = {Refusal::kStopped, 0};
  latch(StopCause::kQuickStop, 0);
  quickStopAll(StopCause::kQuickStop, now);
}

void DriveGroup::quickStopAll(StopCause cause, Instant now) noexcept {
  for (Drive* member : members_) member->requestQuickStop(now, cause);
  enter(GroupPhase::kQuickStopping, now);
}

bool DriveGroup::quickStopTheRest(Instant now) noexcept {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i]->report().phase != Phase::kStopping) continue;
    latch(StopCause::kShutdownTimeout, i);
    quickStopAll(StopCause::kShutdownTimeout, now);
    return true;
  }
  return false;
}

void DriveGroup::coastAll(StopCause cause, Instant now) noexcept {
  for (Drive* member : members_) member->requestCoast(now, cause);
  enter(GroupPhase::kStopping, now);
}

void DriveGroup::shutdownAll(StopCause cause, Instant now) noexcept {
  for (Drive* member : members_) member->requestShutdown(now, cause);
  enter(GroupPhase::kStopping, now);
}

// A member that is not heard keeps its last word.
bool DriveGroup::stopBegan() noexcept {
  bool began = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const profile::StatusWord before(heard_[i]), now(members_[i]->report().status_word);
    heard_[i] = now.word();
    began = began || (stopsIn(now) & ~stopsIn(before)) != 0;
  }
  return began;
}

bool DriveGroup::stopStands() const noexcept {
  return std::any_of(heard_.begin(), heard_.end(), [](Word word) {
    const profile::StatusWord status(word);
    return status.isUseful() && stopsIn(status) != 0;
  });
}

void DriveGroup::update(Instant now) noexcept {
  if (stopBegan()) ++stops_;
  switch (report_.phase) {
    case GroupPhase::kDisabled:
      return;
    case GroupPhase::kEnabling:
      return updateEnabling(now);
    case GroupPhase::kEnabled:
      haltIfAMemberStopped(now);
      return;
    case GroupPhase::kRampingDown:
      if (!haltIfAMemberStopped(now)) updateRampingDown(now);
      return;
    case GroupPhase::kHalting:
      return updateHalting(now);
    case GroupPhase::kStopping:
      if (now - down_since_ >= config_.shutdown_timeout && quickStopTheRest(now)) return;
      return updateStopping();
    case GroupPhase::kQuickStopping:
      return updateStopping();
  }
}

void DriveGroup::updateEnabling(Instant now) noexcept {
  bool all_enabled = true;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const DriveReport& member = members_[i]->report();
    if (isEnabled(member.phase)) continue;
    all_enabled = false;
    if (member.phase == Phase::kEnabling) continue;
    // It timed out, stopped or vanished: all or none. The others stand still, their setpoint was 0.
    report_.refusal = {member.refusal == Refusal::kNone ? Refusal::kStopped : member.refusal, i};
    if (member.stop_cause != StopCause::kNone) latch(member.stop_cause, i);
    down_since_ = now;
    return shutdownAll(StopCause::kNone, now);
  }
  if (all_enabled) enter(GroupPhase::kEnabled, now);
}

bool DriveGroup::haltIfAMemberStopped(Instant now) noexcept {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (isEnabled(members_[i]->report().phase)) continue;
    latch(members_[i]->report().stop_cause, i);
    haltTheOthers(now);
    return true;
  }
  return false;
}

// The member that stopped keeps its idle word.
void DriveGroup::haltTheOthers(Instant now) noexcept {
  const StopWay way = config_.ways.drive_stopped;
  for (Drive* member : members_) {
    if (!runs(*member)) continue;
    if (way == StopWay::kSetpointZero) member->requestSetpointZero(now);
    if (way == StopWay::kOff1) member->requestShutdown(now);
    if (way == StopWay::kQuickStop) member->requestQuickStop(now, StopCause::kNone);
    if (way == StopWay::kCoast) member->requestCoast(now, StopCause::kNone);
  }
  bound_runs_on_ = report_.phase == GroupPhase::kRampingDown;
  if (!bound_runs_on_) down_since_ = now;
  halting_speed_ = std::numeric_limits<int>::max();
  // OFF1 at once would take their torque at 0 Hz; kHalting waits for the drive's own ramp first.
  enter(way == StopWay::kSetpointZero ? GroupPhase::kHalting : GroupPhase::kStopping, now);
}

bool DriveGroup::onlyPositions() const noexcept {
  return std::all_of(members_.begin(), members_.end(), [](const Drive* member) { return member->positions(); });
}

bool DriveGroup::isHoming() const noexcept {
  return std::any_of(members_.begin(), members_.end(),
                     [](const Drive* member) { return member->report().position.homing; });
}

bool DriveGroup::nearStandstill() const noexcept {
  for (const Drive* member : members_) {
    if (!runs(*member)) continue;
    if (std::abs(int{member->report().speed}) > config_.near_standstill) return false;
  }
  return true;
}

bool DriveGroup::quickStopWhenOverdue(Instant now) noexcept {
  if (now - down_since_ < config_.shutdown_timeout) return false;
  latch(StopCause::kShutdownTimeout, 0);
  quickStopAll(StopCause::kShutdownTimeout, now);
  return true;
}

void DriveGroup::updateRampingDown(Instant now) noexcept {
  if (quickStopWhenOverdue(now)) return;
  if (!setpoint_is_zero_) {
    zero_seen_ = false;
    return;
  }
  if (!zero_seen_) {
    zero_seen_ = true;
    zero_since_ = now;
  }
  if (nearStandstill() || now - zero_since_ >= config_.standstill_timeout) shutdownAll(down_for_, now);
}

// At setpoint 0 a drive with P104 > 0 comes down to that and no further; left there, it turns the base around the one
// that has no torque.
bool DriveGroup::getsSlower(Instant now) noexcept {
  int speed = 0;
  for (const Drive* member : members_) {
    if (runs(*member)) speed += std::abs(int{member->report().speed});
  }
  if (speed <= halting_speed_ - config_.near_standstill) {
    halting_speed_ = speed;
    slower_since_ = now;
  }
  return now - slower_since_ < config_.standstill_timeout;
}

// The end of the node waits no longer than shutdown_timeout, and one that trips on the way down does not make it longer.
void DriveGroup::updateHalting(Instant now) noexcept {
  if (bound_runs_on_ && quickStopWhenOverdue(now)) return;
  const bool goes_on = getsSlower(now) && now - phase_since_ < config_.shutdown_timeout;
  if (!nearStandstill() && goes_on) return;
  if (!bound_runs_on_) down_since_ = now;
  shutdownAll(StopCause::kNone, now);
}

void DriveGroup::updateStopping() noexcept {
  for (const Drive* member : members_) {
    if (!isDown(*member)) return;
  }
  report_.phase = GroupPhase::kDisabled;
}

bool DriveGroup::settled() const noexcept {
  if (report_.phase != GroupPhase::kDisabled) return false;
  for (const Drive* member : members_) {
    if (!member->isAtRest()) return false;
  }
  return true;
}

}  // namespace nord_driver::drive
