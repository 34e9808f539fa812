#include "campaign/position_invariants.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "campaign/axes.h"

namespace nord_driver::test {

namespace {

constexpr double kSpare = 1.05;  // the speed controller of the axis, beside its path
constexpr double kAtRest = 0.1;  // Hz of the rotor, 0.05 revolutions a second: it settles
constexpr double kThere = 3.0 * kAxisStep;
constexpr double kBeyond = 0.02;                        // rad, 0.06 revolutions of the motor
constexpr Duration kAnother = std::chrono::seconds{3};  // until the first one is heard and believed again
constexpr Duration kSettles = std::chrono::milliseconds{500};
constexpr double kHertzPerRadian = 2.0 * kRevolutionsPerRadian;  // rad/s of the joint, two pole pairs

bool isDriven(const DriveTruth& drive) {
  return drive.turnsByBus();
}

bool mayBe(double target) {
  return target >= -kAxisLimit && target <= kAxisLimit;
}

const GroupWish& groupOf(const Moment& moment, DriveIndex drive) {
  return *std::find_if(moment.groups.begin(), moment.groups.end(), [&](const GroupWish& group) {
    return std::find(group.members.begin(), group.members.end(), drive) != group.members.end();
  });
}

template <typename Tracks>
void provide(Tracks& tracks, const Moment& moment) {
  if (tracks.size() != moment.axes.size()) tracks.resize(moment.axes.size());
}

}  // namespace

std::optional<std::string> AxisMovesOnlyAsAsked::look(const Moment& moment) {
  provide(tracks_, moment);
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  for (DriveIndex i = 0; i < moment.axes.size(); ++i) {
    const AxisWish& wish = moment.axes[i];
    if (!wish.is_axis) continue;
    const DriveTruth& drive = moment.drives[i];
    const GroupWish& group = groupOf(moment, i);
    Track& track = tracks_[i];
    const double speed = std::fabs(drive.rotor);
    if (moment.driver_ran && moment.snapshot != nullptr && wish.asked.empty()) {
      const std::optional<double>& target = moment.snapshot->drives[i].position_target;
      if (target && std::fabs(drive.position - *target) < kThere && speed < kAtRest) track.goal = false;
    }
    track.goal = track.goal || std::any_of(wish.asked.begin(), wish.asked.end(),
                                           [](const AskedMove& move) { return move.onward || mayBe(move.value); });
    track.goal = track.goal && group.asked;
    const bool may = track.goal || (group.asked && wish.homing);
    track.bound.look(moment, moment.cut[i], may ? kSpare * kAxisHertz : 0.0, drive.ramp, dt);
    const bool driven = isDriven(drive);
    // Nobody moves it, or its terminals do. One that turns when it is enabled is brought to rest, and back to where it was.
    if (!driven) track.bound.raise(speed);
    if (driven && !track.driven) {
      track.caught = speed;
      track.calm = moment.now + seconds(2.0 * speed / drive.ramp) + kSettles;
    }
    track.driven = driven;
    if (driven && moment.now < track.calm) track.bound.raise(track.caught);
    if (speed <= track.bound.value() + kAtRest) continue;
    std::ostringstream out;
    out << "drive " << i << ": its rotor turns at " << drive.rotor << " Hz, no more than " << track.bound.value()
        << " Hz was asked for";
    return out.str();
  }
  return std::nullopt;
}

std::optional<std::string> AxisWithinItsLimits::look(const Moment& moment) {
  provide(tracks_, moment);
  for (DriveIndex i = 0; i < moment.axes.size(); ++i) {
    const AxisWish& wish = moment.axes[i];
    if (!wish.is_axis) continue;
    const DriveTruth& drive = moment.drives[i];
    Track& track = tracks_[i];
    const double beyond = std::max(0.0, std::fabs(drive.position) - kAxisLimit);
    const double speed = drive.rotor / kHertzPerRadian;
    const double brakes = beyond + speed * speed * kHertzPerRadian / (2.0 * drive.ramp);
    const bool led = isDriven(drive) && groupOf(moment, i).asked && !wish.homing;
    if (!led || !track.led) track.led_since = moment.now;
    track.led = led;
    // A stop, or a reference run, may still be on its way to the inverter, or have brought it to where it is caught.
    if (!led || moment.now - track.led_since <= moment.reaction + kSettles) {
      track.brought = brakes;
      continue;
    }
    if (beyond > track.brought + kBeyond) {
      std::ostringstream out;
      out << "drive " << i << " is led to " << drive.position << " rad, " << beyond << " rad beyond its limit";
      return out.str();
    }
    track.brought = std::min(track.brought, brakes);
  }
  return std::nullopt;
}

std::optional<std::string> AxisTargetsCount::look(const Moment& moment) {
  if (!moment.driver_ran || !moment.judged) return std::nullopt;
  expected_.resize(moment.axes.size());
  for (DriveIndex i = 0; i < moment.axes.size(); ++i) {
    const AxisWish& wish = moment.axes[i];
    const cycle::DriveSnapshot& drive = moment.snapshot->drives[i];
    std::optional<double>& expected = expected_[i];
    const bool goes_on = expected && drive.enabled && drive.position_target && !wish.homing;
    if (!wish.is_axis || !goes_on) {
      expected.reset();
      if (wish.is_axis && drive.enabled && !wish.homing) expected = drive.position_target;
      continue;
    }
    // As the driver takes them: the newest target, and what was added to it since.
    const auto newest =
        std::find_if(wish.asked.rbegin(), wish.asked.rend(), [](const AskedMove& m) { return !m.onward; });
    if (newest != wish.asked.rend() && mayBe(newest->value)) expected = newest->value;
    double onward = 0.0;
    for (auto move = newest.base(); move != wish.asked.end(); ++move) onward += move->value;
    if (mayBe(*expected + onward)) *expected += onward;
    if (std::fabs(*drive.position_target - *expected) <= kThere) continue;
    std::ostringstream out;
    out << "drive " << i << ": the target is " << *drive.position_target << " rad, and what was asked for leads to "
        << *expected << " rad";
    return out.str();
  }
  return std::nullopt;
}

std::optional<std::string> AxisPositionTrue::look(const Moment& moment) {
  provide(tracks_, moment);
  for (DriveIndex i = 0; i < moment.axes.size(); ++i) {
    if (!moment.axes[i].is_axis) continue;
    const DriveTruth& drive = moment.drives[i];
    Track& track = tracks_[i];
    track.run_asked = track.run_asked || moment.axes[i].homing;
    if (track.zero && std::fabs(*track.zero - drive.zero) > 1e-6) {
      if (!track.run_asked) return "drive " + std::to_string(i) + ": its count got a new zero, and nobody has asked";
      track.new_zero = true;
      track.truth.clear();
    }
    track.zero = drive.zero;
    // It has the same identity: that another one answers cannot be seen.
    if (i == 0 && moment.twin_position) {
      track.truth.emplace_back(moment.now, *moment.twin_position);
      track.another = moment.now;
    }
    track.truth.emplace_back(moment.now, drive.position);
    while (track.truth.front().first < moment.now - moment.reaction - moment.period) track.truth.pop_front();
    if (!moment.driver_ran || !moment.judged) continue;
    if (auto wrong = judge(moment, i, track)) return wrong;
  }
  return std::nullopt;
}

std::optional<std::string> AxisPositionTrue::judge(const Moment& moment, std::size_t i, Track& track) {
  const cycle::DriveSnapshot& drive = moment.snapshot->drives[i];
  // How far it may be from where it was at a look, in a cycle.
  const double near = moment.full_wheel_speed * toSeconds(moment.period) + 2.0 * kAxisStep;
  const auto wasAt = [&](double place, double tolerance) {
    return std::any_of(track.truth.begin(), track.truth.end(),
                       [&](const auto& at) { return std::fabs(at.second - place) <= tolerance; });
  };
  // Between two looks it may have passed.
  const auto passed = [&](double place, double tolerance) {
    if (wasAt(place, tolerance)) return true;
    const auto crosses = [&](const auto& from, const auto& to) { return (from.second < place) != (to.second < place); };
    return std::adjacent_find(track.truth.begin(), track.truth.end(), crosses) != track.truth.end();
  };
  std::ostringstream out;
  out << "drive " << i;
  const bool told = drive.position && !drive.position_held_back;
  const bool is_true = told && wasAt(*drive.position, near);
  if (told && !is_true && !track.new_zero) {
    out << " is told to be at " << *drive.position << " rad, and is at " << track.truth.back().second;
    return out.str();
  }
  if (drive.joint_known && track.told) {
    const double way =
        kSpare * moment.full_wheel_speed * toSeconds(moment.now - track.fresh + moment.period) + 2.0 * kAxisStep;
    const bool by_the_run = track.new_zero && is_true;
    const bool by_another = track.another && moment.now - *track.another <= kAnother && is_true;
    if (std::fabs(drive.joint_position - *track.told) > way && !by_the_run && !by_another) {
      out << ": its joint jumps from " << *track.told << " to " << drive.joint_position << " rad in "
          << toSeconds(moment.now - track.fresh) << " s";
      return out.str();
    }
  }
  if (is_true) track.new_zero = false;
  // Within drive_timeout one that is not heard is told to be where it was last.
  const auto last_there = std::find_if(track.truth.rbegin(), track.truth.rend(), [&](const auto& at) {
    return told && std::fabs(at.second - *drive.position) <= near;
  });
  if (last_there != track.truth.rend()) track.fresh = last_there->first;
  if (drive.joint_known && (told || !track.told)) track.told = drive.joint_position;
  if (drive.position_reached &&
      !(drive.enabled && drive.position_target && passed(*drive.position_target, kAxisTolerance + 2.0 * kAxisStep))) {
    out << " is said to have reached its target, and is at " << track.truth.back().second << " rad";
    return out.str();
  }
  return std::nullopt;
}

}  // namespace nord_driver::test
