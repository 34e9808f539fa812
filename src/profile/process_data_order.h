// The order in which an inverter takes its setpoints and sends its actual values.
#pragma once

#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

/// SK 300E, 700E and 750E put SW3 and IW3 before SW2 and IW2, on PROFIBUS, InterBus and CANopen (BU 0020 7.2.2, BU 0070
/// 4.2.2, BU 0060 p. 59). Of DeviceNet nobody says it; inferred is that the series decides there as well.
bool thirdBeforeSecond(Series series) noexcept;

}  // namespace nord_driver::profile
