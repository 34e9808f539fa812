#include "sim/interbus/gateway_bus.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/model_clock.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);

}  // namespace

GatewayBus::GatewayBus(const SimConfig& config)
    : robot_(config), ring_(robot_), gateway_(config.bus.as<IbsBusConfig>(), ring_) {
  listenAt(gatewayPort(config.bus.as<IbsBusConfig>().gateway));
  ring_.advance(std::chrono::steady_clock::now());
  thread_ = std::thread([this] { serve(); });
}

GatewayBus::~GatewayBus() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  for (Client& client : clients_) close(client);
  if (listener_ >= 0) ::close(listener_);
}

void GatewayBus::listenAt(std::uint16_t port) {
  const auto fail = [port](const char* what) {
    throw std::runtime_error("bus/gateway: " + std::string(what) + " port " + std::to_string(port) + ": " +
                             std::strerror(errno));
  };
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0) fail("no socket for");
  const int on = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  socklen_t size = sizeof address;
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 || ::listen(listener_, 4) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    const int error = errno;
    ::close(listener_);
    errno = error;
    fail("cannot listen at");
  }
  port_ = ntohs(address.sin_port);
}

void GatewayBus::close(Client& client) noexcept {
  if (client.socket >= 0) ::close(client.socket);
  client = Client{};
}

void GatewayBus::serve() noexcept {
  becomeRealTime();
  ModelClock clock{std::chrono::steady_clock::now()};
  while (!stop_) {
    std::array<pollfd, kClients + 1> waits{};
    for (std::size_t i = 0; i < kClients; ++i) waits[i] = {clients_[i].socket, POLLIN, 0};
    waits[kClients] = {listener_, POLLIN, 0};
    const timespec timeout{0, kStep.count()};
    ::ppoll(waits.data(), waits.size(), &timeout, nullptr);

    const std::lock_guard<InheritingMutex> lock(mutex_);
    const Instant now = modelTime(clock, std::chrono::steady_clock::now());
    ring_.advance(now);
    gateway_.advance(now);
    for (std::size_t i = 0; i < kClients; ++i) {
      if (clients_[i].socket < 0) continue;
      if (waits[i].revents != 0 && !receive(clients_[i])) {
        close(clients_[i]);
      } else {
        answerNext(clients_[i], now);
      }
    }
    if (waits[kClients].revents != 0) accept();
  }
}

void GatewayBus::accept() noexcept {
  const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (socket < 0) return;
  for (Client& client : clients_) {
    if (client.socket >= 0) continue;
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    client.socket = socket;
    ring_.masterBegins();
    return;
  }
  ::close(socket);
}

// False: the client is gone, or sends what is no request.
bool GatewayBus::receive(Client& client) noexcept {
  std::array<std::uint8_t, kLongestModbus> buffer{};
  const std::size_t room = std::min(buffer.size(), client.input.capacity() - client.input.size());
  if (room == 0) return false;
  const ssize_t count = ::recv(client.socket, buffer.data(), room, 0);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  for (ssize_t i = 0; i < count; ++i) client.input.push_back(buffer[static_cast<std::size_t>(i)]);
  return count > 0;
}

// One request after the other: the next one is taken when the answer before it has gone out.
void GatewayBus::answerNext(Client& client, Instant now) noexcept {
  for (;;) {
    if (client.answer.empty()) {
      const std::size_t length = modbusLength(client.input);
      if (length == 0) return;
      client.answer = gateway_.handle(ByteView{client.input}.sub(0, length), now);
      client.due = now + gateway_.switches().delay;
      client.input.eraseFront(length);
      if (client.answer.empty()) continue;
    }
    if (now < client.due) return;
    ::send(client.socket, client.answer.data(), client.answer.size(), MSG_NOSIGNAL);
    client.answer.clear();
  }
}

}  // namespace nord_driver::sim
