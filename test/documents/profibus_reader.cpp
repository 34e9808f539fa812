#include "documents/bus_readers.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver::documents {

void readProfibus(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  readProfibusDpConfig(bus, drives, cycle_rate);
}

}  // namespace nord_driver::documents
