// What a transport may offer a program that only reads and writes parameters, and then ends.
#pragma once

namespace nord_driver {

/// Implemented beside Transport where the end of such a program would look to the drives like the loss of the driver.
class ParametersOnly {
 public:
  virtual ~ParametersOnly() = default;

  /// Before configure(). The exchange then starts no time-out in the bus modules that would trip the inverters when the
  /// program has ended, and listens for other masters before its first telegram. Never for a driver that enables: no
  /// time-out would stop its drives.
  virtual void serveParametersOnly() noexcept = 0;
};

}  // namespace nord_driver
