// The seam between a serial port and the kernel: everything that needs an adapter to be tried out, and nothing else.
#pragma once

#include <cstddef>
#include <cstdint>

#include "link/serial/serial_settings.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// A path below /dev. Longer ones are refused where they are made, never cut.
constexpr std::size_t kDevicePathLength = 255;
using DevicePath = FixedText<kDevicePathLength>;

enum class DeviceKind : std::uint8_t { kNoSerialDevice, kPty, kSerial };

/// What a UART reads back: it may do something else than it was told.
struct LineState {
  std::uint32_t output_rate = 0;  ///< bit/s
  std::uint32_t input_rate = 0;   ///< bit/s; 0: not told apart from the other
  bool even_parity = false;
  bool eight_data_bits = false;
  bool one_stop_bit = false;
};

/// The kernel's running counters of one UART since it was plugged in. They wrap at 32 bits.
struct RawLineCounters {
  std::uint32_t parity = 0;
  std::uint32_t framing = 0;
  std::uint32_t overrun = 0;         ///< the UART was not emptied in time
  std::uint32_t buffer_overrun = 0;  ///< the kernel's buffer was full
};

struct PollResult {
  bool readable = false;
  bool hung_up = false;
  int error = 0;  ///< errno, EINTR included
};

/// Every function that can fail gives 0 (or a count) and otherwise -errno. Nothing allocates and nothing throws: a
/// device that vanished is looked for from the bus cycle.
class SerialSystem {
 public:
  virtual ~SerialSystem() = default;

  /// Not blocking, no controlling terminal. A descriptor, or -errno.
  virtual int open(const char* path) noexcept = 0;
  virtual void close(int descriptor) noexcept = 0;
  virtual DeviceKind kind(int descriptor) noexcept = 0;
  /// Against a second process on the same device. -EWOULDBLOCK: somebody has it.
  virtual int lock(int descriptor) noexcept = 0;

  /// 8E1 without flow control or any translation of characters.
  virtual int setLine(int descriptor, BaudRate rate) noexcept = 0;
  virtual int readLine(int descriptor, LineState& state) noexcept = 0;
  virtual int setRs485(int descriptor, const Rs485Settings& settings) noexcept = 0;
  virtual int readRs485(int descriptor, Rs485Settings& settings) noexcept = 0;
  /// ASYNC_LOW_LATENCY, where the driver has it.
  virtual int requestLowLatency(int descriptor) noexcept = 0;
  virtual int readCounters(int descriptor, RawLineCounters& counters) noexcept = 0;
  virtual int flushInput(int descriptor) noexcept = 0;
  /// Discards what was written and has not been sent: `close()` waits for it, by Linux' default up to 30 s. Only as far
  /// as the driver of the device can: usb-serial has no function for it, and its `close()` waits all the same.
  virtual int flushOutput(int descriptor) noexcept = 0;

  /// The count of bytes, 0 at a hang-up, or -errno.
  virtual long read(int descriptor, std::uint8_t* buffer, std::size_t capacity) noexcept = 0;
  virtual long write(int descriptor, ByteView bytes) noexcept = 0;
  virtual PollResult poll(int descriptor, Duration timeout) noexcept = 0;

  virtual Instant now() const noexcept = 0;
  virtual void sleepUntil(Instant when) noexcept = 0;

  /// Where a path leads once every link in it is followed.
  virtual int resolve(const char* path, DevicePath& target) noexcept = 0;
  /// The link below /dev/serial/by-id that leads to this device. -ENOENT when there is none, or when the adapter has no
  /// serial number of its own: two such adapters share one link.
  virtual int adapterLink(const char* device, DevicePath& link) noexcept = 0;
  /// How long an FTDI adapter holds received bytes back, in ms. -ENOENT where the driver has no such timer.
  virtual int latencyTimer(const char* device) noexcept = 0;
  /// Who has locked it, see toText(LockOwner); empty where nobody can tell.
  virtual Sentence lockOwner(const char* device) noexcept = 0;
};

/// Linux' own.
SerialSystem& linuxSerialSystem() noexcept;

}  // namespace nord_driver::link
