#include "can_interface.h"

#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nord_driver::bench {

CanInterface::CanInterface(const std::string& name) : name_(name), far_(openSocket()) {}

CanInterface::~CanInterface() {
  for (const int end : {near_, far_}) {
    if (end >= 0) ::close(end);
  }
}

int CanInterface::near() {
  if (near_ < 0) near_ = openSocket();
  return near_;
}

int CanInterface::openSocket() const {
  const auto fail = [this] { throw std::system_error(errno, std::generic_category(), name_); };
  const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (socket < 0) fail();
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(name_.c_str()));
  if (address.can_ifindex != 0 && ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return socket;
  }
  ::close(socket);
  fail();
  return -1;
}

}  // namespace nord_driver::bench
