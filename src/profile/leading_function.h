// Where control word and setpoint of an inverter come from, as P509 and P510 say: the leading function, by which one inverter
// says them to others on the system bus by broadcast, and a bus that has but one of both.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

/// P509 by which the control word comes from such a broadcast (BU 0020 6.2.2: 9 CAN broadcast, 10 CANopen broadcast;
/// BU 0280 5.1.3: 4 system bus broadcast). With P510 = 0 the setpoint comes from it, too. The list of SK 300E, 700E and
/// 750E is printed without a value for it.
bool isBroadcastControlWord(Series series, std::int32_t source) noexcept;

/// P510 [-01] by which the setpoint alone does (BU 0280 5.1.3). BU 0070 5.1 prints the list of SK 5xxE up to 8; what
/// lies beyond is counted as P509 counts it.
bool isBroadcastSetpoint(Series series, std::int32_t source) noexcept;

/// P509 of SK 300E, 700E and 750E by which the control word comes from the bus, and the setpoint from the analog input or the
/// fixed frequencies (BU 0020 6.1.2: 9; BU 0070 5.1: 13).
bool isControlWordAlone(Series series, std::int32_t source) noexcept;

/// Its setpoint comes from another inverter: P510 [-01] (`setpoint`) says so, or leaves it to P509 (0, or not read).
bool isLed(Series series, std::optional<std::int32_t> control_word, std::optional<std::int32_t> setpoint) noexcept;

}  // namespace nord_driver::profile
