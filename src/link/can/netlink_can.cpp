#include "link/can/netlink_can.h"

#include <errno.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nord_driver::link::netlink {

namespace {

/// One message about an interface is 1 to 2 KiB; the kernel sends no more than 8 KiB at once here.
constexpr std::size_t kLongestMessage = 16'384;

class Socket {
 public:
  Socket() noexcept : descriptor_(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int descriptor() const noexcept { return descriptor_; }
  int release() noexcept {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return descriptor;
  }

 private:
  int descriptor_;
};

/// As the kernel lays it out.
struct Message {
  nlmsghdr header{};
  ifinfomsg info{};
  std::uint8_t attributes[64] = {};
};
static_assert(offsetof(Message, attributes) == NLMSG_LENGTH(sizeof(ifinfomsg)), "no gap between the parts");

/// A request about one interface.
class Request {
 public:
  Request(std::uint16_t type, std::uint16_t flags, int index) noexcept {
    message_.header.nlmsg_len = NLMSG_LENGTH(sizeof(ifinfomsg));
    message_.header.nlmsg_type = type;
    message_.header.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | flags);
    message_.info.ifi_index = index;
  }
  const Message& message() const noexcept { return message_; }

  /// Opens an attribute; its place, for close().
  std::size_t open(std::uint16_t type) noexcept {
    const std::size_t at = used_;
    rtattr attribute{};
    attribute.rta_type = type;
    append(&attribute, sizeof attribute);
    return at;
  }
  void append(const void* bytes, std::size_t count) noexcept {
    assert(used_ + RTA_ALIGN(count) <= sizeof message_.attributes);
    std::memcpy(message_.attributes + used_, bytes, count);
    used_ += RTA_ALIGN(count);
  }
  void close(std::size_t at) noexcept {
    const auto length = static_cast<std::uint16_t>(used_ - at);
    std::memcpy(message_.attributes + at + offsetof(rtattr, rta_len), &length, sizeof length);
    message_.header.nlmsg_len = static_cast<std::uint32_t>(NLMSG_LENGTH(sizeof(ifinfomsg)) + used_);
  }

 private:
  Message message_;
  std::size_t used_ = 0;
};

/// Sends the request and takes the answer; its length, or -errno. The kernel answers before send() returns.
long ask(const Message& request, std::uint8_t* answer, std::size_t capacity) noexcept {
  const Socket socket;
  if (socket.descriptor() < 0) return -errno;
  sockaddr_nl kernel{};
  kernel.nl_family = AF_NETLINK;
  if (::sendto(socket.descriptor(), &request, request.header.nlmsg_len, 0, reinterpret_cast<sockaddr*>(&kernel),
               sizeof kernel) < 0) {
    return -errno;
  }
  const ssize_t length = ::recv(socket.descriptor(), answer, capacity, 0);
  return length >= 0 ? length : -errno;
}

/// The error code of an answer that is nothing but one; 1 when it is something else.
int errorIn(ByteView answer) noexcept {
  nlmsghdr header{};
  nlmsgerr error{};
  if (answer.size() < NLMSG_HDRLEN + sizeof error) return 1;
  std::memcpy(&header, answer.data(), sizeof header);
  std::memcpy(&error, answer.data() + NLMSG_HDRLEN, sizeof error);
  return header.nlmsg_type == NLMSG_ERROR ? error.error : 1;
}

}  // namespace

int readInterface(const char* name, CanInterface& interface) noexcept {
  Request request(RTM_GETLINK, 0, 0);
  const std::size_t at = request.open(IFLA_IFNAME);
  request.append(name, std::strlen(name) + 1);
  request.close(at);
  alignas(nlmsghdr) std::uint8_t answer[kLongestMessage];
  const long length = ask(request.message(), answer, sizeof answer);
  if (length < 0) return static_cast<int>(length);
  const ByteView message{answer, static_cast<std::size_t>(length)};
  const int error = errorIn(message);
  if (error <= 0) return error == 0 ? -EPROTO : error;
  return parseLinkMessage(message, interface) ? 0 : -EPROTO;
}

// What `ip link set canX type can restart` sends.
int restart(int index) noexcept {
  Request request(RTM_NEWLINK, NLM_F_ACK, index);
  const std::size_t link_info = request.open(IFLA_LINKINFO);
  const std::size_t kind = request.open(IFLA_INFO_KIND);
  request.append("can", 4);
  request.close(kind);
  const std::size_t data = request.open(IFLA_INFO_DATA);
  const std::size_t value = request.open(IFLA_CAN_RESTART);
  constexpr std::uint32_t kNow = 1;
  request.append(&kNow, sizeof kNow);
  request.close(value);
  request.close(data);
  request.close(link_info);
  alignas(nlmsghdr) std::uint8_t answer[kLongestMessage];
  const long length = ask(request.message(), answer, sizeof answer);
  if (length < 0) return static_cast<int>(length);
  const int error = errorIn({answer, static_cast<std::size_t>(length)});
  return error == 1 ? -EPROTO : error;
}

int openInterfaceMessages() noexcept {
  Socket socket;
  if (socket.descriptor() < 0) return -errno;
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK;
  if (::bind(socket.descriptor(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return -errno;
  return socket.release();
}

int readInterfaceMessage(int descriptor, CanInterface& interface) noexcept {
  alignas(nlmsghdr) std::uint8_t message[kLongestMessage];
  const ssize_t length = ::recv(descriptor, message, sizeof message, 0);
  if (length < 0) return -errno;
  return parseLinkMessage({message, static_cast<std::size_t>(length)}, interface) ? 0 : -EPROTO;
}

}  // namespace nord_driver::link::netlink
