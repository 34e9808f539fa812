#include "robot/steered_reach.h"

namespace nord_driver::robot {

SteeredReach::SteeredReach(const SteeredAxles& axles) : kinematics_(axles) {
  straight_.resize(axles.size());
}

WheelSpeeds SteeredReach::wheels(const Twist2d& twist) const noexcept {
  return kinematics_.solve(kinematics_.possible(twist), straight_, straight_).wheels;
}

}  // namespace nord_driver::robot
