// The bits of control word (STW) and status word (ZSW) as the simulated inverter reads and writes them:
// BU 2700 6.4.1, 6.4.2.
#pragma once

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

namespace stw {
constexpr Word kOn = 1u << 0;      ///< 0: OFF1, brake ramp to zero
constexpr Word kNoOff2 = 1u << 1;  ///< 0: disable voltage
constexpr Word kNoOff3 = 1u << 2;  ///< 0: emergency stop
constexpr Word kEnableOperation = 1u << 3;
constexpr Word kRampEnable = 1u << 4;      ///< 0: ramp generator set to zero
constexpr Word kRampRun = 1u << 5;         ///< 0: frequency held
constexpr Word kSetpointEnable = 1u << 6;  ///< 0: setpoint zero
constexpr Word kAcknowledge = 1u << 7;
constexpr Word kBit8 = 1u << 8;  ///< P480 [-11]
constexpr Word kBit9 = 1u << 9;  ///< P480 [-12]
constexpr Word kDataValid = 1u << 10;
constexpr Word kRight = 1u << 11;
constexpr Word kLeft = 1u << 12;
constexpr unsigned kParameterSetShift = 14;
}  // namespace stw

namespace zsw {
constexpr Word kReadyToSwitchOn = 1u << 0;
constexpr Word kSwitchedOn = 1u << 1;
constexpr Word kOperationEnabled = 1u << 2;
constexpr Word kFault = 1u << 3;
constexpr Word kNoOff2 = 1u << 4;
constexpr Word kNoOff3 = 1u << 5;
constexpr Word kSwitchOnDisabled = 1u << 6;
constexpr Word kWarning = 1u << 7;
constexpr Word kSetpointReached = 1u << 8;
constexpr Word kBusControl = 1u << 9;
constexpr Word kBit10 = 1u << 10;  ///< P481 [-09]
constexpr Word kRight = 1u << 11;
constexpr Word kLeft = 1u << 12;
constexpr Word kBit13 = 1u << 13;  ///< P481 [-10]
constexpr unsigned kParameterSetShift = 14;
}  // namespace zsw

/// 4000h = 100 % of P105: BU 2700 6.4.4.
constexpr double kFullScale = 16384.0;

}  // namespace nord_driver::sim
