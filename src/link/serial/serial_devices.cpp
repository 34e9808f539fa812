#include "link/serial/serial_devices.h"

#include <limits.h>
#include <stdlib.h>
#include <sys/sysmacros.h>

#include <cstring>

namespace nord_driver::link {

// Linux' Documentation/admin-guide/devices.txt: majors 136-143 are the slave ends of ptys.
bool isPtyNumber(std::uint64_t device_number) noexcept {
  return major(device_number) >= 136 && major(device_number) <= 143;
}

bool isNativeUart(const std::string& device) noexcept {
  char resolved[PATH_MAX];
  if (::realpath(device.c_str(), resolved) == nullptr) return false;
  for (const char* prefix : {"/dev/ttyS", "/dev/ttyAMA", "/dev/ttyO", "/dev/ttymxc", "/dev/ttyTHS", "/dev/ttyPS"}) {
    if (std::strncmp(resolved, prefix, std::strlen(prefix)) == 0) return true;
  }
  return false;
}

}  // namespace nord_driver::link
