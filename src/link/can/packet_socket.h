// AF_UNIX SOCK_SEQPACKET as the virtual CAN bus uses it.
#pragma once

#include <string>

#include "link/can/can_packet.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link::packet_socket {

constexpr std::size_t kLongestError = 500;

/// Not blocking. Each gives 0 (or a descriptor) and otherwise -errno.
int open() noexcept;
int connect(int descriptor, const std::string& interface) noexcept;
int listen(int descriptor, const std::string& interface) noexcept;
/// About this many frames may wait for the other side to read them.
void setRoom(int descriptor, int frames) noexcept;

int send(int descriptor, const CanPacket& packet) noexcept;
/// The length of a packet (cut at its capacity), 0 when the other side has gone, or -errno.
long receive(int descriptor, CanPacket& packet) noexcept;
/// True when `events` (POLLIN, POLLOUT) or a failure is there before `until`. Over when `until` has come.
bool wait(int descriptor, short events, Instant until) noexcept;

/// "INTERFACE: what: the error's text" into `text`, which has reserved kLongestError characters. `error` 0: without it.
void describe(std::string& text, const std::string& interface, const char* what, int error) noexcept;

}  // namespace nord_driver::link::packet_socket
