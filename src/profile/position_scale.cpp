#include "profile/position_scale.h"

#include <cmath>

namespace nord_driver::profile {

double stepsPerRevolution(const PositionScale& scale, const PositionField& field) noexcept {
  return scale.steps_per_revolution.value_or(field.steps_per_revolution);
}

PositionScale arrayScale(const PositionScale& scale) noexcept {
  PositionScale thousandths = scale;
  thousandths.steps_per_revolution = double{kArrayField.steps_per_revolution};
  return thousandths;
}

double toJoint(std::int64_t steps, const PositionScale& scale, const PositionField& field) noexcept {
  const double revolutions = static_cast<double>(steps) / stepsPerRevolution(scale, field);
  return revolutions / scale.revolutions_per_unit + scale.offset;
}

bool isInRange(std::int64_t steps, const PositionScale& scale, const PositionField& field) noexcept {
  if (!field.carried()) return false;
  if (field.bits == 16) return steps >= -32768 && steps <= 32767;
  const double most = kMaxRevolutions * stepsPerRevolution(scale, field);
  return std::fabs(static_cast<double>(steps)) <= most && steps >= INT32_MIN && steps <= INT32_MAX;
}

std::optional<std::int32_t> toSteps(double joint, const PositionScale& scale, const PositionField& field) noexcept {
  const double steps = (joint - scale.offset) * scale.revolutions_per_unit * stepsPerRevolution(scale, field);
  // Before the conversion, which is defined within 64 bits only.
  if (!std::isfinite(steps) || std::fabs(steps) > 4e9) return std::nullopt;
  const std::int64_t nearest = std::llround(steps);
  if (!isInRange(nearest, scale, field)) return std::nullopt;
  return static_cast<std::int32_t>(nearest);
}

}  // namespace nord_driver::profile
