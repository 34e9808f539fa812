// What the bus cycle has read of a drive, as facts of the check.
#pragma once

#include "catalogue/drive_catalogue.h"
#include "commissioning/asked_drive.h"
#include "commissioning/facts.h"
#include "cycle/device_data.h"

namespace nord_driver::commissioning {

/// Empty before everything has been asked for. What of the deciding ones is absent then was not readable.
CommissioningFacts deviceFacts(const cycle::DeviceData& device, const AskedDrive& asked,
                               const catalogue::DriveCatalogue& known);

}  // namespace nord_driver::commissioning
