#include "nord_driver/sim/sim_config.h"

namespace nord_driver::sim {

namespace {

// P509, CANopen: BU 0020 6.2.2. The list of the older series is printed with its PROFIBUS and InterBus values only
// (8-10 and 12-14); by their order the full CANopen control would be 17.
constexpr std::int32_t kCanopen = 6;
constexpr std::int32_t kCanopenOlderSeries = 17;

}  // namespace

InverterSettings canInverterSettings(CanConnection connection, const Device& device) {
  InverterSettings settings;
  settings.bus_source = device.isOlderSeries() ? kCanopenOlderSeries : kCanopen;
  settings.on_system_bus = connection == CanConnection::kGateway;
  if (connection != CanConnection::kGateway) {
    settings.master_lost_fault = fault::kBusTimeout;
    settings.timeout_fault = fault::kBusTimeout;
  }
  return settings;
}

}  // namespace nord_driver::sim
