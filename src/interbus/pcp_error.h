// What the errors of PCP mean: class, code and additional code of a negative result.
#pragma once

#include "interbus/pcp_blocks.h"

namespace nord_driver::interbus {

/// A clause for people; never null. BU 0070 lists no errors: these are those of drives with the same profile (Lenze
/// EDSIBS 5.6.8, ABB NIBA-01 chapter 6) and of PCP itself (Burkert 8644, "Error codes during PCP communication").
const char* pcpErrorMeaning(const PcpError& error) noexcept;

}  // namespace nord_driver::interbus
