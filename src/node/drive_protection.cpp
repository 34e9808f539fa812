#include "nord_driver/node/drive_protection.h"

namespace nord_driver::node {

bool runsOnWithoutUs(const cycle::DeviceData& device) {
  return device.telegram_timeout.has_value() && *device.telegram_timeout < 0.0;
}

std::string protectionText(const DriveIdentity& identity, const cycle::DeviceData& device) {
  if (runsOnWithoutUs(device)) {
    return "nothing: P513 = -0.1 lets the inverter ignore every bus error, it would run on; set P513 to 0 or more";
  }
  if (!device.telegram_timeout) return identity.protected_by + "; P513, which can switch this off, is not known";
  return identity.protected_by;
}

}  // namespace nord_driver::node
