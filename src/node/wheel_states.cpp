#include "node/wheel_states.h"

#include <limits>

namespace nord_driver::node {

namespace {

WheelStates::Points pointsFor(std::size_t wheels) {
  const std::vector<double> zeros(wheels, 0.0);
  return {zeros, zeros, zeros, std::vector<double>(wheels, std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

WheelStates::WheelStates(const cycle::CycleConfig& config)
    : wheels_(config.base->wheels()), desired_(pointsFor(wheels_.size())), actual_(desired_), error_(desired_) {
  for (const DriveIndex wheel : wheels_) joints_.push_back(config.drives[wheel].joint);
}

void WheelStates::update(const cycle::CycleSnapshot& snapshot) {
  const bool first = updated_ == Instant{};
  if (!first && snapshot.time <= updated_) return;
  const double dt = first ? 0.0 : toSeconds(snapshot.time - updated_);
  updated_ = snapshot.time;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const cycle::DriveSnapshot& drive = snapshot.drives[wheels_[i]];
    desired_.accelerations[i] = first ? 0.0 : (drive.velocity_command - desired_.velocities[i]) / dt;
    desired_.velocities[i] = drive.velocity_command;
    desired_.positions[i] = first ? drive.joint_position : desired_.positions[i] + drive.velocity_command * dt;
    actual_.accelerations[i] = first ? 0.0 : (drive.velocity - actual_.velocities[i]) / dt;
    actual_.velocities[i] = drive.velocity;
    actual_.positions[i] = drive.joint_position;
    error_.positions[i] = desired_.positions[i] - actual_.positions[i];
    error_.velocities[i] = desired_.velocities[i] - actual_.velocities[i];
    error_.accelerations[i] = desired_.accelerations[i] - actual_.accelerations[i];
  }
}

}  // namespace nord_driver::node
