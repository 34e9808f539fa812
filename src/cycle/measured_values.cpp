#include "cycle/measured_values.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "profile/scaling.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {

using profile::WordUse;

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Of sets 2 to 4 the further functions are read only where they are in use: the ones of set 1 stand for them.
std::uint16_t functionAt(std::size_t i, const DriveSample& sample, const DeviceData& device) noexcept {
  const std::size_t set = sample.parameter_set;
  if (set >= 1 && set <= device.word_functions.size()) {
    const std::uint16_t own = device.word_functions[set - 1].actual_values[i];
    if (own != kUnknownFunction) return own;
  }
  return device.word_functions[0].actual_values[i];
}

std::optional<double> shareWith(WordUse use, const DriveSample& sample, const DeviceData& device,
                                profile::Series series) noexcept {
  for (std::size_t i = 0; i < std::min<std::size_t>(sample.words, profile::kMaxProcessValues) && sample.online; ++i) {
    const auto* const function = profile::findActualValueFunction(series, functionAt(i, sample, device));
    if (function == nullptr || function->use != use) continue;
    return static_cast<double>(sample.input.actual_values[i]) / profile::kHundredPercent;
  }
  return std::nullopt;
}

}  // namespace

double currentOf(const DriveSample& sample, const DeviceData& device, const DriveSetup& setup) noexcept {
  const auto share = shareWith(WordUse::kCurrent, sample, device, setup.series);
  return share && setup.rated_current ? *share * *setup.rated_current : kNotKnown;
}

double effortOf(const DriveSample& sample, const DeviceData& device, const DriveSetup& setup) noexcept {
  if (!setup.words.torque_at_limit) return kNotKnown;
  const auto share = shareWith(WordUse::kTorqueCurrent, sample, device, setup.series);
  if (!share) return kNotKnown;
  const profile::JointScaling& joint = setup.drive.joint;
  const double torque = *share * *setup.words.torque_at_limit * joint.gear_ratio;
  return joint.inverted ? -torque : torque;
}

}  // namespace nord_driver::cycle
