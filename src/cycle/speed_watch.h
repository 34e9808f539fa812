// Whether a drive turns as it is told to.
#pragma once

#include <cmath>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Compares setpoint and actual value of one drive. A drive that does not follow for long is overloaded, limited, or
/// has ramps longer than those of the commands.
class SpeedWatch {
 public:
  static constexpr double kAtSpeed = 0.02;       ///< of the maximum speed: as near counts as at speed
  static constexpr double kNotFollowing = 0.05;  ///< of the maximum speed: as far away counts as not following
  static constexpr Duration kPatience = std::chrono::seconds{3};

  /// Once a cycle. `command` and `actual` in rad/s at the joint, `maximum` the speed of 100 %. Without a maximum, and
  /// while the drive is not `enabled`, there is nothing to compare.
  void update(bool enabled, double command, double actual, double maximum, Instant now) noexcept {
    deviation_ = 0.0;
    at_speed_ = false;
    if (!enabled || !(maximum > 0.0)) {
      not_following_since_.reset();
      not_following_ = false;
      return;
    }
    deviation_ = actual - command;
    at_speed_ = std::abs(deviation_) <= kAtSpeed * maximum;
    if (std::abs(deviation_) <= kNotFollowing * maximum) {
      not_following_since_.reset();
    } else if (!not_following_since_) {
      not_following_since_ = now;
    }
    not_following_ = not_following_since_ && now - *not_following_since_ >= kPatience;
  }

  double deviation() const noexcept { return deviation_; }  ///< rad/s, actual minus command; 0 while not enabled
  bool atSpeed() const noexcept { return at_speed_; }
  /// Far from its command for kPatience without a break.
  bool isNotFollowing() const noexcept { return not_following_; }

 private:
  double deviation_ = 0.0;
  bool at_speed_ = false;
  bool not_following_ = false;
  std::optional<Instant> not_following_since_;
};

}  // namespace nord_driver::cycle
