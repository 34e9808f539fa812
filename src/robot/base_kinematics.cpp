#include "robot/base_kinematics.h"

#include <stdexcept>
#include <string>

#include "robot/diff_drive_kinematics.h"
#include "robot/mecanum_kinematics.h"

namespace nord_driver::robot {

const char* nameOf(BaseKind kind) noexcept {
  switch (kind) {
    case BaseKind::kDifferential:
      return "differential";
    case BaseKind::kMecanum:
      return "mecanum";
    case BaseKind::kSteered:
      return "steered";
  }
  return "";
}

std::unique_ptr<BaseKinematics> makeKinematics(BaseKind kind, const BaseGeometry& geometry, std::size_t left_wheels,
                                               std::size_t right_wheels) {
  if (kind == BaseKind::kDifferential) {
    return std::make_unique<DiffDriveKinematics>(geometry, left_wheels, right_wheels);
  }
  if (kind == BaseKind::kSteered) {
    throw std::invalid_argument("a steered base has axles, expected a kind with left and right wheels");
  }
  if (left_wheels != 2 || right_wheels != 2) {
    throw std::invalid_argument("a mecanum base has " + std::to_string(left_wheels) + " wheels in left_wheel and " +
                                std::to_string(right_wheels) +
                                " in right_wheel, expected two in each, the front one first");
  }
  return std::make_unique<MecanumKinematics>(geometry);
}

}  // namespace nord_driver::robot
