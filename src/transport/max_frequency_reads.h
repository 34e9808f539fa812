// P105 (maximum frequency) of parameter set 1 as it comes by on its way to the drive layer: what translates revolutions
// per minute into shares of it must use the same value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/units.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver {

/// Only what the drive layer itself reads counts: what a user reads while the drive layer commands shares of another
/// P105 (somebody wrote it at the keypad) would be a step of the speed.
///
/// `Capacity`: of the requests under way.
template <std::size_t Capacity>
class MaxFrequencyReads {
 public:
  /// A request was taken. True when it will tell P105 anew: until then what was typed in counts, as in the drive layer.
  bool begins(const profile::ParameterRequest& request) noexcept {
    const bool of_set_1 = request.shape == profile::ParameterShape::kPlain || request.parameter_set == 1;
    if (!request.scales || request.number != kMaxFrequency || !of_set_1) return false;
    ids_.push_back(request.id);
    return true;
  }
  /// What this result tells, if it answers such a request.
  std::optional<Hertz> taken(const profile::ParameterResult& result) noexcept {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (ids_[i] != result.id) continue;
      ids_[i] = ids_[ids_.size() - 1];
      ids_.resize(ids_.size() - 1);
      const bool told = result.outcome == profile::ParameterOutcome::kDone && result.raw > 0;
      return told ? std::optional<Hertz>{Hertz{kResolution * result.raw}} : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint16_t kMaxFrequency = 105;
  static constexpr double kResolution = 0.1;  // Hz

  FixedVector<std::uint32_t, Capacity> ids_;
};

}  // namespace nord_driver
