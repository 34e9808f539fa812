// The RS-485 adapter (or pty) a PROFIBUS segment hangs on: 8E1 at any rate the adapter can really do.
#pragma once

#include <cstdint>
#include <string>

#include "nord_driver/core/baud_rate.h"
#include "nord_driver/link/byte_link.h"

namespace nord_driver::link {

struct SerialSettings {
  std::string device;  ///< "/dev/ttyUSB0", or a link to a pty
  BaudRate baud_rate{500'000};
};

/// Uses termios2, because PROFIBUS rates such as 93.75 and 187.5 kbit/s have no constant of their own; the rate is read
/// back and refused when it is more than 0.5 % off. One process only: a second one on the same device is refused, since
/// two masters that do not know of each other would talk into each other's telegrams.
class SerialPort final : public ByteLink {
 public:
  explicit SerialPort(SerialSettings settings);
  ~SerialPort() override;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return fd_ >= 0; }
  bool write(ByteView telegram) noexcept override;
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override;
  void discardInput() noexcept override;
  bool waitReadable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override;
  Instant now() const noexcept override;
  bool keepsBaudRate() const noexcept override { return !is_pty_; }
  LineCounters lineCounters() const noexcept override;
  const std::string& lastError() const noexcept override { return error_; }

 private:
  bool configure() noexcept;
  bool setRateAndFrame() noexcept;
  void requestLowLatency() noexcept;
  bool fail(const char* what, int error) noexcept;

  SerialSettings settings_;
  int fd_ = -1;
  bool is_pty_ = false;
  LineCounters counters_at_open_;
  std::string error_;
};

}  // namespace nord_driver::link
