// The drives of a layout that go to positions: their settings, their inverters, and what users may ask of them.
#pragma once

#include <string>

#include "campaign/wheels.h"
#include "system/lift_words.h"

namespace nord_driver::test {

/// rad of the joint, either way; 20 revolutions of the motor are one of the joint.
constexpr double kAxisLimit = 6.0;
constexpr double kRevolutionsPerRadian = 20.0 / 6.283185307179586;
constexpr double kAxisStep = 0.001 / kRevolutionsPerRadian;              ///< rad, of 32 bits (BU 0020 7.3.5)
constexpr double kAxisTolerance = 0.01 / kRevolutionsPerRadian;          ///< rad, the default of position/tolerance
constexpr double kAxisSpeed = 4.0;                                       ///< rad/s of the joint, position/speed
constexpr double kAxisHertz = 2.0 * kAxisSpeed * kRevolutionsPerRadian;  ///< of a motor with two pole pairs
constexpr Duration kHomingTimeout = std::chrono::seconds{8};

/// The first one can: bit 8 of the control word (P480 [-11]) asks for it, bit 10 of the status word (P481 [-09]) says that
/// the reference is known.
inline bool canHome(const Layout& layout, DriveIndex drive) {
  return drive == layout.firstAxis();
}

/// On top of what all drives of the bus have, but the words.
inline void addAxisSettings(const Layout& layout, DriveIndex drive, Values& to) {
  to["mode"] = std::string{"position"};
  to["position/lower"] = -kAxisLimit;
  to["position/upper"] = kAxisLimit;
  to["position/speed"] = kAxisSpeed;
  if (!canHome(layout, drive)) return;
  to["position/home"] = std::string{"control_bit_8"};
  to["position/referenced"] = std::string{"status_bit_10"};
  to["position/homing_timeout"] = toSeconds(kHomingTimeout);
}

/// An absolute encoder; the switch is eight revolutions below where it stands at first. Its load brakes it, as that of a
/// lift or a turntable does: without mains it does not coast for a minute.
inline void simulateAxes(const Layout& layout, const LiftWords& words, sim::SimConfig& config) {
  for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
    sim::DriveConfig& drive = config.drives[i];
    drive.inverted = false;
    drive.motor.load = 0.3;
    const auto parameters = liftParameters(words);
    drive.parameters.insert(drive.parameters.end(), parameters.begin(), parameters.end());
    if (!canHome(layout, i)) continue;
    drive.inverter.posicon.reference_switch = -8.0;
    drive.inverter.posicon.reference_speed = -15.0;
    drive.parameters.push_back({480, 0, 10, drive.inverter.posicon.inputs.reference_run});
    drive.parameters.push_back({481, 0, 8, drive.inverter.posicon.outputs.referenced});
  }
}

}  // namespace nord_driver::test
