#include "transport/profibus/profibus_line.h"

#include "link/serial/serial_port.h"

namespace nord_driver {

std::unique_ptr<link::ByteLink> openSerialPort(const link::SerialSettings& settings) {
  return std::make_unique<link::SerialPort>(settings);
}

}  // namespace nord_driver
