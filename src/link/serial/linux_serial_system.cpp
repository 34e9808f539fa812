#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "link/serial/adapter_identity.h"
#include "link/serial/lock_owner.h"
#include "link/serial/serial_devices.h"
#include "link/serial/serial_system.h"
#include "link/serial/uart_requests.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

class LinuxSerialSystem final : public SerialSystem {
 public:
  int open(const char* path) noexcept override {
    const int descriptor = ::open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    return descriptor >= 0 ? descriptor : -errno;
  }
  void close(int descriptor) noexcept override { ::close(descriptor); }
  DeviceKind kind(int descriptor) noexcept override {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISCHR(status.st_mode) || ::isatty(descriptor) == 0) {
      return DeviceKind::kNoSerialDevice;
    }
    return isPtyNumber(status.st_rdev) ? DeviceKind::kPty : DeviceKind::kSerial;
  }
  // A lock and not TIOCEXCL: the exclusive mark would outlive us on a pty whose other end keeps it open.
  int lock(int descriptor) noexcept override { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : -errno; }

  int setLine(int descriptor, BaudRate rate) noexcept override { return uart::setLine(descriptor, rate); }
  int readLine(int descriptor, LineState& state) noexcept override { return uart::readLine(descriptor, state); }
  int setRs485(int descriptor, const Rs485Settings& settings) noexcept override {
    return uart::setRs485(descriptor, settings);
  }
  int readRs485(int descriptor, Rs485Settings& settings) noexcept override {
    return uart::readRs485(descriptor, settings);
  }
  int requestLowLatency(int descriptor) noexcept override { return uart::requestLowLatency(descriptor); }
  int readCounters(int descriptor, RawLineCounters& counters) noexcept override {
    return uart::readCounters(descriptor, counters);
  }
  int flushInput(int descriptor) noexcept override { return uart::flushInput(descriptor); }
  int flushOutput(int descriptor) noexcept override { return uart::flushOutput(descriptor); }

  long read(int descriptor, std::uint8_t* buffer, std::size_t capacity) noexcept override {
    const ssize_t count = ::read(descriptor, buffer, capacity);
    return count >= 0 ? count : -errno;
  }
  long write(int descriptor, ByteView bytes) noexcept override {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    return count >= 0 ? count : -errno;
  }
  PollResult poll(int descriptor, Duration timeout) noexcept override {
    const timespec left = toTimeout(timeout);
    pollfd wait{descriptor, POLLIN, 0};
    PollResult result;
    const int ready = ::ppoll(&wait, 1, &left, nullptr);
    if (ready < 0) result.error = errno;
    if (ready > 0) {
      result.readable = (wait.revents & POLLIN) != 0;
      result.hung_up = (wait.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
    }
    return result;
  }

  Instant now() const noexcept override { return std::chrono::steady_clock::now(); }
  void sleepUntil(Instant when) noexcept override { sleepUntilInstant(when); }

  int resolve(const char* path, DevicePath& target) noexcept override { return resolvePath(path, target); }
  int adapterLink(const char* device, DevicePath& link) noexcept override {
    return link::adapterLink(DeviceTree{}, device, link);
  }
  int latencyTimer(const char* device) noexcept override { return link::latencyTimer(DeviceTree{}, device); }
  Sentence lockOwner(const char* device) noexcept override {
    const auto owner = link::lockOwner(device);
    return owner ? toText(*owner) : Sentence{};
  }
};

}  // namespace

SerialSystem& linuxSerialSystem() noexcept {
  static LinuxSerialSystem system;
  return system;
}

}  // namespace nord_driver::link
