#include "documents/bus_readers.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver::documents {

void readDevicenet(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  readDevicenetConfig(bus, drives, cycle_rate);
}

}  // namespace nord_driver::documents
