#include "cycle/command_watch.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nord_driver::cycle {

namespace {

constexpr const char* kOlderThanCmdVelTimeout = ", or wait until it is older than cmd_vel_timeout";

/// `way`: out of a refusal, by waiting. None where commands never grow old.
const char* orWait(Duration timeout, const char* way) noexcept {
  return timeout > Duration::zero() ? way : "";
}

}  // namespace

CommandWatch::CommandWatch(CyclePorts& ports, Duration cmd_vel_timeout, bool has_base, std::vector<std::string> names,
                           std::vector<bool> of_base)
    : ports_(ports),
      cmd_vel_timeout_(cmd_vel_timeout),
      listening_time_(std::max(cmd_vel_timeout, kLeast)),
      has_base_(has_base),
      names_(std::move(names)),
      of_base_(std::move(of_base)),
      all_(names_.size()) {
  std::iota(all_.begin(), all_.end(), DriveIndex{0});
}

void CommandWatch::watch(DriveIndex drive, std::size_t index, const SetpointSetup& setpoint) {
  setpoints_.push_back({drive, index, setpoint});
}

CommandState CommandWatch::look(Instant now) noexcept {
  if (!since_) since_ = now;
  CommandState state;
  state.moving = movingOf(all_, has_base_, now);
  state.heard = std::max(Duration::zero(), now - std::max(*since_, ports_.newestCommander()));
  state.to_hear = std::max(Duration::zero(), listening_time_ - state.heard);
  state.quiet = state.moving.empty() && state.to_hear == Duration::zero() && !movedWithin(listening_time_, now);
  return state;
}

bool CommandWatch::movedWithin(Duration span, Instant now) noexcept {
  const auto recent = [&](const auto& command) { return command.moved && now - *command.moved < span; };
  if (has_base_ && recent(ports_.newestBaseCommand())) return true;
  for (DriveIndex i = 0; i < names_.size(); ++i) {
    if (!of_base_[i] && recent(ports_.newestDriveCommand(i))) return true;
  }
  for (const Watched& watched : setpoints_) {
    if (recent(ports_.newestWords(watched.drive).setpoints[watched.index])) return true;
  }
  return false;
}

Sentence CommandWatch::movingOf(const std::vector<DriveIndex>& drives, bool base, Instant now) noexcept {
  if (base) {
    const Sentence text = movingBase(now);
    if (!text.empty()) return text;
  }
  for (const DriveIndex i : drives) {
    const Sentence text = movingDrive(i, now);
    if (!text.empty()) return text;
  }
  for (const Watched& watched : setpoints_) {
    if (std::find(drives.begin(), drives.end(), watched.drive) == drives.end()) continue;
    const Sentence text = movingSetpoint(watched, now);
    if (!text.empty()) return text;
  }
  return {};
}

bool CommandWatch::moves(const TwistCommand& base, Instant now) const noexcept {
  return !isStale(base, cmd_vel_timeout_, now) && !(base.twist == robot::Twist2d{});
}

Sentence CommandWatch::movingBase(Instant now) noexcept {
  Sentence text;
  const TwistCommand& base = ports_.newestBaseCommand();
  if (!moves(base, now)) return text;
  Sentence sideways;
  if (base.twist.linear_y != 0.0) sideways.format("%.3f m/s to the left, ", base.twist.linear_y);
  text.format("the newest cmd_vel is not zero (%.3f m/s, %s%.3f rad/s, %.2f s old): send zero first%s",
              base.twist.linear_x, sideways.c_str(), base.twist.angular_z, toSeconds(now - base.received),
              orWait(cmd_vel_timeout_, kOlderThanCmdVelTimeout));
  return text;
}

Sentence CommandWatch::movingDrive(DriveIndex drive, Instant now) noexcept {
  Sentence text;
  const JointCommand& joint = ports_.newestDriveCommand(drive);
  if (of_base_[drive] || isStale(joint, cmd_vel_timeout_, now) || joint.velocity == 0.0) return text;
  text.format("the newest command of drive %s is not zero (%.3f rad/s): send zero first%s", names_[drive].c_str(),
              joint.velocity, orWait(cmd_vel_timeout_, kOlderThanCmdVelTimeout));
  return text;
}

Sentence CommandWatch::movingSetpoint(const Watched& watched, Instant now) noexcept {
  Sentence text;
  const WordCommand& command = ports_.newestWords(watched.drive).setpoints[watched.index];
  if (isStale(command, watched.setup.timeout, now) || command.value == 0.0) return text;
  text.format("the newest setpoint %s of drive %s is not zero (%.3f) and can turn its motor: send zero first%s",
              watched.setup.name.c_str(), names_[watched.drive].c_str(), command.value,
              orWait(watched.setup.timeout, ", or wait until it is older than its timeout"));
  return text;
}

}  // namespace nord_driver::cycle
