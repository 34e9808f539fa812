// Which adapter a serial device is, whatever name it has today: by udev's links and the USB serial number.
#pragma once

#include "link/serial/serial_system.h"

namespace nord_driver::link {

/// Where the kernel and udev keep what they know; a test has its own.
struct DeviceTree {
  const char* by_id = "/dev/serial/by-id";
  const char* tty_class = "/sys/class/tty";
};

/// Where a path leads; -errno, -ENAMETOOLONG included.
int resolvePath(const char* path, DevicePath& target) noexcept;

/// See SerialSystem::adapterLink().
int adapterLink(const DeviceTree& tree, const char* device, DevicePath& link) noexcept;

/// See SerialSystem::latencyTimer().
int latencyTimer(const DeviceTree& tree, const char* device) noexcept;

}  // namespace nord_driver::link
