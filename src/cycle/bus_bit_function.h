// What P480 lets a bit of the bus do in the inverter.
#pragma once

#include <cstdint>

namespace nord_driver::cycle {

/// Nothing by itself: 0, "no function". All others can move the motor, enable or acknowledge the inverter or switch its
/// parameter set, or are in none of the manuals at hand: the list is in the inverters' own manuals (BU 0280 5.1.2).
constexpr bool isHarmless(std::uint16_t function) noexcept {
  return function == 0;
}

/// It may be what ends OFF2, OFF3, a fault or local control of its drive: block voltage and quick stop, both while low,
/// acknowledge, and remote control, which is local control while low (BU 0020 6, note). 12 and 14 stand in BU 0280
/// (5.1.2), 10 and 11 only in the inverters' own manuals.
constexpr bool mayEndStop(std::uint16_t function) noexcept {
  return function == 10 || function == 11 || function == 12 || function == 14;
}

/// "enable right"; "not known by name" for one that none of the bus manuals names.
constexpr const char* busBitName(std::uint16_t function) noexcept {
  switch (function) {
    case 0:
      return "no function";
    case 1:
      return "enable right";
    case 2:
      return "enable left";
    case 4:
      return "fixed frequency 1";
    case 5:
      return "fixed frequency 2";
    case 12:
      return "acknowledge";
    case 14:
      return "remote control";
    case 19:
      return "analog input 1 on/off";
    case 20:
      return "analog input 2 on/off";
    default:
      return "not known by name";
  }
}

}  // namespace nord_driver::cycle
