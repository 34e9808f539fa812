#include "link/can/virtual_can_hub.h"

#include <errno.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "link/can/packet_socket.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

/// About what a SocketCAN socket keeps for one that reads late.
constexpr int kRoomPerMember = 512;

}  // namespace

VirtualCanHub::VirtualCanHub(const CanSettings& settings) : VirtualCanEnd(settings) {
  if (problem_.empty() && !isVirtualCan(interface())) problem_.format("%s is no virtual bus", interface().c_str());
}

VirtualCanHub::~VirtualCanHub() {
  close();
}

bool VirtualCanHub::open() noexcept {
  close();
  listener_ = openSocket();
  if (listener_ < 0) return false;
  if (const int result = packet_socket::listen(listener_, interface())) {
    return result == -EADDRINUSE ? fail("another process has made a virtual bus of this name")
                                 : fail("the virtual bus cannot be made", -result);
  }
  opened();
  return true;
}

void VirtualCanHub::close() noexcept {
  if (listener_ < 0) return;
  for (Member& member : members_) {
    if (member.descriptor >= 0) disconnect(member, hub_counters_.left);
  }
  ::close(listener_);
  listener_ = -1;
  forgetKept();
}

std::size_t VirtualCanHub::members() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(members_.begin(), members_.end(), [](const Member& member) { return member.descriptor >= 0; }));
}

CanCounters VirtualCanHub::counters() const noexcept {
  CanCounters counters;
  counters.dropped = hub_counters_.lost;
  return counters;
}

void VirtualCanHub::takeNewMembers() noexcept {
  while (true) {
    const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) return;
    join(descriptor);
  }
}

void VirtualCanHub::join(int descriptor) noexcept {
  const auto free =
      std::find_if(members_.begin(), members_.end(), [](const Member& member) { return member.descriptor < 0; });
  if (free == members_.end()) {
    ++hub_counters_.refused;
    ::close(descriptor);
    return;
  }
  packet_socket::setRoom(descriptor, kRoomPerMember);
  *free = Member{descriptor, 0, 0};
  ++hub_counters_.joined;
}

void VirtualCanHub::disconnect(Member& member, std::uint64_t& reason) noexcept {
  ::close(member.descriptor);
  member.descriptor = -1;
  ++reason;
}

void VirtualCanHub::deliverTo(Member& member, const CanFrame& frame) noexcept {
  const int result = packet_socket::send(member.descriptor, toPacket(frame, member.next_number++));
  if (result == 0) {
    member.lost_in_a_row = 0;
  } else if (result != -EAGAIN) {
    disconnect(member, hub_counters_.left);
  } else {
    ++hub_counters_.lost;
    if (++member.lost_in_a_row >= kLostToDisconnect) disconnect(member, hub_counters_.stuck);
  }
}

void VirtualCanHub::deliver(const CanFrame& frame, const Member* sender) noexcept {
  for (Member& member : members_) {
    if (member.descriptor >= 0 && &member != sender) deliverTo(member, frame);
  }
}

CanSend VirtualCanHub::send(const CanFrame& frame) noexcept {
  if (listener_ < 0) return CanSend::kFailed;
  takeNewMembers();  // who has joined hears it
  deliver(frame, nullptr);
  return CanSend::kSent;
}

bool VirtualCanHub::takeFrom(Member& member, CanFrame& frame) noexcept {
  CanPacket packet;
  const long length = packet_socket::receive(member.descriptor, packet);
  if (length == -EAGAIN) return false;
  if (length <= 0) {
    disconnect(member, hub_counters_.left);
    return false;
  }
  const auto numbered = length == kCanPacketLength ? fromPacket(packet) : std::nullopt;
  if (!numbered) {
    disconnect(member, hub_counters_.malformed);
    return false;
  }
  frame = numbered->frame;
  return true;
}

bool VirtualCanHub::takeNext(ReceivedCanFrame& received) noexcept {
  if (listener_ < 0) return false;
  takeNewMembers();
  for (std::size_t quiet = 0; quiet < kMostMembers;) {
    Member& member = members_[turn_];
    turn_ = (turn_ + 1) % kMostMembers;
    CanFrame frame;
    if (member.descriptor < 0 || !takeFrom(member, frame)) {
      ++quiet;
      continue;
    }
    quiet = 0;
    deliver(frame, &member);
    if (!passes(frame)) continue;
    received = {frame, now()};
    return true;
  }
  return false;
}

bool VirtualCanHub::waitReadable(Instant until) noexcept {
  while (listener_ >= 0 && !hasKept()) {
    pollfd wait[kMostMembers + 1];
    for (std::size_t i = 0; i < kMostMembers; ++i) wait[i] = {members_[i].descriptor, POLLIN, 0};
    wait[kMostMembers] = {listener_, POLLIN, 0};
    const timespec left = toTimeout(until - now());
    if (::ppoll(wait, kMostMembers + 1, &left, nullptr) < 0 && errno != EINTR) {
      return fail("cannot be waited for", errno);
    }
    if (!keepNext() && now() >= until) return false;
  }
  return hasKept();
}

}  // namespace nord_driver::link
