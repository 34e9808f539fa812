#include "register_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

#include "measure.h"

namespace nord_driver::bench {

namespace {

constexpr std::size_t kHeader = 6, kFunctionAt = 7, kCountAt = 10;
constexpr std::uint8_t kWrite = 16;
constexpr int kLook = 50;  // ms, between looks whether to end

std::int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool readWhole(int client, std::uint8_t* bytes, std::size_t size) {
  for (std::size_t have = 0; have < size;) {
    const ssize_t count = ::recv(client, bytes + have, size - have, 0);
    if (count <= 0) return false;
    have += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

RegisterServer::RegisterServer(unsigned processor) : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof any;
  auto* address = reinterpret_cast<sockaddr*>(&any);
  if (::bind(listener_, address, size) != 0 || ::listen(listener_, 4) != 0 ||
      ::getsockname(listener_, address, &size) != 0) {
    throw std::runtime_error("no port for a server");
  }
  port_ = ntohs(any.sin_port);
  thread_ = std::thread([this, processor] { serve(processor); });
}

RegisterServer::~RegisterServer() {
  stop_ = true;
  thread_.join();
  ::close(listener_);
}

void RegisterServer::serve(unsigned processor) {
  pinTo(processor);
  while (!stop_) {
    pollfd wait{listener_, POLLIN, 0};
    if (::poll(&wait, 1, kLook) <= 0) continue;
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0) continue;
    const int on = 1;
    ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    serve(client);
    ::close(client);
  }
}

void RegisterServer::serve(int client) {
  std::array<std::uint8_t, 260> request{};
  while (!stop_) {
    pollfd wait{client, POLLIN, 0};
    if (::poll(&wait, 1, kLook) <= 0) continue;
    if (!readWhole(client, request.data(), kHeader)) return;
    const std::size_t length = static_cast<std::size_t>(request[4] << 8 | request[5]);
    if (length < 6 || length > request.size() - kHeader || !readWhole(client, request.data() + kHeader, length)) return;
    const bool write = request[kFunctionAt] == kWrite;
    (write ? written_ : read_) = nowNs();
    if (stalled_) continue;
    // The answer to a write repeats what was written where; the inputs are status words of a drive at rest.
    std::array<std::uint8_t, 260> answer = request;
    std::size_t size = 12;
    if (!write) {
      const std::size_t count = request[kCountAt + 1];
      answer[8] = static_cast<std::uint8_t>(2 * count);
      for (std::size_t i = 0; i < count; ++i) {
        answer[9 + 2 * i] = i % 2 == 0 ? 0x0B : 0x00;
        answer[10 + 2 * i] = i % 2 == 0 ? 0x31 : 0x00;
      }
      size = 9 + 2 * count;
    }
    answer[4] = 0;
    answer[5] = static_cast<std::uint8_t>(size - kHeader);
    if (::send(client, answer.data(), size, MSG_NOSIGNAL) != static_cast<ssize_t>(size)) return;
  }
}

}  // namespace nord_driver::bench
