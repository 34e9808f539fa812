// The words of the drive profile (P551 on) and how they act on the inverter: DRIVECOM 21 velocity mode, BU 0070 6.4.
#pragma once

#include "sim/drive_unit.h"

namespace nord_driver::sim {

/// Bit 10 of the control word is reserved there and set 1 is the only one; bit 11 is the direction, 0 = right.
ProcessData fromCia402(Word control, std::int16_t rpm, const DriveUnit& drive) noexcept;
/// Bit 10 setpoint reached, 11 limit, 14 direction; 8, 12, 13, 15 are 0.
Word cia402Status(const DriveUnit& drive, std::int16_t rpm_setpoint) noexcept;

double rpmOf(double frequency, const DriveUnit& drive) noexcept;  ///< Hz at the inverter's output
double frequencyOf(double rpm, const DriveUnit& drive) noexcept;
std::int16_t behindRamp(const DriveUnit& drive) noexcept;   ///< 6043h
std::int16_t actualSpeed(const DriveUnit& drive) noexcept;  ///< 6044h

}  // namespace nord_driver::sim
