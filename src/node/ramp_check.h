// Whether a drive's own ramps (P102, P103) let its wheel follow the base's acceleration limits, or a single drive its
// own: where they are slower, the base lags behind its commands, and two drives that differ bend its path.
#pragma once

#include <optional>
#include <string>

#include "cycle/cycle_config.h"
#include "cycle/device_data.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

/// Compares frequencies per second: what the limits of all axes together can ask of a wheel, by its radius, gear ratio
/// and pole pairs, and P105 in P102 or P103 seconds.
class RampCheck {
 public:
  RampCheck(const cycle::CycleConfig& config, DriveIndex drive);

  /// One sentence when a ramp of this parameter set (1..4) is slower; empty when none is, when something could not be
  /// read, and for a drive without acceleration limits. `typed_max_frequency` (Hz) stands for a P105 that
  /// could not be read.
  std::string assess(const cycle::DeviceData& device, unsigned parameter_set) const;

 private:
  bool of_base_ = false;   // or a drive with limits of its own
  double speed_up_ = 0.0;  // Hz/s, the most that is asked for; 0: no limits
  double brake_ = 0.0;
  std::optional<double> typed_max_frequency_;
};

}  // namespace nord_driver::node
