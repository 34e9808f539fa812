#include "link/serial/serial_port.h"

#include <errno.h>

#include <cstdio>

#include "link/error_text.h"
#include "link/serial/line_setup.h"

namespace nord_driver::link {

namespace {

constexpr std::size_t kLongestPortError = 1024;

bool meansUnplugged(long error) noexcept {
  return error == EIO || error == ENXIO || error == ENODEV || error == EPIPE;
}

const char* remedyOf(int error) noexcept {
  if (error == ENOENT) return " (the adapters that are there: ls /dev/serial/by-id)";
  if (error == EACCES) return " (only the group dialout may: sudo usermod -aG dialout $USER, then log in again)";
  return "";
}

}  // namespace

SerialPort::SerialPort(const SerialSettings& settings, SerialSystem& system)
    : settings_(settings), system_(system), finder_(settings.device, settings.follow_adapter), echo_(settings.echo) {
  error_.reserve(kLongestPortError);  // so that naming an error in the bus cycle does not allocate
}

SerialPort::~SerialPort() {
  close();
}

bool SerialPort::fail(const char* what, int error, const char* remedy) noexcept {
  char text[kLongestPortError];
  const std::string& configured = finder_.configured();
  const bool renamed = !device_.empty() && configured != device_.c_str();
  std::snprintf(text, sizeof text, "%s%s%s%s: %s%s%s%s", configured.c_str(), renamed ? " (" : "",
                renamed ? device_.c_str() : "", renamed ? ")" : "", what, error != 0 ? ": " : "",
                error != 0 ? ErrorText{error}.c_str() : "", remedy);
  // Not that of another process, which may hold the device when setting up fails.
  if (is_set_up_) system_.flushOutput(descriptor_);
  close();
  error_.assign(text);
  return false;
}

bool SerialPort::open() noexcept {
  close();
  device_.clear();
  warning_.clear();
  Sentence reason;
  if (!finder_.find(system_, device_, reason)) return fail(reason.c_str());
  const int descriptor = system_.open(device_.c_str());
  if (descriptor < 0) return fail("cannot be opened", -descriptor, remedyOf(-descriptor));
  descriptor_ = descriptor;
  if (!setUp()) return false;
  is_set_up_ = true;
  finder_.opened(system_, device_);
  error_.clear();
  return true;
}

bool SerialPort::setUp() noexcept {
  const DeviceKind kind = system_.kind(descriptor_);
  if (kind == DeviceKind::kNoSerialDevice) return fail("is no serial device");
  is_pty_ = kind == DeviceKind::kPty;
  Sentence reason;
  if (const int result = system_.lock(descriptor_)) {
    if (result != -EWOULDBLOCK) return fail("cannot be locked", -result);
    const Sentence owner = system_.lockOwner(device_.c_str());
    reason.format("is in use by %s", owner.empty() ? "another process" : owner.c_str());
    return fail(reason.c_str());
  }
  const LineDemand demand = is_pty_ ? LineDemand::kNone : LineDemand::kExact;
  if (!setUpLine(system_, descriptor_, settings_.baud_rate, demand, reason) ||
      (!is_pty_ && !setUpRs485(system_, descriptor_, settings_.rs485, reason))) {
    return fail(reason.c_str());
  }
  setUpLatency(system_, descriptor_, device_.c_str(), warning_);
  RawLineCounters counters;
  if (system_.readCounters(descriptor_, counters) == 0) errors_.begin(counters);
  echo_.reset(is_pty_ && settings_.echo == EchoMode::kOn ? EchoMode::kAuto : settings_.echo);
  discardInput();
  return true;
}

void SerialPort::close() noexcept {
  if (descriptor_ < 0) return;
  static_cast<void>(lineCounters());  // the last errors before it goes
  system_.close(descriptor_);
  descriptor_ = -1;
  is_set_up_ = false;
  echo_.discard();
}

bool SerialPort::write(ByteView telegram) noexcept {
  if (descriptor_ < 0) return false;
  // One write per telegram: a gap between two would be a gap inside the telegram on the wire.
  long written = -EINTR;
  while (written == -EINTR) written = system_.write(descriptor_, telegram);
  if (written == static_cast<long>(telegram.size())) {
    echo_.sent(telegram);
    return true;
  }
  if (written >= 0 || written == -EAGAIN) return fail("does not take a whole telegram (its buffer is full)");
  if (meansUnplugged(-written)) return fail("was unplugged");
  return fail("cannot be written", static_cast<int>(-written));
}

long SerialPort::receive(std::uint8_t* buffer, std::size_t capacity) noexcept {
  const long count = system_.read(descriptor_, buffer, capacity);
  if (count > 0) return count;
  if (count == -EAGAIN || count == -EINTR) return 0;
  // A pty hangs up with 0 or EIO, an adapter with both.
  if (count == 0 || meansUnplugged(-count)) {
    fail("was unplugged");
  } else {
    fail("cannot be read", static_cast<int>(-count));
  }
  return 0;
}

void SerialPort::receiveThroughFilter() noexcept {
  std::uint8_t chunk[EchoFilter::kLongestChunk];
  const long count = receive(chunk, sizeof chunk);
  if (count > 0) echo_.heard({chunk, static_cast<std::size_t>(count)});
}

std::size_t SerialPort::read(std::uint8_t* buffer, std::size_t capacity) noexcept {
  if (descriptor_ < 0 || capacity == 0) return 0;
  if (!echo_.hasBytes()) {
    if (!echo_.expects()) return static_cast<std::size_t>(receive(buffer, capacity));
    receiveThroughFilter();
  }
  return echo_.take(buffer, capacity);
}

void SerialPort::discardInput() noexcept {
  if (descriptor_ < 0) return;
  system_.flushInput(descriptor_);
  echo_.discard();
}

bool SerialPort::waitReadable(Instant until) noexcept {
  while (descriptor_ >= 0) {
    if (echo_.hasBytes()) return true;
    const PollResult ready = system_.poll(descriptor_, until - now());
    if (ready.error != 0 && ready.error != EINTR) return fail("cannot be waited for", ready.error);
    if (ready.readable) {
      if (!echo_.expects()) return true;
      receiveThroughFilter();
    } else if (ready.hung_up) {
      return fail("was unplugged");
    } else if (now() >= until) {
      return false;
    }
  }
  return false;
}

LineCounters SerialPort::lineCounters() const noexcept {
  RawLineCounters counters;
  // A pty and some adapters have none.
  if (descriptor_ >= 0 && system_.readCounters(descriptor_, counters) == 0) errors_.update(counters);
  LineCounters total = errors_.total();
  total.collisions = echo_.collisions();
  return total;
}

}  // namespace nord_driver::link
