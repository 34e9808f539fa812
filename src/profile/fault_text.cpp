#include "nord_driver/profile/fault_text.h"

namespace nord_driver::profile {

const char* faultText(std::uint16_t raw) noexcept {
  switch (raw) {
    case 0:
      return "no fault";
    case 100:
      return "bus timeout: the contact to the bus interface is lost; check P513, the connections and the bus master";
    case 102:
      return "PROFIBUS telegrams failed: the watchdog in the bus module has run out; check the connections and the bus "
             "master";
    case 103:
      return "timeout P151 or P513: no valid control word in time; check the time, the connections and control bit 10";
    case 104:
      return "the bus module could not be initialised; check P746, how it is plugged in and its supply";
    case 101:
    case 105:
    case 106:
    case 107:
      return "system fault of the bus module";
    case 108:
      return "the connection between bus module and inverter is interrupted";
    case 109:
      return "the bus module is missing; check the connection and P120";
    case kFaultNumberUnknown:
      return "fault; its number could not be read";
    default:
      return "see the list of error messages in the inverter's manual";
  }
}

std::string faultName(std::uint16_t raw) {
  if (raw == 0) return "no fault";
  if (raw == kFaultNumberUnknown) return "fault of unknown number";
  return "E" + std::to_string(raw / 10) + "." + std::to_string(raw % 10);
}

}  // namespace nord_driver::profile
