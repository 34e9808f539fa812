// What a byte-oriented bus looks like to the transport above: an RS-485 line, a pty or a simulated segment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// Errors of the line as counted by the driver or the receiver, since the link was made.
struct LineCounters {
  std::uint64_t parity_errors = 0;
  std::uint64_t framing_errors = 0;
  std::uint64_t overruns = 0;
  std::uint64_t collisions = 0;  ///< what came back of our own telegram was not what was sent
};

/// Life: closed -> open() -> open -> close() or a failure -> closed. Nothing here throws; a failed call closes the link
/// and `lastError()` says why. The link also owns the time of the bus, so that a simulated segment can run faster than
/// the clock on the wall: `now()` and `waitReadable()` are the only places a transport learns the time from.
class ByteLink {
 public:
  virtual ~ByteLink() = default;

  /// Opens the device with the settings it was constructed with. False: `lastError()`.
  virtual bool open() noexcept = 0;
  virtual void close() noexcept = 0;
  virtual bool isOpen() const noexcept = 0;

  /// Sends all bytes of one telegram with one write. False when the link failed and is closed now.
  virtual bool write(ByteView telegram) noexcept = 0;
  /// Takes what has arrived, without waiting. 0 when nothing has, or when the link failed (`isOpen()` tells).
  virtual std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept = 0;
  /// Throws away what has arrived and was not read.
  virtual void discardInput() noexcept = 0;

  /// Waits until something can be read or `until` has come. True when something can be read.
  virtual bool waitReadable(Instant until) noexcept = 0;
  /// Waits until `when`, whatever arrives meanwhile.
  virtual void sleepUntil(Instant when) noexcept = 0;
  virtual Instant now() const noexcept = 0;

  /// A real UART at a real rate; false for a pty, which moves bytes without any time of their own.
  virtual bool keepsBaudRate() const noexcept = 0;
  virtual LineCounters lineCounters() const noexcept { return {}; }
  /// One sentence naming the device and what went wrong; empty when nothing did.
  virtual const std::string& lastError() const noexcept = 0;
  /// One sentence about an open device that works, but not as it could; empty when there is nothing to say.
  virtual const char* warning() const noexcept { return ""; }
};

}  // namespace nord_driver::link
