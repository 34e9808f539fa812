#include "cycle/start_acknowledge.h"

#include <utility>

#include "profile/fault_number.h"
#include "profile/status_word.h"

namespace nord_driver::cycle {

namespace {

/// No user's request has it: those are counted from 1 on.
constexpr std::uint32_t kToken = 0xFFFFFFFF;

// E10.0 to E10.9: the communication with and behind the bus modules (BU 0020 8.1, BU 2700 8.3).
bool isBusTimeout(std::uint16_t number) noexcept {
  return number >= 100 && number <= 109;
}

}  // namespace

StartAcknowledge::StartAcknowledge(bool wanted, std::vector<drive::Drive>& drives, std::vector<std::string> names,
                                   std::vector<DriveIndex> groups)
    : drives_(drives), names_(std::move(names)), groups_(std::move(groups)), states_(drives.size()) {
  for (State& state : states_) state.step = wanted ? Step::kAwaited : Step::kDone;
}

void StartAcknowledge::update(DriveIndex drive, std::uint16_t number, bool quiet, Instant now) noexcept {
  State& state = states_[drive];
  if (state.step == Step::kDone) return;
  const drive::DriveReport& report = drives_[drive].report();
  if (state.step == Step::kAsked) return follow(drive);
  if (!report.online) {
    lose(drive, now);
  } else if (!report.fault_latched) {
    state.step = Step::kDone;  // met without one, or somebody has acknowledged it
  } else if (state.step == Step::kAwaited) {
    state = {Step::kJudging, now};  // not before the next cycle: what is known of its number is older
  } else {
    judge(drive, number, quiet, now);
  }
}

// What it comes back with may have come meanwhile, and has not stood before this node. Before its number was read it may
// just have been switched on: that is no meeting yet, unless it stays away.
void StartAcknowledge::lose(DriveIndex drive, Instant now) noexcept {
  State& state = states_[drive];
  if (state.step == Step::kJudging) {
    if (state.rest_due) return giveUp(drive, "it fell silent before that could be done");
    state = {};
    state.lost = now;
  } else if (state.lost && now - *state.lost >= kNumberAwaited) {
    giveUp(drive, "it fell silent before its number (P700) was read");
  }
}

void StartAcknowledge::judge(DriveIndex drive, std::uint16_t number, bool quiet, Instant now) noexcept {
  State& state = states_[drive];
  if (!profile::isFaultNumber(number)) {
    if (now - state.since >= kNumberAwaited) giveUp(drive, "its number (P700) could not be read");
    return;
  }
  if (!isBusTimeout(number)) {
    state.step = Step::kDone;  // the log names it, with what to do
    return;
  }
  if (!state.rest_due || !allOnline(drive)) state.rest_due = now;
  const std::optional<DriveIndex> unscaled = firstUnscaled(drive);
  if (quiet && !unscaled && allAtRest(drive)) {
    state.step = Step::kAsked;
    state.number = number;
    drives_[drive].requestAcknowledge(now, kToken);
    follow(drive);
  } else if (now - *state.rest_due >= kRestAwaited) {
    Sentence why;
    if (!quiet) {
      why = "commands to move came all the time";
    } else if (unscaled) {
      why.format("the maximum frequency (P105) of drive %s is not known", names_[*unscaled].c_str());
    } else {
      why = "a drive was not at rest";
    }
    giveUp(drive, why.c_str());
  }
}

void StartAcknowledge::follow(DriveIndex drive) noexcept {
  const drive::RequestReport& report = drives_[drive].report().acknowledge;
  if (report.token == kToken && report.state == drive::RequestState::kRunning) return;
  State& state = states_[drive];
  state.step = Step::kDone;
  const unsigned number = state.number;
  BusEvent event;
  if (report.token == kToken && report.state == drive::RequestState::kDone) {
    event.warning = false;
    event.text.format("drive %s: E%u.%u, which stood before this node started, is acknowledged (acknowledge_at_start)",
                      names_[drive].c_str(), number / 10, number % 10);
  } else {
    event.warning = true;
    event.text.format("drive %s: E%u.%u, which stood before this node started, could not be acknowledged: %s",
                      names_[drive].c_str(), number / 10, number % 10, drive::toString(report.refusal));
  }
  events_.push(event);
}

bool StartAcknowledge::concerned(DriveIndex drive, DriveIndex other) const noexcept {
  return groups_[other] == groups_[drive];
}

bool StartAcknowledge::allOnline(DriveIndex drive) const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (concerned(drive, i) && !drives_[i].report().online) return false;
  }
  return true;
}

// A profile with revolutions per minute tells every speed as 0 until P105 is known, and P700 is read before it. NORD's
// words are shares of P105 and would not need it: but which words a bus has is not told here, and P105 comes soon, read or,
// where there is no parameter channel (PPO 3 and 4), as typed. A drive with neither can never be enabled: when
// kRestAwaited has passed it is named, and nothing is lost that could have moved.
std::optional<DriveIndex> StartAcknowledge::firstUnscaled(DriveIndex drive) const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (concerned(drive, i) && !drives_[i].report().scaled) return i;
  }
  return std::nullopt;
}

// One that is being acknowledged is at rest, too.
bool StartAcknowledge::allAtRest(DriveIndex drive) const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!concerned(drive, i)) continue;
    const bool acknowledging = i != drive && drives_[i].report().phase == drive::Phase::kAcknowledging;
    if (!drives_[i].isNearStandstill() || !(drives_[i].isAtRest() || acknowledging)) return false;
  }
  return true;
}

void StartAcknowledge::giveUp(DriveIndex drive, const char* why) noexcept {
  states_[drive].step = Step::kDone;
  BusEvent event{true, {}};
  event.text.format("drive %s: its fault is not acknowledged at start: %s", names_[drive].c_str(), why);
  events_.push(event);
}

}  // namespace nord_driver::cycle
