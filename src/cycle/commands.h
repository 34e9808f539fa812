// The newest velocity commands of those outside, with the time they came.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "robot/twist.h"

namespace nord_driver::cycle {

struct TwistCommand {
  robot::Twist2d twist;
  Instant received{};
  bool given = false;                 ///< false until the first command
  std::optional<Instant> moved = {};  ///< when the newest that was not zero came; CyclePorts keeps it
  /// Nobody knows whom to follow: the base brakes as without one. For whoever wants to enable it is what it says.
  bool held = false;
};

/// For a drive that belongs to no base.
struct JointCommand {
  double velocity = 0.0;  ///< rad/s at the joint
  Instant received{};
  bool given = false;
  std::optional<Instant> moved = {};  ///< as that of TwistCommand
};

/// For a drive that positions. It does not grow old; each is taken once. The newest target counts, and after it the sum
/// of its increments: of two that come within one cycle none is lost.
struct PositionCommand {
  double target = 0.0;                  ///< rad or m of the joint
  std::optional<std::uint8_t> element;  ///< of the drive's array, in place of `target`
  std::uint64_t number = 0;             ///< counts the targets of this drive from 1; 0: none yet
  double increments = 0.0;              ///< rad or m: the sum of those that came after this target
  std::uint64_t increased = 0;          ///< counts the increments of this drive from 1; 0: none yet
};

/// Corrections of the base's sizes, changed while the node runs.
struct BaseTuning {
  double wheel_separation_multiplier = 1.0;
  double left_wheel_radius_multiplier = 1.0;
  double right_wheel_radius_multiplier = 1.0;
  bool given = false;  ///< false until somebody changes them
};

/// No longer valid at `now`: never given, or older than `timeout`. A timeout of zero never ends.
template <typename Command>
bool isStale(const Command& command, Duration timeout, Instant now) noexcept {
  if (!command.given) return true;
  return timeout > Duration::zero() && now - command.received > timeout;
}

}  // namespace nord_driver::cycle
