// The RS-485 adapter (or pty) a PROFIBUS segment hangs on: 8E1 at any rate the adapter can really do.
#pragma once

#include <cstdint>
#include <string>

#include "link/serial/byte_link.h"
#include "link/serial/device_finder.h"
#include "link/serial/echo_filter.h"
#include "link/serial/line_errors.h"
#include "link/serial/serial_settings.h"
#include "link/serial/serial_system.h"

namespace nord_driver::link {

/// The rate is read back and refused when it is more than 0.5 % off. One process only: a second one on the same device
/// is refused, since two masters that do not know of each other would talk into each other's telegrams.
class SerialPort final : public ByteLink {
 public:
  /// `system` is kept by reference: Linux' own, or one a test made.
  explicit SerialPort(const SerialSettings& settings, SerialSystem& system = linuxSerialSystem());
  ~SerialPort() override;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return descriptor_ >= 0; }
  bool write(ByteView telegram) noexcept override;
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override;
  void discardInput() noexcept override;
  /// Our own echo is nothing to be read.
  bool waitReadable(Instant until) noexcept override;
  void sleepUntil(Instant when) noexcept override { system_.sleepUntil(when); }
  Instant now() const noexcept override { return system_.now(); }
  bool keepsBaudRate() const noexcept override { return !is_pty_; }
  LineCounters lineCounters() const noexcept override;
  const std::string& lastError() const noexcept override { return error_; }
  const char* warning() const noexcept override { return warning_.c_str(); }

 private:
  bool setUp() noexcept;
  long receive(std::uint8_t* buffer, std::size_t capacity) noexcept;
  void receiveThroughFilter() noexcept;
  bool fail(const char* what, int error = 0, const char* remedy = "") noexcept;

  SerialSettings settings_;
  SerialSystem& system_;
  DeviceFinder finder_;
  EchoFilter echo_;
  int descriptor_ = -1;
  bool is_set_up_ = false;  // it is ours, and what was written to it too
  bool is_pty_ = false;
  DevicePath device_;  // what is open, or was last
  std::string error_;
  Sentence warning_;
  mutable LineErrors errors_;  // asked of the kernel when somebody wants to know
};

}  // namespace nord_driver::link
