// The readers of the buses, each in a file of its own: no file knows two buses.
#pragma once

#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver::documents {

// Each reads and checks everything its transport wants of the group `bus` and of the drives; throws ConfigError.
void readProfibus(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);
void readCanopen(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);
void readDevicenet(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);
void readInterbus(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);

}  // namespace nord_driver::documents
