#include "documents/bus_readers.h"
#include "transport/canopen/canopen_config.h"

namespace nord_driver::documents {

void readCanopen(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  readCanopenConfig(bus, drives, cycle_rate);
}

}  // namespace nord_driver::documents
