#include "link/modbus/tcp_connect.h"

#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include "link/error_text.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

bool set(int socket, int level, int option, int value) noexcept {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

bool setUp(int socket) noexcept {
  return set(socket, IPPROTO_TCP, TCP_NODELAY, 1) && set(socket, SOL_SOCKET, SO_KEEPALIVE, 1) &&
         set(socket, IPPROTO_TCP, TCP_KEEPIDLE, 1) && set(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1) &&
         set(socket, IPPROTO_TCP, TCP_KEEPCNT, 3) &&
         set(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(kUserTimeout.count()));
}

/// 0, or what went wrong.
int finish(int socket, Instant until, const Wakeup& stop) noexcept {
  pollfd waits[] = {{socket, POLLOUT, 0}, {stop.descriptor(), POLLIN, 0}};
  for (;;) {
    const timespec left = toTimeout(until - std::chrono::steady_clock::now());
    const int ready = ::ppoll(waits, 2, &left, nullptr);
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) return errno;
    if (waits[1].revents != 0) return ECANCELED;
    if (waits[0].revents == 0) return ETIMEDOUT;
    int error = 0;
    socklen_t size = sizeof error;
    return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
  }
}

int tryOne(const SocketAddress& address, Instant until, const Wakeup& stop, int& socket) noexcept {
  socket = ::socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, IPPROTO_TCP);
  if (socket < 0) return errno;
  // libmodbus waits by select(), which has no room for more.
  if (socket >= FD_SETSIZE) return EMFILE;
  if (!setUp(socket)) return errno;
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address.storage), address.size) == 0) return 0;
  return errno == EINPROGRESS ? finish(socket, until, stop) : errno;
}

}  // namespace

Sentence connectFailure(int error) noexcept {
  Sentence text;
  switch (error) {
    case ECONNREFUSED:
      text.format("refuses the connection: is its Modbus/TCP server switched on, and is this its port?");
      break;
    case EHOSTUNREACH:
    case ENETUNREACH:
    case EHOSTDOWN:
    case ENETDOWN:
      text.format("cannot be reached (%s): is it powered, plugged in, and in the same network as this computer?",
                  ErrorText(error).c_str());
      break;
    case ETIMEDOUT:
      text.format("does not answer a request to connect: is it powered and plugged in, and is the address right?");
      break;
    case ECANCELED:
      text.format("was not waited for: the link is being closed");
      break;
    default:
      text.format("could not be connected to: %s", ErrorText(error).c_str());
  }
  return text;
}

int connectTcp(const std::vector<SocketAddress>& addresses, Instant until, const Wakeup& stop, Sentence& reason) {
  int error = EHOSTUNREACH;
  auto left = static_cast<Duration::rep>(addresses.size());
  for (const SocketAddress& address : addresses) {
    int socket = -1;
    const Instant now = std::chrono::steady_clock::now();
    error = tryOne(address, now + (until - now) / left--, stop, socket);
    if (error == 0) return socket;
    if (socket >= 0) ::close(socket);
    if (error == ECANCELED) break;
  }
  reason = connectFailure(error);
  return -1;
}

}  // namespace nord_driver::link
