#include "link/can/socket_can.h"

#include <errno.h>

#include <algorithm>
#include <cstdio>

#include "link/error_text.h"

namespace nord_driver::link {

namespace {

constexpr std::size_t kLongestInterfaceError = 500;
/// A controller that reports every single bit error must not hold the caller for ever.
constexpr int kMostErrorFramesAtOnce = 64;
constexpr int kMostMessagesAtOnce = 64;

/// The kernel tells what the controller's clock makes of the rate it was given: 498701 bit/s of 500000 at 38.4 MHz. 0.5 %,
/// as on a serial line; the rates of CANopen and DeviceNet are 20 % apart at least.
bool isOff(std::uint32_t wanted, std::uint32_t real) noexcept {
  constexpr std::uint64_t kPartOfRate = 200;
  const std::uint64_t error = real > wanted ? real - wanted : wanted - real;
  return error * kPartOfRate > wanted;
}

bool meansRemoved(int error) noexcept {
  return error == ENODEV || error == ENXIO;
}

std::vector<std::uint32_t> withoutRepeats(std::vector<std::uint32_t> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

SocketCan::SocketCan(const CanSettings& settings, CanSystem& system) : settings_(settings), system_(system) {
  error_.reserve(kLongestInterfaceError);  // so that naming an error in the bus cycle does not allocate
  settings_.ids = withoutRepeats(settings_.ids);
  settings_.remote_ids = withoutRepeats(settings_.remote_ids);
  static_cast<void>(checkCanSettings(settings_, problem_));
}

SocketCan::~SocketCan() {
  close();
}

bool SocketCan::fail(const char* what, int error) noexcept {
  char text[kLongestInterfaceError];
  std::snprintf(text, sizeof text, "%s: %s%s%s", settings_.interface.c_str(), what, error != 0 ? ": " : "",
                error != 0 ? ErrorText{error}.c_str() : "");
  close();
  error_.assign(text);
  return false;
}

void SocketCan::close() noexcept {
  if (descriptor_ < 0) return;
  readDropCount();  // the last ones before it goes
  system_.close(descriptor_);
  if (interface_messages_ >= 0) system_.close(interface_messages_);
  descriptor_ = interface_messages_ = -1;
  has_pending_ = queue_full_ = false;
}

bool SocketCan::open() noexcept {
  close();
  if (!problem_.empty()) {
    error_.assign(problem_.c_str());
    return false;
  }
  const int descriptor = system_.open();
  if (descriptor == -EAFNOSUPPORT || descriptor == -EPROTONOSUPPORT) {
    return fail("this kernel has no CAN (sudo modprobe can_raw; a simulator without it: interface virtual:NAME)");
  }
  if (descriptor < 0) return fail("no CAN socket", -descriptor);
  descriptor_ = descriptor;
  drop_count_ = 0;
  interface_messages_ = system_.openInterfaceMessages();  // before the interface is read, so that no change is missed
  CanInterface interface;
  if (const int result = system_.readInterface(settings_.interface.c_str(), interface)) {
    return result == -ENODEV ? fail("there is no such interface: is the adapter plugged in? (ip link show type can)")
                             : fail("the kernel does not tell about the interface", -result);
  }
  health_.opened(interface);
  if (!accept(interface) || !setUp(interface.index)) return false;
  error_.clear();
  return true;
}

/// What the interface is set to can be worked with. Asked again after each change: it can only be changed while down.
bool SocketCan::accept(const CanInterface& interface) noexcept {
  const char* name = interface.name.c_str();
  if (!interface.is_can) return fail("is no CAN interface");
  Sentence reason;
  if (interface.listen_only) {
    reason.format(
        "listens only and may send nothing: sudo ip link set %s down; sudo ip link set %s type can "
        "listen-only off; sudo ip link set %s up",
        name, name, name);
    return fail(reason.c_str());
  }
  if (settings_.bit_rate != 0 && interface.bit_rate != 0 && isOff(settings_.bit_rate, interface.bit_rate)) {
    reason.format(
        "runs at %u bit/s, and %u bit/s are configured: sudo ip link set %s down; sudo ip link set %s up type "
        "can bitrate %u",
        static_cast<unsigned>(interface.bit_rate), static_cast<unsigned>(settings_.bit_rate), name, name,
        static_cast<unsigned>(settings_.bit_rate));
    return fail(reason.c_str());
  }
  return true;
}

bool SocketCan::setUp(int index) noexcept {
  // Filters first: what arrives between bind() and a filter would be kept.
  const int filtered = settings_.ids.empty() ? 0 : system_.setFilters(descriptor_, settings_.ids, settings_.remote_ids);
  if (const int result = filtered) {
    return fail("does not take the filters", -result);
  }
  if (const int result = system_.setErrorFilter(descriptor_, kCanErrorClasses)) {
    return fail("does not take the filter of error frames", -result);
  }
  if (const int result = system_.setBuffers(descriptor_, kReceiveBuffer, kSmallestSendBuffer)) {
    return fail("does not take the sizes of the buffers", -result);
  }
  static_cast<void>(system_.enableTimeStamps(descriptor_));  // without: the time of reading
  empty_at_ = system_.now();
  next_restart_ = empty_at_;
  if (const int result = system_.bind(descriptor_, index)) {
    return meansRemoved(-result) ? fail("was removed") : fail("cannot be bound", -result);
  }
  return true;
}

void SocketCan::failedCall(const char* what, int error) noexcept {
  if (meansRemoved(error)) {
    fail("was removed");
  } else {
    fail(what, error);
  }
}

/// The socket keeps this error until it is read: the interface may be up again by now, and that message be read already.
void SocketCan::wentDown() noexcept {
  CanInterface interface;
  const int result = system_.readInterface(settings_.interface.c_str(), interface);
  if (result != 0 || interface.index != health_.interface().index) return health_.handleDown();
  if (accept(interface)) health_.handleInterface(interface);
}

CanSend SocketCan::send(const CanFrame& frame) noexcept {
  if (descriptor_ < 0) return CanSend::kFailed;
  tendBusOff();
  // The kernel would take and lose it, or keep it until it is old.
  if (health_.state() == CanState::kBusOff) return CanSend::kFailed;
  int result = -EINTR;
  while (result == -EINTR) result = system_.send(descriptor_, frame);
  if (result == 0) {
    health_.handleSent();
    return CanSend::kSent;
  }
  if (result == -EAGAIN || result == -ENOBUFS) {
    queue_full_ = result == -ENOBUFS;
    health_.handleQueueFull();
    return CanSend::kQueueFull;
  }
  if (result == -ENETDOWN) {
    health_.handleDown();
  } else {
    failedCall("cannot be written", -result);
  }
  return CanSend::kFailed;
}

/// The clock on the wall may have been set since the kernel stamped the frame. What is certain: it came after the
/// socket was last seen empty, and not in the future.
Instant SocketCan::arrival(const CanReceipt& receipt) const noexcept {
  const Instant now = system_.now();
  if (!receipt.has_age) return now;
  return std::min(now, std::max(empty_at_, now - receipt.age));
}

bool SocketCan::takeNext(ReceivedCanFrame& received) noexcept {
  for (int errors = 0; descriptor_ >= 0 && errors < kMostErrorFramesAtOnce; ++errors) {
    const Instant before = system_.now();
    CanReceipt receipt;
    const int result = system_.receive(descriptor_, receipt);
    if (result == -EINTR) continue;
    if (result == -EAGAIN) {
      empty_at_ = before;
      return false;
    }
    if (result == -ENETDOWN) {
      wentDown();
      return false;
    }
    if (result < 0) {
      failedCall("cannot be read", -result);
      return false;
    }
    if (!receipt.is_error) {
      health_.handleFrame();
      received = {receipt.frame, arrival(receipt)};
      return true;
    }
    health_.handleError(receipt.error, before);
  }
  return false;
}

bool SocketCan::receive(ReceivedCanFrame& received) noexcept {
  if (!has_pending_) return takeNext(received);
  received = pending_;
  has_pending_ = false;
  return true;
}

bool SocketCan::waitReadable(Instant until) noexcept {
  while (descriptor_ >= 0) {
    if (has_pending_) return true;
    const CanReady ready = system_.poll(descriptor_, interface_messages_, false, until - now());
    if (ready.error != 0 && ready.error != EINTR) return fail("cannot be waited for", ready.error);
    if (ready.messages) takeInterfaceMessages();
    if (ready.socket && takeNext(pending_)) has_pending_ = true;
    tendBusOff();
    if (!has_pending_ && now() >= until) return false;
  }
  return false;
}

bool SocketCan::waitWritable(Instant until) noexcept {
  if (descriptor_ < 0) return false;
  if (queue_full_) {
    queue_full_ = false;
    const Instant retry = now() + kQueueRetry;
    system_.sleepUntil(std::min(until, retry));
    return retry <= until;
  }
  while (true) {
    const CanReady ready = system_.poll(descriptor_, -1, true, until - now());
    if (ready.socket) return true;
    if (ready.error != 0 && ready.error != EINTR) return fail("cannot be waited for", ready.error);
    if (now() >= until) return false;
  }
}

void SocketCan::takeInterfaceMessages() noexcept {
  for (int i = 0; i < kMostMessagesAtOnce && interface_messages_ >= 0; ++i) {
    CanInterface interface;
    int result = system_.readInterfaceMessage(interface_messages_, interface);
    if (result == -EAGAIN) return;
    if (result == -ENOBUFS) {  // some were lost: ask
      result = system_.readInterface(settings_.interface.c_str(), interface);
      if (result == -ENODEV) return static_cast<void>(fail("was removed"));
    }
    if (result != 0 || interface.index != health_.interface().index) continue;
    if (interface.removed) {
      fail("was removed");
    } else if (accept(interface)) {
      health_.handleInterface(interface);
    }
  }
}

void SocketCan::tendBusOff() noexcept {
  if (!health_.wantsRestart()) return;
  const Instant at = now();
  if (at < next_restart_) return;
  next_restart_ = at + kRestartPeriod;
  const int result = system_.restart(health_.interface().index);
  if (result == -EPERM || result == -EACCES) health_.restartRefused();
}

void SocketCan::readDropCount() const noexcept {
  std::uint32_t count = 0;
  if (descriptor_ < 0 || system_.readDropCount(descriptor_, count) != 0) return;
  health_.addDropped(count - drop_count_);  // without a sign: right across the wrap
  drop_count_ = count;
}

CanCounters SocketCan::counters() const noexcept {
  readDropCount();
  return health_.counters();
}

}  // namespace nord_driver::link
