#include "campaign/following_invariants.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nord_driver::test {

namespace {

constexpr double kRounding = 0.15;      // Hz: a setpoint is a share of 16384, DeviceNet's of 1500 rpm or 0.1 Hz
constexpr double kSpare = 0.02;         // of a ramp: time of the cycles against that of the inverter's own steps
constexpr double kPoseRounding = 1e-6;  // m and rad, of one cycle
constexpr double kFullHertz = 50.0;     // at full_wheel_speed
constexpr unsigned kMeasurements = 4;   // until a pose goes on behind a gap

// Without P105 of the set in use no speed can be told.
bool isScaled(const Moment& moment, const cycle::DriveSnapshot& told) {
  if (!told.online || !told.device.complete) return false;
  const auto& maximum = told.device.max_frequency;
  const unsigned set = told.parameter_set;
  return !moment.reads_scale || (set >= 1 && set <= maximum.size() && maximum[set - 1]);
}

// The base of a wheel, or the drive itself.
bool isToldEnabled(const Moment& moment, std::size_t drive) {
  const auto& base = moment.groups.front();
  const bool wheel = base.is_base && drive < base.members.size();
  return wheel ? moment.snapshot->base.enabled : moment.snapshot->drives[drive].enabled;
}

// What follows `goal` by `slow` to `fast` in this step.
const Span& follow(Span& span, const Span& goal, double slow, double fast) {
  span.least =
      goal.least < span.least ? std::max(goal.least, span.least - fast) : std::min(goal.least, span.least + slow);
  span.most = goal.most > span.most ? std::min(goal.most, span.most + fast) : std::max(goal.most, span.most - slow);
  return span;
}

}  // namespace

std::optional<std::string> FollowsItsCommand::look(const Moment& moment) {
  tracks_.resize(moment.drives.size());
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  for (const GroupWish& group : moment.groups) {
    if (group.is_axis) continue;
    const bool told = moment.snapshot != nullptr && isToldEnabled(moment, group.members.front());
    // Beyond P105 the base is scaled, which is for other tests.
    const bool follows = group.asked && group.confirmed && told && moment.judged &&
                         std::all_of(group.members.begin(), group.members.end(), [&](DriveIndex i) {
                           return moment.drives[i].turnsByBus() && moment.drives[i].slowest == 0.0 &&
                                  !(i == 0 && moment.stand_in_believed) &&
                                  std::fabs(moment.wanted[i]) <= moment.drives[i].full;
                         });
    for (const DriveIndex i : group.members) {
      const DriveTruth& drive = moment.drives[i];
      Track& track = tracks_[i];
      if (!follows) {
        track.speed = {drive.along, drive.along};
        track.setpoint = {std::min(drive.along, drive.told), std::max(drive.along, drive.told)};
        track.wanted.forget();
        track.wanted.add(moment.now, track.setpoint);
        track.sent.forget();
        track.sent.add(moment.now, track.setpoint);
        continue;
      }
      // One that is not renewed may be one from before it was enabled, which is not obeyed.
      const Span wanted = moment.wantedOf(i);
      track.wanted.add(moment.now,
                       moment.renewed[i] ? wanted : Span{std::min(wanted.least, 0.0), std::max(wanted.most, 0.0)});
      const SetpointRamp& ramp = moment.setpoint_ramps[i];
      const Span goal = track.wanted.since(moment.now - ramp.longest);
      // A driver that is held up need not catch up with its ramp: it goes on from where it was (SetpointWithinRamp).
      const double slowest = moment.driver_ran ? ramp.slowest : 0.0;
      track.sent.add(moment.now,
                     follow(track.setpoint, goal, (1.0 - kSpare) * slowest * dt, (1.0 + kSpare) * ramp.fastest * dt));
      const Span setpoint = track.sent.since(moment.now - moment.heard_within - moment.period);
      const Span& speed = follow(track.speed, setpoint, (1.0 - kSpare) * std::min(drive.rise, drive.ramp) * dt,
                                 (1.0 + kSpare) * std::max(drive.rise, drive.ramp) * dt);
      if (drive.along >= speed.least - kRounding && drive.along <= speed.most + kRounding) continue;
      std::ostringstream out;
      out << "drive " << i << " turns its joint with " << drive.along << " Hz, commanded are " << moment.wanted[i]
          << " Hz: it is between " << speed.least << " and " << speed.most << " Hz";
      return out.str();
    }
  }
  return std::nullopt;
}

std::optional<std::string> SetpointWithinRamp::look(const Moment& moment) {
  if (moment.snapshot == nullptr) return std::nullopt;
  tracks_.resize(moment.drives.size());
  for (std::size_t i = 0; i < moment.drives.size(); ++i) {
    const double fastest = moment.setpoint_ramps[i].fastest;
    if (moment.axes[i].is_axis || fastest == SetpointRamp::kAtOnce) continue;
    const DriveTruth& drive = moment.drives[i];
    Track& track = tracks_[i];
    const Track before = track;
    // What P105 stands for is another one, as soon as another parameter set is used.
    const bool scaled = drive.full == before.full && !(i == 0 && moment.stand_in_believed);
    track.turned = drive.turnsByBus() && scaled;
    track.full = drive.full;
    if (track.turned && before.turned && drive.told == before.told) continue;
    track.since = moment.now;
    track.told = drive.told;
    if (!track.turned || !before.turned) continue;
    // The one before may have been on its way for as long as words take.
    const double time = toSeconds(moment.now - before.since + moment.heard_within);
    const double change = std::fabs(drive.told - before.told);
    if (change <= fastest * time + kRounding) continue;
    // Below its slowest speed it rests, by OFF1.
    if (drive.slowest > 0.0 && (drive.told == 0.0 || before.told == 0.0)) continue;
    // A group that the driver has stopped is told 0 at once, and follows the ramps of its drives.
    if (drive.told == 0.0 && !isToldEnabled(moment, i)) continue;
    std::ostringstream out;
    out << "drive " << i << " is told " << drive.told << " Hz " << toSeconds(moment.now - before.since) << " s after "
        << before.told << " Hz: its ramp is " << fastest << " Hz/s";
    return out.str();
  }
  return std::nullopt;
}

std::optional<std::string> MotionToldAsItIs::look(const Moment& moment) {
  tracks_.resize(moment.drives.size());
  const double dt = last_ ? toSeconds(moment.now - *last_) : 0.0;
  last_ = moment.now;
  const double speed_of = moment.full_wheel_speed / kFullHertz;
  const Duration within = moment.told_within + 2 * moment.period;
  for (std::size_t i = 0; i < moment.drives.size(); ++i) {
    Track& track = tracks_[i];
    const DriveTruth& drive = moment.drives[i];
    track.turned.add(moment.now, {drive.actual(), drive.actual()});
    track.way += drive.actual() * speed_of * dt;
    // While another one stands at its address, that one may be told of; its P105 as long as nobody saw it leave.
    const bool is_doubled = i == 0 && (moment.twin_position.has_value() || moment.stand_in_believed);
    if (!moment.driver_ran || !moment.judged || moment.axes[i].is_axis || is_doubled) {
      track.answered = 0;
      continue;
    }
    const cycle::DriveSnapshot& told = moment.snapshot->drives[i];
    if (!isScaled(moment, told)) {
      track.answered = 0;
      continue;
    }
    if (track.answered++ == 0) {
      track.way = track.fastest = 0.0;
      track.joint_from = told.joint_position;
    }
    const Span turned = track.turned.since(moment.now - within);
    track.fastest = std::max({track.fastest, speed_of * std::fabs(turned.least), speed_of * std::fabs(turned.most)});
    // Between two looks it may have been faster or slower.
    const double spare_speed = kRounding + std::max(drive.rise, drive.ramp) * toSeconds(moment.period);
    if (told.velocity < speed_of * (turned.least - spare_speed) ||
        told.velocity > speed_of * (turned.most + spare_speed)) {
      std::ostringstream out;
      out << "joint " << i << " is told with " << told.velocity << " rad/s, its drive turned it with "
          << speed_of * turned.least << " to " << speed_of * turned.most << " rad/s";
      return out.str();
    }
    const double way = told.joint_position - track.joint_from;
    const double spare =
        track.fastest * toSeconds(within) + speed_of * kRounding * track.answered * toSeconds(moment.period);
    if (std::fabs(way - track.way) > spare + kPoseRounding) {
      std::ostringstream out;
      out << "joint " << i << " is told to have turned " << way << " rad, it has turned " << track.way << " rad";
      return out.str();
    }
  }
  return std::nullopt;
}

std::optional<std::string> PoseAsTheWheels::look(const Moment& moment) {
  if (!moment.driver_ran || !moment.judged || moment.groups.empty() || !moment.groups.front().is_base)
    return std::nullopt;
  const auto& wheels = moment.groups.front().members;
  const cycle::CycleSnapshot& snapshot = *moment.snapshot;
  const robot::Pose2d before = pose_;
  const std::vector<double> joints_before = joints_;
  pose_ = snapshot.base.pose;
  joints_.clear();
  for (const DriveIndex i : wheels) joints_.push_back(snapshot.drives[i].joint_position);
  const unsigned answered_before = answered_;
  const bool all_answer =
      std::all_of(wheels.begin(), wheels.end(), [&](DriveIndex i) { return isScaled(moment, snapshot.drives[i]); });
  answered_ = all_answer && snapshot.base.known ? answered_ + 1 : 0;
  // Behind a gap the pose begins anew.
  if (joints_before.empty() || moment.odometry_reset || answered_ == 0 || answered_before < kMeasurements)
    return std::nullopt;
  double left = 0.0, right = 0.0;  // m
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    (k % 2 == 0 ? left : right) +=
        2.0 * kWheelRadius * (joints_[k] - joints_before[k]) / static_cast<double>(joints_.size());
  }
  const double turn = std::remainder(pose_.heading - before.heading, 2.0 * M_PI);
  const double step = std::hypot(pose_.x - before.x, pose_.y - before.y);
  const double turned = (right - left) / kSeparation;
  const double arc = std::fabs(left + right) / 2.0;
  // Along the arc or its chord.
  const double chord_spare = arc * turned * turned;
  if (std::fabs(turn - turned) <= kPoseRounding && std::fabs(step - arc) <= kPoseRounding + chord_spare)
    return std::nullopt;
  std::ostringstream out;
  out << "the pose goes " << step << " m and " << turn << " rad, the wheels " << arc << " m and " << turned << " rad";
  return out.str();
}

}  // namespace nord_driver::test
