#include "nord_driver/link/serial_port.h"

#include <asm/termbits.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <poll.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "nord_driver/link/serial_devices.h"

namespace nord_driver::link {

namespace {

constexpr double kMaxRateError = 0.005;

bool rateIsOff(std::uint32_t wanted, std::uint32_t real) noexcept {
  const double error = (static_cast<double>(real) - wanted) / wanted;
  return error > kMaxRateError || error < -kMaxRateError;
}

LineCounters readCounters(int fd) noexcept {
  serial_icounter_struct raw{};
  LineCounters counters;
  if (ioctl(fd, TIOCGICOUNT, &raw) == 0) {  // a pty and some adapters have none
    counters.parity_errors = static_cast<std::uint64_t>(raw.parity);
    counters.framing_errors = static_cast<std::uint64_t>(raw.frame);
    counters.overruns = static_cast<std::uint64_t>(raw.overrun) + static_cast<std::uint64_t>(raw.buf_overrun);
  }
  return counters;
}

}  // namespace

SerialPort::SerialPort(SerialSettings settings) : settings_(std::move(settings)) {
  error_.reserve(512);  // so that naming an error in the bus cycle does not allocate
}

SerialPort::~SerialPort() {
  close();
}

bool SerialPort::fail(const char* what, int error) noexcept {
  char text[512];
  char buffer[128];
  std::snprintf(text, sizeof text, "%s: %s%s%s", settings_.device.c_str(), what, error != 0 ? ": " : "",
                error != 0 ? strerror_r(error, buffer, sizeof buffer) : "");
  close();
  error_.assign(text);
  return false;
}

bool SerialPort::open() noexcept {
  close();
  fd_ = ::open(settings_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return fail("cannot be opened", errno);
  if (!configure()) return false;
  error_.clear();
  return true;
}

bool SerialPort::configure() noexcept {
  struct stat status {};
  if (::fstat(fd_, &status) != 0) return fail("cannot be examined", errno);
  if (!S_ISCHR(status.st_mode) || isatty(fd_) == 0) return fail("is no serial device", 0);
  is_pty_ = isPty(settings_.device);
  // A lock and not TIOCEXCL: the exclusive mark would outlive us on a pty whose other end keeps it open.
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) return fail("is in use by another process", 0);
  if (!setRateAndFrame()) return false;
  requestLowLatency();
  counters_at_open_ = readCounters(fd_);
  discardInput();
  return true;
}

bool SerialPort::setRateAndFrame() noexcept {
  struct termios2 settings {};
  if (ioctl(fd_, TCGETS2, &settings) != 0) return fail("has no serial settings", errno);
  // 8E1 (EN 50170: 8 data bits, even parity, 1 stop bit), no flow control, no translation. INPCK without PARMRK turns a
  // character with a parity error into a zero, which the telegram's checksum then rejects.
  settings.c_iflag = INPCK;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | PARENB | BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = settings_.baud_rate.bitsPerSecond();
  settings.c_ospeed = settings_.baud_rate.bitsPerSecond();
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (ioctl(fd_, TCSETS2, &settings) != 0) return fail("refuses 8E1 at this baud rate", errno);

  struct termios2 real {};
  if (ioctl(fd_, TCGETS2, &real) != 0) return fail("does not tell its settings", errno);
  if (is_pty_) return true;  // takes every rate and reads parity back as off
  if (rateIsOff(settings_.baud_rate.bitsPerSecond(), real.c_ospeed)) {
    char text[128];
    std::snprintf(text, sizeof text, "cannot do %u bit/s, its nearest is %u (more than 0.5 %% off)",
                  settings_.baud_rate.bitsPerSecond(), real.c_ospeed);
    return fail(text, 0);
  }
  if ((real.c_cflag & PARENB) == 0) return fail("cannot do even parity", 0);
  return true;
}

// An FTDI adapter holds received bytes back for 16 ms unless told not to. Drivers without such a knob refuse: no harm.
void SerialPort::requestLowLatency() noexcept {
  struct serial_struct serial {};
  if (ioctl(fd_, TIOCGSERIAL, &serial) != 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  ioctl(fd_, TIOCSSERIAL, &serial);
}

void SerialPort::close() noexcept {
  if (fd_ < 0) return;
  ::close(fd_);
  fd_ = -1;
}

bool SerialPort::write(ByteView telegram) noexcept {
  if (fd_ < 0) return false;
  // One write per telegram: a gap between two would be a gap inside the telegram on the wire.
  const ssize_t written = ::write(fd_, telegram.data(), telegram.size());
  if (written == static_cast<ssize_t>(telegram.size())) return true;
  if (written >= 0 || errno == EAGAIN) return fail("does not take a whole telegram (its buffer is full)", 0);
  return fail("cannot be written", errno);
}

std::size_t SerialPort::read(std::uint8_t* buffer, std::size_t capacity) noexcept {
  if (fd_ < 0 || capacity == 0) return 0;
  const ssize_t count = ::read(fd_, buffer, capacity);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  const bool gone = count == 0 || errno == EIO || errno == ENXIO;  // a pty hangs up with 0 or EIO, an adapter with both
  fail(gone ? "was unplugged" : "cannot be read", gone ? 0 : errno);
  return 0;
}

void SerialPort::discardInput() noexcept {
  if (fd_ >= 0) ioctl(fd_, TCFLSH, TCIFLUSH);
}

bool SerialPort::waitReadable(Instant until) noexcept {
  while (fd_ >= 0) {
    const Duration left = until - now();
    timespec timeout{};
    if (left > Duration::zero()) {
      timeout.tv_sec = static_cast<time_t>(left.count() / 1'000'000'000);
      timeout.tv_nsec = static_cast<long>(left.count() % 1'000'000'000);
    }
    pollfd descriptor{fd_, POLLIN, 0};
    const int ready = ppoll(&descriptor, 1, &timeout, nullptr);
    if (ready < 0 && errno != EINTR) return fail("cannot be waited for", errno);
    if (ready > 0) {
      if ((descriptor.revents & POLLIN) != 0) return true;
      return fail("was unplugged", 0);
    }
    if (ready == 0) return false;
  }
  return false;
}

void SerialPort::sleepUntil(Instant when) noexcept {
  const Duration since_epoch = when.time_since_epoch();
  timespec wake{};
  wake.tv_sec = static_cast<time_t>(since_epoch.count() / 1'000'000'000);
  wake.tv_nsec = static_cast<long>(since_epoch.count() % 1'000'000'000);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
  }
}

Instant SerialPort::now() const noexcept {
  return std::chrono::steady_clock::now();
}

LineCounters SerialPort::lineCounters() const noexcept {
  if (fd_ < 0) return {};
  LineCounters counters = readCounters(fd_);
  counters.parity_errors -= counters_at_open_.parity_errors;
  counters.framing_errors -= counters_at_open_.framing_errors;
  counters.overruns -= counters_at_open_.overruns;
  return counters;
}

}  // namespace nord_driver::link
