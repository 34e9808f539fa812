#include "rostest/bus_under_test.h"

#include <ros/ros.h>

#include <stdexcept>

#include "transport/canopen/canopen.h"
#include "transport/devicenet/devicenet.h"
#include "transport/interbus/interbus.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::test {
namespace {

template <typename Made>
std::unique_ptr<Transport> make() {
  return std::make_unique<Made>();
}

void nothing(MapSettings& /*settings*/) {}

const BusUnderTest kProfibus{
    "device",
    true,
    "PKW",
    0x7531,
    "watchdog of 1 s",
    "watchdog of 0.2 s",
    false,
    102,
    true,
    0.95,
    0.0,
    {"PKW error 0", "PKW error 1", "PKW error 2", "PKW error 3"},
    make<ProfibusDpTransport>,
    [](MapSettings& bus) { bus.set("baud_rate", 500'000).set("slot_time", 0.05).set("watchdog", 0.6); },
    [](MapSettings& drive) { drive.set("ppo_type", 1); }};

// Guarding may have had its last answer two guard times before.
const BusUnderTest kCanopen{
    "interface",
    false,
    "SDO",
    0x004E0001,
    "node guarding",
    "node guarding",
    true,
    100,
    false,
    0.6,
    0.0,
    {"SDO abort 0602 0000h", "SDO abort 0601 0002h", "SDO abort 0609 0032h", "SDO abort 0609 0011h"},
    make<CanopenTransport>,
    [](MapSettings& bus) { bus.set("sdo_timeout", 1.0); },
    nothing};

const BusUnderTest kDevicenet{
    "interface",
    false,
    "explicit messages",
    0x03E80001,
    "DeviceNet time-out of 1 s",
    "DeviceNet time-out of 0.1 s",
    true,
    102,
    false,
    0.95,
    2.0,
    {"DeviceNet error 16h", "DeviceNet error 0Eh", "DeviceNet error 09h", "DeviceNet error 16h"},
    make<DeviceNetTransport>,
    [](MapSettings& bus) { bus.set("bit_rate", 500'000).set("expected_packet_rate", 0.25); },
    nothing};

// No parameter channel: a program that asks for one does not run here.
const BusUnderTest kInterbus{
    "gateway", false,  "none", 0, "", "", false, 102, false, 0.95, 0.0, {"", "", "", ""}, make<InterbusTransport>,
    nothing,   nothing};

const BusUnderTest& busOf(const std::string& transport) {
  if (transport == "nord_driver/profibus_dp") return kProfibus;
  if (transport == "nord_driver/canopen") return kCanopen;
  if (transport == "nord_driver/devicenet") return kDevicenet;
  if (transport == "nord_driver/interbus") return kInterbus;
  throw std::invalid_argument("no rostest knows the transport \"" + transport + "\"");
}

}  // namespace

const BusUnderTest& bus() {
  static const BusUnderTest& of_this_run =
      busOf(ros::param::param("nord_driver/transport", std::string{"nord_driver/profibus_dp"}));
  return of_this_run;
}

}  // namespace nord_driver::test
