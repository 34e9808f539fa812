#include "campaign/motion_invariants.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nord_driver::test {

namespace {

constexpr double kRounding = 0.1;      // Hz: a setpoint is a share of 16384, DeviceNet's of 1500 rpm or 0.1 Hz
constexpr double kAtRest = kRounding;  // nobody can tell less from nothing

bool turnsByTerminals(const DriveTruth& drive) {
  return drive.state == sim::InverterState::kOperationEnabled && !drive.bus_control;
}

}  // namespace

void CommandedSpeed::look(const Moment& moment, const GroupWish& group, DriveIndex drive, double wanted, double speed,
                          double dt) {
  const DriveTruth& truth = moment.drives[drive];
  const SetpointRamp& ramp = moment.setpoint_ramps[drive];
  const bool cut = std::any_of(group.members.begin(), group.members.end(), [&](DriveIndex i) { return moment.cut[i]; });
  if (!group.asked) wanted = 0.0;
  // A single drive follows the sign; a base rests as a whole (doc/safety.md, "P104 above 0").
  if (wanted > 0.0 && !group.is_base) wanted = std::max(wanted, truth.slowest);
  told_ = std::max(wanted, told_ - ramp.slowest * dt);
  bound_.look(moment, cut, told_, truth.ramp, dt, ramp.longest);
  // Terminals turn it as they like, and their ramp follows them down; until some time after the look before they did.
  const bool by_terminals = turnsByTerminals(truth);
  if (by_terminals || by_terminals_) bound_.raise(speed);
  // Whose P105 is taken for its own it turns in proportion to that.
  if (drive == 0 && moment.stand_in_believed) bound_.raise(speed);
  by_terminals_ = by_terminals;
}

std::optional<std::string> TurnsOnlyAsCommanded::look(const Moment& moment) {
  tracks_.resize(moment.drives.size());
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  for (const GroupWish& group : moment.groups) {
    if (group.is_axis) continue;
    for (const DriveIndex i : group.members) {
      const DriveTruth& drive = moment.drives[i];
      Track& track = tracks_[i];
      const double speed = std::fabs(drive.frequency);
      const bool by_terminals = turnsByTerminals(drive);  // that is no stop of ours
      const Span goal = moment.wantedOf(i);
      track.bound.look(moment, group, i, std::max(-goal.least, goal.most), speed, dt);
      if (speed > track.bound.value() + kRounding) {
        std::ostringstream out;
        out << "drive " << i << ": " << drive.frequency << " Hz, no more than " << track.bound.value()
            << " Hz is commanded";
        return out.str();
      }
      const double allowed = track.bound.allowedNow();
      if (allowed > 0.0 || speed < kAtRest || by_terminals) {
        if (track.ended && speed < kAtRest && allowed == 0.0 && !by_terminals && track.stop_bound > 0.0) {
          const Stop stop{track.stop_took, track.stop_bound};
          if (worst_.bound == 0.0 || stop.took * worst_.bound > worst_.took * stop.bound) worst_ = stop;
        }
        track.ended.reset();
      } else {
        if (!track.ended) track.stop_bound = 0.0;
        if (!track.ended) track.ended = moment.now;
        // What happens meanwhile may prolong it. Between two looks nobody knows, and these may be a second apart: a
        // transport that closes.
        track.stop_took = toSeconds(moment.now - *track.ended);
        track.stop_bound = std::max(track.stop_bound, track.stop_took + (track.bound.value() + kRounding) / drive.ramp);
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> TurnsTheCommandedWay::look(const Moment& moment) {
  bounds_.resize(moment.drives.size());
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  for (const GroupWish& group : moment.groups) {
    if (group.is_axis) continue;
    for (const DriveIndex i : group.members) {
      const Span goal = moment.wantedOf(i);
      for (const bool forward : {true, false}) {
        const double speed = forward ? moment.drives[i].along : -moment.drives[i].along;
        CommandedSpeed& bound = bounds_[i][forward ? 0 : 1];
        bound.look(moment, group, i, std::max(forward ? goal.most : -goal.least, 0.0), speed, dt);
        if (speed <= bound.value() + kRounding) continue;
        std::ostringstream out;
        out << "drive " << i << " turns its joint " << (forward ? "forward" : "backward") << " at " << speed
            << " Hz, no more than " << bound.value() << " Hz is commanded that way";
        return out.str();
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> NothingEnabledUnasked::look(const Moment& moment) {
  enabled_.resize(moment.drives.size());
  asked_.resize(moment.drives.size(), Instant{});
  unasked_.resize(moment.drives.size());
  for (const GroupWish& group : moment.groups) {
    for (const DriveIndex i : group.members) {
      if (group.asked && !group.interrupted) asked_[i] = moment.now;
      // Terminals may have enabled it: when control returns, it is on its way to rest.
      const bool enabled = moment.drives[i].state == sim::InverterState::kOperationEnabled;
      const bool before = enabled_[i];
      enabled_[i] = enabled;
      const bool by_bus = enabled && moment.drives[i].bus_control;
      if (!enabled || asked_[i] == moment.now) unasked_[i] = false;
      if (by_bus && !before && asked_[i] != moment.now) unasked_[i] = true;
      // By a word that was on its way: the next one takes it back.
      if (!by_bus || !unasked_[i] || moment.now - asked_[i] <= moment.reaction) continue;
      return "drive " + std::to_string(i) + " is \"operation enabled\", and nobody has asked for it";
    }
  }
  return std::nullopt;
}

std::optional<std::string> NobodyUnknownEnabled::look(const Moment& moment) {
  if (!moment.twin_enabled) return std::nullopt;
  return "a second drive at the address of drive 0 is \"operation enabled\"";
}

std::optional<std::string> NeverOneWheelAlone::look(const Moment& moment) {
  since_.resize(moment.groups.size());
  for (std::size_t g = 0; g < moment.groups.size(); ++g) {
    const auto& members = moment.groups[g].members;
    const auto turns = [&](DriveIndex i) { return moment.drives[i].turnsByBus(); };
    const auto moves = [&](DriveIndex i) { return turns(i) && moment.drives[i].setpoint != 0; };
    const bool some_rest = !std::all_of(members.begin(), members.end(), turns);
    const auto moving = std::find_if(members.begin(), members.end(), moves);
    if (!some_rest || moving == members.end()) {
      since_[g].reset();
      continue;
    }
    if (!since_[g]) since_[g] = moment.now;
    if (moment.now - *since_[g] <= moment.noticed_within) continue;
    std::ostringstream out;
    out << "drive " << *moving << " is told to turn for " << toSeconds(moment.now - *since_[g])
        << " s while another wheel of its base is not enabled";
    return out.str();
  }
  return std::nullopt;
}

}  // namespace nord_driver::test
