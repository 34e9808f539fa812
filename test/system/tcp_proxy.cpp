#include "system/tcp_proxy.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace nord_driver::test {

namespace {

using Lock = std::lock_guard<std::mutex>;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

int listenOn(std::uint16_t& port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address = loopback(port);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(socket, any, size) != 0 || ::listen(socket, 8) != 0 || ::getsockname(socket, any, &size) != 0) {
    throw std::runtime_error("no port on the loopback");
  }
  port = ntohs(address.sin_port);
  return socket;
}

void sendAtOnce(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// What there is; false: the other side is gone.
bool receive(int socket, TcpProxy::Bytes& bytes) {
  bytes.resize(4096);
  const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return count > 0;
}

}  // namespace

TcpProxy::TcpProxy(std::uint16_t server_port)
    : server_port_(server_port), listener_(listenOn(port_)), thread_([this] { serve(); }) {}

TcpProxy::~TcpProxy() {
  ending_ = true;
  thread_.join();
  closeAll(false);
  if (listener_ >= 0) ::close(listener_);
}

void TcpProxy::reset() {
  const Lock lock(mutex_);
  closeAll(true);
}

void TcpProxy::setPortOpen(bool open) {
  const Lock lock(mutex_);
  if (open == (listener_ >= 0)) return;
  if (open) {
    listener_ = listenOn(port_);
  } else {
    ::close(listener_);
    listener_ = -1;
    closeAll(true);
  }
}

void TcpProxy::setCarries(bool carries) {
  const Lock lock(mutex_);
  carries_ = carries;
}

void TcpProxy::setDelay(Duration delay) {
  const Lock lock(mutex_);
  delay_ = delay;
}

void TcpProxy::setSpoiler(std::function<void(Bytes&)> spoiler) {
  const Lock lock(mutex_);
  spoiler_ = std::move(spoiler);
}

void TcpProxy::close(Pair& pair, bool reset) {
  if (reset) {
    const linger at_once{1, 0};
    ::setsockopt(pair.client, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  }
  ::close(pair.client);
  ::close(pair.server);
}

void TcpProxy::closeAll(bool reset) {
  for (Pair& pair : pairs_) close(pair, reset);
  pairs_.clear();
}

// Looks again after a millisecond, whatever happens: so late are delayed answers at most.
void TcpProxy::serve() {
  while (!ending_) {
    std::vector<pollfd> waits;
    {
      const Lock lock(mutex_);
      waits.push_back({listener_, POLLIN, 0});
      for (const Pair& pair : pairs_) {
        waits.push_back({pair.client, POLLIN, 0});
        waits.push_back({pair.server, POLLIN, 0});
      }
    }
    const timespec step{0, 1'000'000};
    ::ppoll(waits.data(), waits.size(), &step, nullptr);

    const Lock lock(mutex_);
    const auto readable = [&](int socket) {
      return std::any_of(waits.begin(), waits.end(),
                         [socket](const pollfd& wait) { return wait.fd == socket && wait.revents != 0; });
    };
    const Instant now = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < pairs_.size();) {
      if (carry(pairs_[i], readable(pairs_[i].client), readable(pairs_[i].server))) {
        sendDue(pairs_[i++], now);
      } else {
        close(pairs_[i], false);
        pairs_.erase(pairs_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    if (listener_ >= 0 && readable(listener_)) accept();
  }
}

void TcpProxy::accept() {
  Pair pair;
  pair.client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (pair.client < 0) return;
  pair.server = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(server_port_);
  if (::connect(pair.server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return close(pair, true);
  }
  sendAtOnce(pair.client);
  sendAtOnce(pair.server);
  pairs_.push_back(std::move(pair));
}

bool TcpProxy::carry(Pair& pair, bool client_readable, bool server_readable) {
  Bytes bytes;
  if (client_readable) {
    if (!receive(pair.client, bytes)) return false;
    if (carries_) ::send(pair.server, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  if (server_readable) {
    if (!receive(pair.server, bytes)) return false;
    if (carries_ && spoiler_) spoiler_(bytes);
    if (carries_) pair.answers.push_back({std::chrono::steady_clock::now() + delay_, bytes});
  }
  return true;
}

void TcpProxy::sendDue(Pair& pair, Instant now) {
  while (!pair.answers.empty() && (pair.answers.front().due <= now || delay_ == Duration::zero())) {
    const Bytes& bytes = pair.answers.front().bytes;
    ::send(pair.client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    pair.answers.pop_front();
  }
}

}  // namespace nord_driver::test
