#include "documents/bus_readers.h"
#include "transport/interbus/interbus_config.h"

namespace nord_driver::documents {

void readInterbus(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  readInterbusConfig(bus, drives, cycle_rate);
}

}  // namespace nord_driver::documents
