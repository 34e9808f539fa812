#include "link/serial/device_finder.h"

namespace nord_driver::link {

bool DeviceFinder::find(SerialSystem& system, DevicePath& device, Sentence& reason) const noexcept {
  if (configured_.size() > kDevicePathLength) {
    reason.format("has a name of more than %zu characters", kDevicePathLength);
    return false;
  }
  if (adapter_.empty()) {
    // Not resolved when it is not there: opening it names the reason.
    if (system.resolve(configured_.c_str(), device) != 0) device.format("%s", configured_.c_str());
    return true;
  }
  if (system.resolve(adapter_.c_str(), device) == 0) return true;
  reason.format("the adapter %s is not plugged in", adapter_.c_str());
  return false;
}

void DeviceFinder::opened(SerialSystem& system, const DevicePath& device) noexcept {
  if (!follow_adapter_ || !adapter_.empty() || configured_ != device.c_str()) return;
  DevicePath link;
  if (system.adapterLink(device.c_str(), link) == 0) adapter_ = link;
}

}  // namespace nord_driver::link
