// Current and torque in SI units, from whichever actual value carries them.
#pragma once

#include "cycle/cycle_config.h"
#include "cycle/snapshot.h"

namespace nord_driver::cycle {

/// A; NaN while no actual value of the set in force is the current, or the rated current is not configured. Only
/// function 3 is a share of the rated current; torque current (4) is one of P112 (BU 0020 6.2.2, 7.3.7).
double currentOf(const DriveSample& sample, const DeviceData& device, const DriveSetup& setup) noexcept;

/// Nm at the joint, without losses of the gear; NaN while no actual value is the torque current, or nobody has said what
/// torque P112 stands for: no bus manual gives P112 a unit.
double effortOf(const DriveSample& sample, const DeviceData& device, const DriveSetup& setup) noexcept;

}  // namespace nord_driver::cycle
