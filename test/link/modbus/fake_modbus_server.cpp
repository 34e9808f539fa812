#include "link/modbus/fake_modbus_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

namespace nord_driver::link::test {

namespace {

using Lock = std::unique_lock<std::mutex>;

int listenOn(std::uint16_t& port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(socket, any, size) != 0 || ::listen(socket, 8) != 0 || ::getsockname(socket, any, &size) != 0) {
    throw std::runtime_error("no port on the loopback");
  }
  port = ntohs(address.sin_port);
  return socket;
}

std::size_t u16(const Bytes& bytes, std::size_t at) {
  return static_cast<std::size_t>(bytes.at(at)) << 8 | bytes.at(at + 1);
}

void put16(Bytes& bytes, std::size_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFu));
}

}  // namespace

FakeModbusServer::FakeModbusServer() : listener_(listenOn(port_)), thread_([this] { run(); }) {}

FakeModbusServer::~FakeModbusServer() {
  {
    const Lock lock(mutex_);
    ending_ = true;
  }
  wakeup_.signal();
  thread_.join();
  for (const auto& client : clients_) ::close(client.first);
  if (listener_ >= 0) ::close(listener_);
}

void FakeModbusServer::next(Reaction reaction) {
  const Lock lock(mutex_);
  next_.push_back(std::move(reaction));
}

void FakeModbusServer::always(Reaction reaction) {
  const Lock lock(mutex_);
  always_ = std::move(reaction);
}

void FakeModbusServer::release() {
  const Lock lock(mutex_);
  for (const auto& [client, bytes] : held_) {
    if (clients_.count(client) != 0) send(client, bytes);
  }
  held_.clear();
}

void FakeModbusServer::shut() {
  Lock lock(mutex_);
  listening_ = false;
  wakeup_.signal();
  happened_.wait(lock, [&] { return listener_ < 0; });
}

void FakeModbusServer::listenAgain() {
  const Lock lock(mutex_);
  listener_ = listenOn(port_);
  listening_ = true;
  wakeup_.signal();
}

void FakeModbusServer::setInput(std::size_t address, std::uint16_t value) {
  const Lock lock(mutex_);
  inputs_.at(address) = value;
}

void FakeModbusServer::setHolding(std::size_t address, std::uint16_t value) {
  const Lock lock(mutex_);
  holdings_.at(address) = value;
}

std::uint16_t FakeModbusServer::holding(std::size_t address) const {
  const Lock lock(mutex_);
  return holdings_.at(address);
}

void FakeModbusServer::protect(std::size_t address) {
  const Lock lock(mutex_);
  protected_ = address;
}

void FakeModbusServer::refuse(std::size_t address) {
  const Lock lock(mutex_);
  refused_ = address;
}

std::vector<Bytes> FakeModbusServer::requests() const {
  const Lock lock(mutex_);
  return requests_;
}

std::size_t FakeModbusServer::connections() const {
  const Lock lock(mutex_);
  return connections_;
}

bool FakeModbusServer::waitFor(const std::function<bool()>& condition) const {
  Lock lock(mutex_);
  return happened_.wait_for(lock, std::chrono::seconds{20}, condition);
}

void FakeModbusServer::run() {
  for (;;) {
    std::vector<pollfd> waits;
    {
      const Lock lock(mutex_);
      if (ending_) return;
      wakeup_.take();
      if (!listening_ && listener_ >= 0) {
        while (!clients_.empty()) drop(clients_.begin()->first, false);
        ::close(listener_);
        listener_ = -1;
        happened_.notify_all();
      }
      waits.push_back({wakeup_.descriptor(), POLLIN, 0});
      if (listener_ >= 0) waits.push_back({listener_, POLLIN, 0});
      for (const auto& client : clients_) waits.push_back({client.first, POLLIN, 0});
    }
    ::poll(waits.data(), waits.size(), -1);
    const Lock lock(mutex_);
    for (const pollfd& wait : waits) {
      if (wait.revents == 0 || wait.fd == wakeup_.descriptor()) continue;
      if (wait.fd == listener_) {
        accept();
      } else if (clients_.count(wait.fd) != 0) {
        receive(wait.fd);
      }
    }
    happened_.notify_all();
  }
}

void FakeModbusServer::accept() {
  const int client = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (client < 0) return;
  clients_[client];
  ++connections_;
}

void FakeModbusServer::receive(int client) {
  std::uint8_t buffer[4096];
  const ssize_t size = ::recv(client, buffer, sizeof buffer, 0);
  if (size <= 0) return drop(client, false);
  Bytes& waiting = clients_[client];
  waiting.insert(waiting.end(), buffer, buffer + size);
  while (waiting.size() >= 8 && waiting.size() >= 6 + u16(waiting, 4)) {
    const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(6 + u16(waiting, 4));
    const Bytes request(waiting.begin(), end);
    waiting.erase(waiting.begin(), end);
    requests_.push_back(request);
    handle(client, request);
    if (clients_.count(client) == 0) return;
  }
}

void FakeModbusServer::handle(int client, const Bytes& request) {
  Reaction reaction = always_;
  if (!next_.empty()) {
    reaction = next_.front();
    next_.pop_front();
  }
  react(client, request, reaction);
}

void FakeModbusServer::react(int client, const Bytes& request, const Reaction& reaction) {
  Bytes good = reaction.way == Reaction::kException ? Bytes{} : answer(request);
  switch (reaction.way) {
    case Reaction::kAnswer:
      return send(client, good);
    case Reaction::kSilent:
      return;
    case Reaction::kHold:
      held_.emplace_back(client, good);
      return;
    case Reaction::kPart:
      good.resize(reaction.value);
      return send(client, good);
    case Reaction::kTransaction:
      good[1] = static_cast<std::uint8_t>(good[1] + reaction.value);
      good.back() ^= 0xFF;  // nor are its data those asked for
      return send(client, good);
    case Reaction::kProtocol:
      good[3] = static_cast<std::uint8_t>(reaction.value);
      return send(client, good);
    case Reaction::kUnit:
      good[6] = static_cast<std::uint8_t>(reaction.value);
      good.back() ^= 0xFF;
      return send(client, good);
    case Reaction::kFunction:
      good[7] = static_cast<std::uint8_t>(reaction.value);
      return send(client, good);
    case Reaction::kLength:
      good[5] = static_cast<std::uint8_t>(good[5] + reaction.value);
      return send(client, good);
    case Reaction::kException:
      good = {request[0],
              request[1],
              0,
              0,
              0,
              3,
              request[6],
              static_cast<std::uint8_t>(request[7] | 0x80u),
              static_cast<std::uint8_t>(reaction.value)};
      return send(client, good);
    case Reaction::kTwice:
      good.insert(good.end(), good.begin(), good.end());
      return send(client, good);
    case Reaction::kClose:
      return drop(client, false);
    case Reaction::kReset:
      return drop(client, true);
    case Reaction::kRaw:
      return send(client, reaction.bytes);
  }
}

void FakeModbusServer::drop(int client, bool reset) {
  const linger at_once{1, 0};
  if (reset) ::setsockopt(client, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  ::close(client);
  clients_.erase(client);
}

void FakeModbusServer::send(int client, const Bytes& bytes) {
  ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

Bytes FakeModbusServer::answer(const Bytes& request) {
  const Bytes pdu(request.begin() + 7, request.end());
  const Bytes data = answerData(pdu);
  Bytes bytes{request[0], request[1], 0, 0};
  put16(bytes, data.size() + 1);
  bytes.push_back(request[6]);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

Bytes FakeModbusServer::answerData(const Bytes& pdu) {
  const std::uint8_t function = pdu.at(0);
  const auto refuse = [&](std::uint8_t code) { return Bytes{static_cast<std::uint8_t>(function | 0x80u), code}; };
  if (function != 3 && function != 4 && function != 16 && function != 23) return refuse(1);
  const std::size_t address = u16(pdu, 1), count = u16(pdu, 3);
  const bool has_write = function == 16 || function == 23;
  const std::size_t write_at = function == 23 ? 5 : 1;  // where the written range stands
  const std::size_t write_address = has_write ? u16(pdu, write_at) : 0, writes = has_write ? u16(pdu, write_at + 2) : 0;
  const bool good_counts =
      count >= 1 && count <= (function == 16 ? 123u : 125u) &&
      (!has_write || (writes >= 1 && writes <= (function == 23 ? 121u : 123u) && pdu.at(write_at + 4) == 2 * writes &&
                      pdu.size() == write_at + 5 + 2 * writes));
  if (!good_counts) return refuse(3);
  if (address + count > kRegisters || write_address + writes > kRegisters) return refuse(2);
  const auto touches = [&](std::size_t first, std::size_t words) {
    return refused_ >= first && refused_ < first + words;
  };
  if (touches(address, count) || touches(write_address, writes)) return refuse(6);
  for (std::size_t i = 0; i < writes; ++i) {
    if (write_address + i != protected_) {
      holdings_[write_address + i] = static_cast<std::uint16_t>(u16(pdu, write_at + 5 + 2 * i));
    }
  }
  if (function == 16) return Bytes(pdu.begin(), pdu.begin() + 5);
  Bytes data{function, static_cast<std::uint8_t>(2 * count)};
  const auto& from = function == 4 ? inputs_ : holdings_;
  for (std::size_t i = 0; i < count; ++i) put16(data, from[address + i]);
  return data;
}

}  // namespace nord_driver::link::test
