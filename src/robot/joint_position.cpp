#include "robot/joint_position.h"

#include <cmath>

namespace nord_driver::robot {

void JointPosition::update(double velocity, Duration dt) noexcept {
  if (!std::isfinite(velocity)) return;
  const double time = toSeconds(dt);
  if (has_last_ && time > 0.0) position_ += (velocity_ + velocity) / 2.0 * time;
  velocity_ = velocity;
  has_last_ = true;
}

void JointPosition::rebase() noexcept {
  velocity_ = 0.0;
  has_last_ = false;
}

}  // namespace nord_driver::robot
