// The picture of one drive that a cycle publishes, from what the cycle keeps of it.
#pragma once

#include "cycle/axis.h"
#include "cycle/snapshot.h"
#include "drive/drive_report.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

/// What a picture is made of.
struct DrivePictured {
  DriveIndex index = 0;
  const char* name = "";
  const drive::DriveReport& report;
  const profile::ProcessOutput& sent;  ///< in this cycle
  const Axis& axis;
  bool module_answers = false;    ///< in this cycle
  bool positions = false;         ///< it goes to positions
  bool beyond_its_speed = false;  ///< what its base, or the command of a drive alone, wants cannot be had of it
};

/// `to`: the picture of the cycle before, which tells what is new. Neither throws nor allocates.
void fillDriveSnapshot(DriveSnapshot& to, const DrivePictured& from, const Transport& transport, Instant now) noexcept;

}  // namespace nord_driver::cycle
