#include "campaign/motion_invariants.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nord_driver::test {

namespace {

constexpr double kRounding = 0.1;         // Hz: a setpoint is a share of 16384, DeviceNet's of 1500 rpm or 0.1 Hz
constexpr double kAtRest = kRounding;     // nobody can tell less from nothing
constexpr std::size_t kRemembered = 600;  // changes, one in a cycle at most: longer than any reaction

bool turnsByTerminals(const DriveTruth& drive) {
  return drive.state == sim::InverterState::kOperationEnabled && !drive.bus_control;
}

}  // namespace

std::optional<std::string> TurnsOnlyAsCommanded::look(const Moment& moment) {
  tracks_.resize(moment.drives.size());
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  for (const GroupWish& group : moment.groups) {
    const bool cut =
        std::any_of(group.members.begin(), group.members.end(), [&](DriveIndex i) { return moment.cut[i]; });
    for (const DriveIndex i : group.members) {
      const DriveTruth& drive = moment.drives[i];
      Track& track = tracks_[i];
      const double speed = std::fabs(drive.frequency);
      // Interrupted, it may follow new commands until the time-outs act.
      if (!cut) track.cut_since.reset();
      if (cut && !track.cut_since) track.cut_since = moment.now;
      const Instant heard = track.cut_since.value_or(moment.now);
      const double allowed = group.asked && moment.now <= heard + moment.reaction ? std::fabs(moment.wanted[i]) : 0.0;
      // The same again: what was allowed last for so long.
      if (!track.allowed.empty() && track.allowed.back().second == allowed) track.allowed.pop_back();
      track.allowed.emplace_back(heard, allowed);
      while (track.allowed.size() > kRemembered) track.allowed.pop_front();
      double recent = 0.0;
      for (const auto& [from, value] : track.allowed) {
        if (moment.now <= from + moment.reaction) recent = std::max(recent, value);
      }
      track.bound = std::max(recent, track.bound - drive.ramp * dt);
      // Terminals turn it as they like, and their ramp follows them down.
      if (turnsByTerminals(drive)) track.bound = std::max(track.bound, speed);
      if (speed > track.bound + kRounding) {
        std::ostringstream out;
        out << "drive " << i << ": " << drive.frequency << " Hz, no more than " << track.bound << " Hz is commanded";
        return out.str();
      }
      const bool by_terminals = turnsByTerminals(drive);  // that is no stop of ours
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
        track.stop_bound = std::max(track.stop_bound, track.stop_took + (track.bound + kRounding) / drive.ramp);
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> NothingEnabledUnasked::look(const Moment& moment) {
  enabled_.resize(moment.drives.size());
  asked_.resize(moment.drives.size(), Instant{});
  for (const GroupWish& group : moment.groups) {
    for (const DriveIndex i : group.members) {
      if (group.asked) asked_[i] = moment.now;
      // Terminals may have enabled it: when control returns, it is on its way to rest.
      const bool enabled = moment.drives[i].state == sim::InverterState::kOperationEnabled;
      const bool before = enabled_[i];
      enabled_[i] = enabled;
      const bool by_bus = enabled && moment.drives[i].bus_control;
      if (!by_bus || before || moment.now - asked_[i] <= moment.reaction) continue;
      return "drive " + std::to_string(i) + " is \"operation enabled\", and nobody has asked for it";
    }
  }
  return std::nullopt;
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
    if (moment.now - *since_[g] <= moment.reaction) continue;
    std::ostringstream out;
    out << "drive " << *moving << " is told to turn for " << toSeconds(moment.now - *since_[g])
        << " s while another wheel of its base is not enabled";
    return out.str();
  }
  return std::nullopt;
}

}  // namespace nord_driver::test
