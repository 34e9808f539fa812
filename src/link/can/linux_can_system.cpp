#include <errno.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "link/can/can_settings.h"
#include "link/can/can_system.h"
#include "link/can/netlink_can.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

template <typename T>
int setOption(int descriptor, int level, int name, const T& value) noexcept {
  return ::setsockopt(descriptor, level, name, &value, sizeof value) == 0 ? 0 : -errno;
}

can_frame toKernel(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0u) | (frame.remote ? CAN_RTR_FLAG : 0u);
  raw.can_dlc = frame.size;
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

void fromKernel(const can_frame& raw, CanReceipt& receipt) noexcept {
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    receipt.is_error = true;
    receipt.error.classes = raw.can_id & CAN_ERR_MASK;
    std::copy(std::begin(raw.data), std::end(raw.data), receipt.error.data.begin());
    return;
  }
  receipt.is_error = false;
  receipt.frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  receipt.frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  receipt.frame.id = raw.can_id & (receipt.frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  receipt.frame.size = std::min<std::uint8_t>(raw.can_dlc, CAN_MAX_DLEN);
  std::copy(std::begin(raw.data), std::end(raw.data), receipt.frame.data.begin());
}

void readAge(msghdr& message, CanReceipt& receipt) noexcept {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{}, now{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    ::clock_gettime(CLOCK_REALTIME, &now);
    receipt.age =
        std::chrono::seconds{now.tv_sec - stamp.tv_sec} + std::chrono::nanoseconds{now.tv_nsec - stamp.tv_nsec};
    receipt.has_age = true;
  }
}

class LinuxCanSystem final : public CanSystem {
 public:
  int open() noexcept override {
    const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    return descriptor >= 0 ? descriptor : -errno;
  }
  void close(int descriptor) noexcept override { ::close(descriptor); }

  int readInterface(const char* name, CanInterface& interface) noexcept override {
    return netlink::readInterface(name, interface);
  }
  int restart(int index) noexcept override { return netlink::restart(index); }
  int openInterfaceMessages() noexcept override { return netlink::openInterfaceMessages(); }
  int readInterfaceMessage(int descriptor, CanInterface& interface) noexcept override {
    return netlink::readInterfaceMessage(descriptor, interface);
  }

  int setFilters(int descriptor, const std::vector<std::uint32_t>& ids,
                 const std::vector<std::uint32_t>& remote_ids) noexcept override {
    // The flags in the mask: no extended frames, and remote ones only where the identifier has their flag, too; and the
    // kernel looks the filters of data frames up in a table instead of walking a list (Documentation/networking/can.rst
    // 4.1.1).
    constexpr canid_t kExact = CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK;
    std::array<can_filter, kMostCanIds> filters;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ids.size() && count < filters.size(); ++i) filters[count++] = {ids[i], kExact};
    for (std::size_t i = 0; i < remote_ids.size() && count < filters.size(); ++i) {
      filters[count++] = {remote_ids[i] | CAN_RTR_FLAG, kExact};
    }
    return ::setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                        static_cast<socklen_t>(count * sizeof(can_filter))) == 0
               ? 0
               : -errno;
  }
  int setErrorFilter(int descriptor, std::uint32_t classes) noexcept override {
    const can_err_mask_t mask = classes;
    return setOption(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, mask);
  }
  int setBuffers(int descriptor, int receive, int send) noexcept override {
    const int result = setOption(descriptor, SOL_SOCKET, SO_RCVBUF, receive);
    return result == 0 ? setOption(descriptor, SOL_SOCKET, SO_SNDBUF, send) : result;
  }
  int enableTimeStamps(int descriptor) noexcept override {
    constexpr int kOn = 1;
    return setOption(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, kOn);
  }
  int bind(int descriptor, int index) noexcept override {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = index;
    return ::bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 ? 0 : -errno;
  }

  int send(int descriptor, const CanFrame& frame) noexcept override {
    const can_frame raw = toKernel(frame);
    return ::write(descriptor, &raw, sizeof raw) >= 0 ? 0 : -errno;
  }
  int receive(int descriptor, CanReceipt& receipt) noexcept override {
    can_frame raw{};
    iovec part{&raw, sizeof raw};
    alignas(cmsghdr) std::uint8_t control[CMSG_SPACE(sizeof(timespec))];
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    const ssize_t length = ::recvmsg(descriptor, &message, 0);
    if (length < 0) return -errno;
    fromKernel(raw, receipt);
    readAge(message, receipt);
    return 0;
  }
  // Not SO_RXQ_OVFL: it rides on the next frame that finds room, and this is true at once.
  int readDropCount(int descriptor, std::uint32_t& count) noexcept override {
    std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
    socklen_t size = sizeof info;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0) return -errno;
    count = info[SK_MEMINFO_DROPS];
    return 0;
  }
  CanReady poll(int descriptor, int messages, bool to_write, Duration timeout) noexcept override {
    const timespec left = toTimeout(timeout);
    const short wanted = to_write ? POLLOUT : POLLIN;
    pollfd wait[] = {{descriptor, wanted, 0}, {messages, POLLIN, 0}};
    CanReady ready;
    if (::ppoll(wait, 2, &left, nullptr) < 0) {
      ready.error = errno;
      return ready;
    }
    ready.socket = wait[0].revents != 0;
    ready.messages = wait[1].revents != 0;
    return ready;
  }

  Instant now() const noexcept override { return std::chrono::steady_clock::now(); }
  void sleepUntil(Instant when) noexcept override { sleepUntilInstant(when); }
};

}  // namespace

CanSystem& linuxCanSystem() noexcept {
  static LinuxCanSystem system;
  return system;
}

}  // namespace nord_driver::link
