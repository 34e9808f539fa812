// How a running drive is brought to rest.
#pragma once

#include <cstdint>

namespace nord_driver::drive {

enum class StopWay : std::uint8_t {
  kSetpointZero,  ///< down a ramp with the torque on; it stays on at 0 Hz
  kOff1,          ///< OFF1: down the ramp P103, then no torque
  kQuickStop,     ///< OFF3: down the ramp P426, then no torque
  kCoast,         ///< OFF2: no torque at once
};

/// The way of each stop that has a choice (BU 2700 6.4.1).
struct StopWays {
  /// The velocity command is too old. kSetpointZero: down the base's own limit, and the drives stay enabled. kOff1: the
  /// same, then disabled.
  StopWay command_timeout = StopWay::kSetpointZero;
  /// Disabling was asked for, or the program ends. kOff1: the setpoint comes down from above first.
  StopWay disable = StopWay::kOff1;
  /// A drive of the group has stopped: what the others do. kSetpointZero: down their own ramp, then OFF1.
  StopWay drive_stopped = StopWay::kSetpointZero;
};

}  // namespace nord_driver::drive
