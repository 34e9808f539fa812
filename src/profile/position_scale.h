// A joint's position in the steps the drive counts, and back.
#pragma once

#include <cstdint>
#include <optional>

#include "profile/position_words.h"

namespace nord_driver::profile {

/// The drive counts revolutions of the shaft its encoder sits on, or whatever P607 and P608 make of them (BU 2700
/// 6.4.4).
struct PositionScale {
  /// Counted revolutions in a radian or metre of the joint; negative where they count down when the joint goes up. Not 0.
  double revolutions_per_unit = 1.0;
  double offset = 0.0;  ///< rad or m: the joint's position where the drive counts 0
  /// Steps in a revolution; none: what the function of the words says.
  std::optional<double> steps_per_revolution;
};

/// The most revolutions a position has, either way (BU 0020 7.3.5).
constexpr double kMaxRevolutions = 50'000.0;

double stepsPerRevolution(const PositionScale& scale, const PositionField& field) noexcept;

/// rad or m.
double toJoint(std::int64_t steps, const PositionScale& scale, const PositionField& field) noexcept;

/// The nearest step. None: no number, or beyond what the field and the drive can have.
std::optional<std::int32_t> toSteps(double joint, const PositionScale& scale, const PositionField& field) noexcept;

/// P613, the array of positions: 32 bits of 0.001 revolutions (BU 0020 7.3.5, 7.5.2).
constexpr PositionField kArrayField{32, 0, 1, 1000};
/// Of an element, for toJoint() and toSteps() beside kArrayField: its steps are what they are, whatever the words count.
PositionScale arrayScale(const PositionScale& scale) noexcept;

/// Whether a position can be a setpoint in this field: of 16 bits -32768 to 32767 steps, of 32 bits +-50 000 revolutions
/// (BU 0020 7.3.5).
bool isInRange(std::int64_t steps, const PositionScale& scale, const PositionField& field) noexcept;

}  // namespace nord_driver::profile
