#include "link/can/packet_socket.h"

#include <errno.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include "link/can/can_settings.h"
#include "link/error_text.h"
#include "link/waiting.h"

namespace nord_driver::link::packet_socket {

namespace {

constexpr char kFolder[] = "nord_driver/can/";
/// What the kernel books for one packet.
constexpr int kBytesPerPacket = 768;

struct Address {
  sockaddr_un address{};
  socklen_t length = 0;

  /// The name begins with a zero: no file, gone with its maker.
  explicit Address(const std::string& interface) noexcept {
    const char* name = interface.c_str() + sizeof kVirtualCanPrefix - 1;
    const std::size_t size = std::min(std::strlen(name), kLongestVirtualName);
    static_assert(sizeof kFolder + kLongestVirtualName < sizeof address.sun_path, "the longest name fits");
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, kFolder, sizeof kFolder - 1);
    std::copy_n(name, size, address.sun_path + sizeof kFolder);
    length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + sizeof kFolder + size);
  }
  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(&address); }
};

}  // namespace

int open() noexcept {
  const int descriptor = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  return descriptor >= 0 ? descriptor : -errno;
}

int connect(int descriptor, const std::string& interface) noexcept {
  const Address address{interface};
  return ::connect(descriptor, address.get(), address.length) == 0 ? 0 : -errno;
}

int listen(int descriptor, const std::string& interface) noexcept {
  const Address address{interface};
  if (::bind(descriptor, address.get(), address.length) != 0) return -errno;
  constexpr int kWaitingToJoin = 16;
  return ::listen(descriptor, kWaitingToJoin) == 0 ? 0 : -errno;
}

void setRoom(int descriptor, int frames) noexcept {
  const int bytes = frames * kBytesPerPacket / 2;  // the kernel doubles it
  static_cast<void>(::setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes));
}

int send(int descriptor, const CanPacket& packet) noexcept {
  ssize_t sent = -1;
  do {
    sent = ::send(descriptor, packet.data(), packet.size(), MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent >= 0 ? 0 : -errno;
}

long receive(int descriptor, CanPacket& packet) noexcept {
  ssize_t length = -1;
  do {
    // With MSG_TRUNC the true length: a longer packet is no frame.
    length = ::recv(descriptor, packet.data(), packet.size(), MSG_TRUNC);
  } while (length < 0 && errno == EINTR);
  return length >= 0 ? length : -errno;
}

bool wait(int descriptor, short events, Instant until) noexcept {
  while (true) {
    const timespec left = toTimeout(until - std::chrono::steady_clock::now());
    pollfd one{descriptor, events, 0};
    const int ready = ::ppoll(&one, 1, &left, nullptr);
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

void describe(std::string& text, const std::string& interface, const char* what, int error) noexcept {
  char sentence[kLongestError];
  std::snprintf(sentence, sizeof sentence, "%s: %s%s%s", interface.c_str(), what, error != 0 ? ": " : "",
                error != 0 ? ErrorText{error}.c_str() : "");
  text.assign(sentence);
}

}  // namespace nord_driver::link::packet_socket
