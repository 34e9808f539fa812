#include "link/can/virtual_can.h"

#include <errno.h>
#include <poll.h>
#include <unistd.h>

#include "link/can/packet_socket.h"

namespace nord_driver::link {

namespace {

/// A real interface has 8: enough for a burst to a whole robot, little enough that nothing old waits for long.
constexpr int kRoomToSend = 64;

}  // namespace

VirtualCan::VirtualCan(const CanSettings& settings) : VirtualCanEnd(settings) {}

VirtualCan::~VirtualCan() {
  close();
}

bool VirtualCan::open() noexcept {
  close();
  descriptor_ = openSocket();
  if (descriptor_ < 0) return false;
  packet_socket::setRoom(descriptor_, kRoomToSend);
  if (const int result = packet_socket::connect(descriptor_, interface())) {
    return result == -ECONNREFUSED || result == -ENOENT
               ? fail("there is no such virtual bus: is the simulator running?")
               : fail("the virtual bus does not let us in", -result);
  }
  next_number_ = 0;
  opened();
  return true;
}

void VirtualCan::close() noexcept {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  descriptor_ = -1;
  forgetKept();
}

CanSend VirtualCan::send(const CanFrame& frame) noexcept {
  if (descriptor_ < 0) return CanSend::kFailed;
  const int result = packet_socket::send(descriptor_, toPacket(frame, 0));
  if (result == 0) return CanSend::kSent;
  if (result == -EAGAIN) {
    ++counters_.queue_full;
    return CanSend::kQueueFull;
  }
  fail("the virtual bus has gone");
  return CanSend::kFailed;
}

bool VirtualCan::takeNext(ReceivedCanFrame& received) noexcept {
  while (descriptor_ >= 0) {
    CanPacket packet;
    const long length = packet_socket::receive(descriptor_, packet);
    if (length == -EAGAIN) return false;
    if (length <= 0) return fail("the virtual bus has gone");
    const auto numbered = length == kCanPacketLength ? fromPacket(packet) : std::nullopt;
    if (!numbered) return fail("the virtual bus speaks another version");
    counters_.dropped += static_cast<std::uint16_t>(numbered->number - next_number_);
    next_number_ = static_cast<std::uint16_t>(numbered->number + 1);
    if (!passes(numbered->frame)) continue;
    received = {numbered->frame, now()};
    return true;
  }
  return false;
}

bool VirtualCan::waitReadable(Instant until) noexcept {
  while (descriptor_ >= 0 && !hasKept()) {
    if (!packet_socket::wait(descriptor_, POLLIN, until)) return false;
    if (!keepNext() && now() >= until) return false;
  }
  return hasKept();
}

bool VirtualCan::waitWritable(Instant until) noexcept {
  return descriptor_ >= 0 && packet_socket::wait(descriptor_, POLLOUT, until);
}

}  // namespace nord_driver::link
