#include "cycle/supervisor.h"

#include <algorithm>
#include <limits>

#include "cycle/enable_refusal.h"
#include "cycle/leaders.h"
#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::GroupPhase;
using drive::Refusal;

namespace {

constexpr std::size_t kNoGroup = std::numeric_limits<std::size_t>::max();
constexpr const char* kDisabledAgain = "disabled again before all drives were enabled";

Sentence notHeardYet(const CommandState& commands, bool has_base) noexcept {
  Sentence text;
  text.format("%s been listened to for %.1f s only: ask again in %.1f s", has_base ? "cmd_vel has" : "commands have",
              toSeconds(commands.heard), toSeconds(commands.to_hear));
  return text;
}

}  // namespace

Supervisor::Supervisor(const CycleConfig& config, std::vector<drive::Drive>& drives, bool auto_enable,
                       const StartAcknowledge* start, CommandWatch* watch)
    : drives_(drives),
      group_of_(drives.size(), kNoGroup),
      refusals_(drives.size(), Refusal::kNone),
      has_base_(config.base.has_value()),
      auto_enable_(auto_enable),
      start_(start),
      watch_(watch) {
  if (config.base) addGroup(config.base->drives(), config);
  for (const DriveSetup& setup : config.drives) {
    const DriveIndex drive = names_.size();
    if (group_of_[drive] == kNoGroup && !setup.leader) addGroup({drive}, config);
    names_.push_back(setup.name);
    leaders_.push_back(setup.leader);
  }
}

// With those that follow them: whoever leads them stops with them.
void Supervisor::addGroup(const std::vector<DriveIndex>& leaders, const CycleConfig& config) {
  std::vector<DriveIndex> members = leaders;
  for (const DriveIndex leader : leaders) {
    for (const DriveIndex follower : followersOf(config, leader)) members.push_back(follower);
  }
  std::vector<drive::Drive*> pointers;
  for (const DriveIndex member : members) {
    pointers.push_back(&drives_[member]);
    group_of_[member] = groups_.size();
  }
  drive::GroupConfig group;
  group.shutdown_timeout = config.shutdown_timeout;
  group.ways = config.stop_ways;
  groups_.push_back({drive::DriveGroup{pointers, group}, members});
}

bool Supervisor::enabledOrEnabling(const Group& group) noexcept {
  const GroupPhase phase = group.group.report().phase;
  return phase == GroupPhase::kEnabled || phase == GroupPhase::kEnabling;
}

bool Supervisor::concerns(const Request& request, const Group& group) const noexcept {
  return request.drive == kAllDrives || &groups_[group_of_[request.drive]] == &group;
}

void Supervisor::handleRequest(const Request& request, const CommandState& commands, Instant now) noexcept {
  if (request.drive != kAllDrives && inBase(request.drive)) {
    // One wheel of a base enabled alone would turn the base. A stop of one stops them all, see `concerns`.
    if (request.kind == RequestKind::kEnable) {
      Sentence text;
      text.format("drive %s belongs to the base: use ~enable", names_[request.drive].c_str());
      return completions_.answer(request, false, text);
    }
  } else if (request.drive != kAllDrives && leaders_[request.drive] && request.kind == RequestKind::kEnable) {
    const char* const name = names_[request.drive].c_str();
    const char* const leader = names_[*leaders_[request.drive]].c_str();
    Sentence text;
    text.format("drive %s follows drive %s (drives/%s/follows), and is enabled and disabled with it: use ~%s/enable",
                name, leader, name, leader);
    return completions_.answer(request, false, text);
  }
  switch (request.kind) {
    case RequestKind::kEnable:
      return startEnable(request, commands, now);
    case RequestKind::kShutDown:
    case RequestKind::kDisable:
    case RequestKind::kQuickStop:
      return stop(request, now);
    default:
      return;  // not of the drives' motion
  }
}

void Supervisor::stop(const Request& request, Instant now) noexcept {
  shutting_down_ = shutting_down_ || request.kind == RequestKind::kShutDown;
  auto_enable_ = false;  // who says stop before the drives were ready does not want them enabled when they are
  endWaitingEnables(request);
  for (Group& group : groups_) {
    if (!concerns(request, group)) continue;
    if (request.kind == RequestKind::kQuickStop) {
      group.group.requestQuickStop(now);
    } else {
      group.group.requestDisable(now);
    }
  }
  followUp(request, now);
}

void Supervisor::endWaitingEnables(const Request& stop) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    bool ends = false;
    for (const Group& group : groups_) {
      ends = ends || (!jobs_[i].begun && concerns(stop, group) && concerns(jobs_[i].request, group));
    }
    if (ends) {
      completions_.answer(jobs_[i].request, false, kDisabledAgain);
    } else {
      jobs_[kept++] = jobs_[i];
    }
  }
  jobs_.resize(kept);
}

// Stops have acted by then, whatever becomes of their answer.
void Supervisor::followUp(const Request& request, Instant now, bool begun, std::optional<Instant> enabled_at) noexcept {
  const Job job{request, now + request.patience, begun, enabled_at, groupsToEnable(request)};
  const bool room = jobs_.size() < kMostJobs || request.kind == RequestKind::kShutDown;
  if (room && jobs_.push_back(job)) return;
  completions_.answer(request, false, "begun, but too many requests wait for their answers to follow this one");
}

Supervisor::Groups Supervisor::groupsToEnable(const Request& request) const noexcept {
  Groups groups;
  for (std::size_t i = 0; i < groups_.size() && request.kind == RequestKind::kEnable; ++i) {
    groups[i] = concerns(request, groups_[i]) && !groups_[i].group.commandAllowed();
  }
  return groups;
}

bool Supervisor::nothingToEnable(const Request& request) const noexcept {
  for (const Group& group : groups_) {
    if (concerns(request, group) && !enabledOrEnabling(group)) return false;
  }
  return true;
}

bool Supervisor::isEnabled(const Request& request) const noexcept {
  for (const Group& group : groups_) {
    if (concerns(request, group) && !group.group.commandAllowed()) return false;
  }
  return true;
}

void Supervisor::startEnable(const Request& request, const CommandState& commands, Instant now) noexcept {
  if (shutting_down_) return completions_.answer(request, false, "the node is ending");
  if (jobs_.size() >= kMostJobs)
    return completions_.answer(request, false, "too many requests are being carried out already");
  // As of what the drives say from now on: one may have tripped while this cycle was held up.
  if (isEnabled(request)) return followUp(request, now, true, now);
  if (nothingToEnable(request)) return followUp(request, now);
  const Sentence moving = movingAgainst(request, commands, now);
  if (!moving.empty()) return completions_.answer(request, false, reasonsAgainst(request, moving));
  if (commands.to_hear > request.patience) {
    return completions_.answer(request, false, reasonsAgainst(request, notHeardYet(commands, has_base_)));
  }
  // It may still be refused: auto_enable_ stays what it is until it has begun.
  if (commands.to_hear > Duration::zero() || awaitsParameters(request)) return followUp(request, now, false);
  if (!enableAll(request, now)) return;
  auto_enable_ = false;  // somebody has taken over
  followUp(request, now);
}

// Nothing else stands against it, and it takes a second as a rule; where the drive refuses for the moment, some more.
bool Supervisor::awaitsParameters(const Request& request) const noexcept {
  bool awaits = false;
  for (const Group& group : groups_) {
    if (!concerns(request, group) || enabledOrEnabling(group)) continue;
    if (group.group.report().phase != GroupPhase::kDisabled) return false;
    for (const DriveIndex member : group.members) {
      const Refusal refusal = drives_[member].enableRefusal();
      if (refusal != Refusal::kNone && refusal != Refusal::kParametersAwaited) return false;
      awaits = awaits || refusal == Refusal::kParametersAwaited;
    }
  }
  return awaits;
}

Sentence Supervisor::reasonsAgainst(const Request& request, const Sentence& commands) noexcept {
  for (const Group& group : groups_) {
    const bool asked = concerns(request, group) && !enabledOrEnabling(group);
    bool stopping = asked && group.group.report().phase != GroupPhase::kDisabled;
    for (const DriveIndex member : group.members) {
      Refusal& refusal = refusals_[member];
      refusal = asked ? drives_[member].enableRefusal() : Refusal::kNone;
      stopping = stopping && refusal == Refusal::kNone;
    }
    if (stopping) refusals_[group.members.front()] = Refusal::kStopping;
  }
  return enableRefusalMessage(names_, drives_, refusals_, commands);
}

bool Supervisor::enableAll(const Request& request, Instant now) noexcept {
  const Sentence reasons = reasonsAgainst(request, {});
  if (!reasons.empty()) {
    completions_.answer(request, false, reasons);
    return false;
  }
  // Whatever a group would refuse was among the reasons.
  for (Group& group : groups_) {
    if (concerns(request, group) && !enabledOrEnabling(group)) group.group.requestEnable(now);
  }
  return true;
}

// What was enabled before goes on.
void Supervisor::takeBack(const Groups& begun, Instant now) noexcept {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    if (begun[i] && enabledOrEnabling(groups_[i])) groups_[i].group.requestDisable(now);
  }
}

// Of one drive or the base: what others are told to do is no reason against it.
Sentence Supervisor::movingAgainst(const Request& request, const CommandState& commands, Instant now) noexcept {
  if (commands.moving.empty() || request.drive == kAllDrives || watch_ == nullptr) return commands.moving;
  const std::size_t group = group_of_[request.drive];
  return watch_->movingOf(groups_[group].members, has_base_ && group == 0, now);
}

Sentence Supervisor::refusalOf(const Group& group, const drive::GroupRefusal& refusal) const noexcept {
  const DriveIndex drive = group.members[refusal.member];
  return refusalMessage(names_[drive].c_str(), refusal.refusal, drives_[drive].report());
}

void Supervisor::update(const CommandState& commands, Instant now) noexcept {
  for (Group& group : groups_) group.group.update(now);
  if (auto_enable_) autoEnable(commands, now);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (!follow(jobs_[i], commands, now)) jobs_[kept++] = jobs_[i];
  }
  jobs_.resize(kept);
}

// Once, when every drive has first become ready and the commands are quiet: never over a fault nor after one (whoever
// acknowledges it enables), never after a stop (a stop needs an enable before it). What StartAcknowledge takes away is
// none of these, nor is an enable that is refused. While one waits it is not known yet who enables, and how much.
void Supervisor::autoEnable(const CommandState& commands, Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const bool may_go = start_ != nullptr && start_->mayAcknowledge(i);
    if (drives_[i].report().fault_latched && !may_go) auto_enable_ = false;
  }
  if (!auto_enable_ || !commands.quiet || shutting_down_ || anyEnableWaits()) return;
  for (const drive::Drive& drive : drives_) {
    // Idle it is sent OFF1, which leads out of "switch-on disabled": one that stays there is held, by a safe stop or without mains.
    const bool held = drive.report().state == profile::DriveState::kSwitchOnDisabled;
    if (held || drive.enableRefusal() != Refusal::kNone) return;
  }
  Request request;
  request.kind = RequestKind::kEnable;
  request.patience = std::chrono::minutes{1};
  startEnable(request, commands, now);
}

bool Supervisor::anyEnableWaits() const noexcept {
  return std::any_of(jobs_.begin(), jobs_.end(), [](const Job& job) { return !job.begun; });
}

bool Supervisor::followWaiting(Job& job, const CommandState& commands, Instant now) noexcept {
  const Sentence moving = movingAgainst(job.request, commands, now);
  if (!moving.empty()) {
    completions_.answer(job.request, false, reasonsAgainst(job.request, moving));
    return true;
  }
  if (commands.to_hear > Duration::zero()) {
    if (now < job.deadline) return false;
    completions_.answer(job.request, false, notHeardYet(commands, has_base_));
    return true;
  }
  if (now < job.deadline && awaitsParameters(job.request)) return false;
  job.begun = enableAll(job.request, now);
  job.to_enable = groupsToEnable(job.request);
  if (job.begun) auto_enable_ = false;  // as in startEnable()
  return !job.begun;
}

bool Supervisor::follow(Job& job, const CommandState& commands, Instant now) noexcept {
  if (!job.begun) return followWaiting(job, commands, now);
  if (job.request.kind == RequestKind::kEnable ? followEnable(job, now) : followStop(job, now)) return true;
  if (now < job.deadline) return false;
  endUndone(job.request, unsettled(job));
  // Told that it failed, its asker must not see it succeed later.
  takeBack(job.to_enable, now);
  return true;
}

// Of auto_enable nobody waits for the answer.
void Supervisor::endUndone(const Request& request, const Sentence& why) noexcept {
  completions_.answer(request, false, why);
  if (request.id == 0 && request.kind == RequestKind::kEnable) auto_enable_failure_ = why;
}

bool Supervisor::followEnable(const Job& job, Instant now) noexcept {
  bool all = true;
  for (const Group& group : groups_) {
    if (!concerns(job.request, group)) continue;
    const drive::GroupReport& report = group.group.report();
    if (report.phase == GroupPhase::kEnabled) {
      for (const DriveIndex member : group.members) {
        all = all && (!job.enabled_at || drives_[member].lastHeard() > *job.enabled_at);
      }
      continue;
    }
    all = false;
    if (report.phase == GroupPhase::kEnabling) continue;
    takeBack(job.to_enable, now);
    endUndone(job.request, report.refusal.accepted() ? Sentence{kDisabledAgain} : refusalOf(group, report.refusal));
    return true;
  }
  if (all) completions_.answer(job.request, true, job.enabled_at ? "already enabled" : "enabled");
  return all;
}

bool Supervisor::followStop(const Job& job, Instant now) noexcept {
  for (const Group& group : groups_) {
    if (concerns(job.request, group) && !group.group.settled()) return false;
  }
  const Sentence silent = silentMembers(job.request);
  // Back before the deadline, maybe. The node's end waits for who was lost while it turned only: it may hear its stop.
  const bool may_hear =
      std::any_of(drives_.begin(), drives_.end(), [now](const auto& it) { return it.stopsUnheard(now); });
  if (!silent.empty() && (may_hear || job.request.kind != RequestKind::kShutDown)) return false;
  if (!silent.empty()) {
    completions_.answer(job.request, false, silent);
    return true;
  }
  const bool quick = job.request.kind == RequestKind::kQuickStop;
  completions_.answer(job.request, true, quick ? "stopped and disabled" : "disabled");
  return true;
}

// A group counts a silent drive as settled, for nothing more can be done with it; confirmed it has nothing.
Sentence Supervisor::silentMembers(const Request& request) const noexcept {
  Sentence who;
  int count = 0;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!concerns(request, groups_[group_of_[i]]) || drives_[i].report().online) continue;
    Sentence longer;
    longer.format("%.150s%s%s", who.c_str(), count == 0 ? "" : ", ", names_[i].c_str());
    who = longer;
    ++count;
  }
  Sentence text;
  if (count == 1) text.format("drive %s does not answer: nobody has seen it stop", who.c_str());
  if (count > 1) text.format("drives %.180s do not answer: nobody has seen them stop", who.c_str());
  return text;
}

// The member that has not come: a group is enabled when all of its members are.
Sentence Supervisor::unsettled(const Job& job) const noexcept {
  const bool enable = job.request.kind == RequestKind::kEnable;
  for (const Group& group : groups_) {
    if (!concerns(job.request, group)) continue;
    for (const DriveIndex member : group.members) {
      const drive::Drive& drive = drives_[member];
      const bool heard = !job.enabled_at || drive.lastHeard() > *job.enabled_at;
      const bool at_rest = drive.report().online && drive.isAtRest();
      if (enable ? drive::isEnabled(drive.report().phase) && heard : at_rest) continue;
      // Its own time for it may end in this very cycle, or later: what is told is the same.
      if (enable && drive.report().phase == drive::Phase::kEnabling) {
        return refusalMessage(names_[member].c_str(), Refusal::kEnableTimeout, drive.report());
      }
      return unconfirmedMessage(names_[member].c_str(), drive.report());
    }
  }
  return "not confirmed in time";
}

bool Supervisor::settled() const noexcept {
  return std::all_of(groups_.begin(), groups_.end(), [](const Group& group) { return group.group.settled(); });
}

Sentence Supervisor::baseStopSentence() const noexcept {
  if (!has_base_) return {};
  const Group& base = groups_.front();
  const drive::GroupReport& report = base.group.report();
  if (report.stop_cause == drive::StopCause::kCommandTimeout) return drive::toString(report.stop_cause);
  const DriveIndex member = base.members[report.stop_member];
  return stopMessage(names_[member].c_str(), report.stop_cause, drives_[member].report());
}

}  // namespace nord_driver::cycle
