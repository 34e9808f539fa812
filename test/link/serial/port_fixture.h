// A serial port on a kernel made for the test.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "link/serial/fake_serial_system.h"
#include "link/serial/serial_port.h"

namespace nord_driver::link {

class PortFixture : public ::testing::Test {
 protected:
  using Bytes = FakeSerialSystem::Bytes;
  static constexpr int kMostReads = 100'000;

  SerialPort makePort() { return SerialPort{settings, system}; }

  /// Everything the port hands out until nothing comes for a millisecond.
  Bytes everything(SerialPort& port, std::size_t capacity = 64) {
    Bytes all;
    Bytes buffer(capacity);
    for (int reads = 0; port.waitReadable(port.now() + std::chrono::milliseconds{1}); ++reads) {
      if (reads == kMostReads) {
        ADD_FAILURE() << "the port is readable for ever: " << all.size() << " bytes by " << reads << " reads";
        break;
      }
      const std::size_t count = port.read(buffer.data(), buffer.size());
      all.insert(all.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
  }

  FakeSerialSystem system;
  SerialSettings settings = [] {
    SerialSettings made;
    made.device = "/dev/ttyUSB0";
    return made;
  }();
};

}  // namespace nord_driver::link
