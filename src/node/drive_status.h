// From the cycle's picture of one drive to its message.
#pragma once

#include <cstdint>

#include "catalogue/fault_words.h"
#include "cycle/snapshot.h"
#include "nord_driver/DriveStatus.h"

namespace nord_driver::node {

/// All fields but header, name and current. Of a drive that is offline nothing is told as if it were so now: bits and
/// actual values are cleared, and the status word stays as it was received last.
void fillDriveStatus(const cycle::DriveSample& sample, const catalogue::FaultWords& faults, DriveStatus& status);

/// A fault has risen since `told` of them stood in messages, and the next message would not show it: its bit has fallen
/// again, or the drive is gone.
bool hidesAFault(const cycle::DriveSnapshot& drive, std::uint64_t told) noexcept;

}  // namespace nord_driver::node
