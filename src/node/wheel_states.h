// What was wanted of the wheels of the base and what they do, as diff_drive_controller tells it.
#pragma once

#include <string>
#include <vector>

#include "cycle/cycle_config.h"
#include "cycle/snapshot.h"

namespace nord_driver::node {

/// Positions are rad, velocities rad/s, accelerations rad/s^2, all at the joint: one of each for every wheel of the
/// base, the left ones first. The wanted position is the sum of the wanted velocities since the first snapshot. Efforts
/// are NaN, since a frequency inverter does not tell its torque.
class WheelStates {
 public:
  struct Points {
    std::vector<double> positions, velocities, accelerations, efforts;
  };

  /// `config` has a base.
  explicit WheelStates(const cycle::CycleConfig& config);

  /// The next snapshot; one that was seen before changes nothing.
  void update(const cycle::CycleSnapshot& snapshot);

  const std::vector<std::string>& joints() const { return joints_; }
  const Points& desired() const { return desired_; }
  const Points& actual() const { return actual_; }
  /// Desired minus actual.
  const Points& error() const { return error_; }

 private:
  std::vector<DriveIndex> wheels_;
  std::vector<std::string> joints_;
  Points desired_, actual_, error_;
  Instant updated_{};  // the snapshot before; none yet: the epoch
};

/// Into a control_msgs/JointTrajectoryControllerState. A template: not every system has that package.
template <typename Message>
void fill(Message& message, const WheelStates& states) {
  const auto copy = [](auto& point, const WheelStates::Points& from) {
    point.positions = from.positions;
    point.velocities = from.velocities;
    point.accelerations = from.accelerations;
    point.effort = from.efforts;
  };
  message.joint_names = states.joints();
  copy(message.desired, states.desired());
  copy(message.actual, states.actual());
  copy(message.error, states.error());
}

}  // namespace nord_driver::node
