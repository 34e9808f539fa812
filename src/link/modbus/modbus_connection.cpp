#include "link/modbus/modbus_connection.h"

#include <errno.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "link/error_text.h"
#include "link/modbus/tcp_connect.h"
#include "link/waiting.h"

namespace nord_driver::link {

static_assert(kLongestAdu == MODBUS_TCP_MAX_ADU_LENGTH && kMostReadRegisters == MODBUS_MAX_READ_REGISTERS &&
              kMostWriteRegisters == MODBUS_MAX_WRITE_REGISTERS &&
              kMostReadWriteWrites == MODBUS_MAX_WR_WRITE_REGISTERS);

namespace {

Instant now() noexcept {
  return std::chrono::steady_clock::now();
}

ServerName nameOf(const ModbusSettings& settings) {
  Sentence ignored;
  return serverName(settings.server, ignored).value_or(ServerName{});
}

enum class Wait : std::uint8_t { kReadable, kTimeout, kStopped };

Wait waitReadable(int socket, Instant until, const Wakeup& stop) noexcept {
  pollfd waits[] = {{socket, POLLIN, 0}, {stop.descriptor(), POLLIN, 0}};
  for (;;) {
    const timespec left = toTimeout(until - now());
    const int ready = ::ppoll(waits, 2, &left, nullptr);
    if (ready < 0 && errno == EINTR) continue;
    if (waits[1].revents != 0) return Wait::kStopped;
    return ready > 0 ? Wait::kReadable : Wait::kTimeout;
  }
}

}  // namespace

void ModbusConnection::Release::operator()(_modbus* context) const noexcept {
  ::modbus_free(context);
}

ModbusConnection::ModbusConnection(const ModbusSettings& settings, LookUp look_up)
    : settings_(settings),
      resolver_(nameOf(settings), std::move(look_up)),
      context_(::modbus_new_tcp(nullptr, MODBUS_TCP_DEFAULT_PORT)) {
  if (!context_) return;
  ::modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  ::modbus_set_byte_timeout(context_.get(), 0, 0);  // the response time-out is for the whole answer
}

ModbusConnection::~ModbusConnection() {
  close();
}

bool ModbusConnection::fail(ModbusTrouble trouble, const char* what) noexcept {
  trouble_ = trouble;
  reason_.format("%s %s", settings_.server.c_str(), what);
  return false;
}

bool ModbusConnection::open(const Wakeup& stop) noexcept {
  close();
  const Instant until = now() + settings_.connect_timeout;
  Sentence what;
  try {
    std::vector<SocketAddress> addresses;
    if (!context_) return fail(ModbusTrouble::kNoConnection, "cannot be spoken to: libmodbus found no memory");
    if (!resolver_.resolve(until, stop, addresses, what)) {
      trouble_ = ModbusTrouble::kNoConnection;
      reason_ = what;
      return false;
    }
    socket_ = connectTcp(addresses, until, stop, what);
  } catch (const std::exception& error) {  // no memory for the list
    what.format("could not be connected to: %s", error.what());
  }
  if (socket_ < 0) return fail(ModbusTrouble::kNoConnection, what.c_str());
  ::modbus_set_socket(context_.get(), socket_);
  noteEnds();
  has_answered_ = false;
  trouble_ = ModbusTrouble::kNone;
  return true;
}

void ModbusConnection::noteEnds() noexcept {
  heard_ = {};
  if (settings_.listener == nullptr) return;
  const auto read = [this](auto ask, std::uint32_t& address, std::uint16_t& port) {
    sockaddr_storage end{};
    socklen_t size = sizeof end;
    if (ask(socket_, reinterpret_cast<sockaddr*>(&end), &size) != 0) return;
    if (end.ss_family == AF_INET6) port = ntohs(reinterpret_cast<const sockaddr_in6&>(end).sin6_port);
    if (end.ss_family != AF_INET) return;
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(end);
    address = ntohl(v4.sin_addr.s_addr);
    port = ntohs(v4.sin_port);
  };
  read(::getsockname, heard_.own_address, heard_.own_port);
  read(::getpeername, heard_.server_address, heard_.server_port);
}

void ModbusConnection::hear(bool sent, const ModbusRequest& request, ByteView bytes, Instant time) noexcept {
  if (settings_.listener == nullptr) return;
  heard_.sent = sent;
  heard_.bytes = bytes;
  heard_.time = time;
  heard_.first_register =
      request.function == ModbusFunction::kWriteRegisters ? request.write.first : request.read.first;
  settings_.listener->handleTelegram(heard_);
  (sent ? heard_.bytes_sent : heard_.bytes_received) += static_cast<std::uint32_t>(bytes.size());
  heard_.bytes = {};
}

// Whatever lies there now is no answer to a request that has not been sent.
bool ModbusConnection::isQuiet() noexcept {
  std::uint8_t waiting[kLongestAdu];
  const ssize_t size = ::recv(socket_, waiting, sizeof waiting, MSG_PEEK | MSG_DONTWAIT);
  Sentence what;
  if (size > 0) {
    what.format("sent %zd bytes nobody asked for: an answer twice or too late", size);
    return fail(ModbusTrouble::kUnasked, what.c_str());
  }
  if (size == 0) return fail(ModbusTrouble::kClosed, "has closed the connection");
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return true;
  what.format("has lost the connection: %s", ErrorText(errno).c_str());
  return fail(ModbusTrouble::kClosed, what.c_str());
}

bool ModbusConnection::send(const ModbusAdu& bytes) noexcept {
  const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent == static_cast<ssize_t>(bytes.size())) return true;
  Sentence what;
  if (sent >= 0 || errno == EAGAIN || errno == EWOULDBLOCK) {
    what.format("takes no more requests: what was sent before is still unread");
  } else {
    what.format("has lost the connection: %s", ErrorText(errno).c_str());
  }
  return fail(ModbusTrouble::kClosed, what.c_str());
}

bool ModbusConnection::exchange(ModbusRequest request, const Wakeup& stop) noexcept {
  if (socket_ < 0) return fail(ModbusTrouble::kNoConnection, "is not connected");
  if (!isQuiet()) return false;
  request.unit = settings_.unit;
  request.transaction = ++transaction_;
  sent_ = now();
  const Instant until = sent_ + settings_.response_timeout;
  const ModbusAdu bytes = toBytes(request);
  if (!send(bytes)) return false;
  hear(true, request, ByteView{bytes}, sent_);
  if (!waitAnswer(request, until, stop) || !readAnswer(request, until)) return false;
  hear(false, request, ByteView{answer_}, now());
  const AnswerVerdict verdict = judge(request, ByteView{answer_});
  if (!verdict.good()) {
    const bool refused = verdict.fault == AnswerFault::kException;
    if (refused) exception_ = verdict.found;
    return fail(refused ? ModbusTrouble::kException : ModbusTrouble::kBadAnswer, describe(request, verdict).c_str());
  }
  has_answered_ = true;
  trouble_ = ModbusTrouble::kNone;
  return true;
}

bool ModbusConnection::waitAnswer(const ModbusRequest& request, Instant until, const Wakeup& stop) noexcept {
  Sentence what;
  switch (waitReadable(socket_, until, stop)) {
    case Wait::kReadable:
      return true;
    case Wait::kStopped:
      return fail(ModbusTrouble::kCancelled, "was not waited for: the link is being closed");
    case Wait::kTimeout:
      break;
  }
  const double seconds = toSeconds(settings_.response_timeout);
  if (has_answered_) {
    what.format("has not answered %s within %.3f s", describe(request).c_str(), seconds);
  } else {
    what.format(
        "accepts the connection, but has never answered on it (%s, %.3f s): is it a Modbus/TCP server, and is "
        "another client connected?",
        describe(request).c_str(), seconds);
  }
  return fail(ModbusTrouble::kSilent, what.c_str());
}

bool ModbusConnection::readAnswer(const ModbusRequest& request, Instant until) noexcept {
  const auto left = std::chrono::duration_cast<std::chrono::microseconds>(until - now()).count();
  const auto microseconds = static_cast<std::uint32_t>(std::max<long>(1000, left));
  ::modbus_set_response_timeout(context_.get(), microseconds / 1'000'000, microseconds % 1'000'000);
  answer_.resize(kLongestAdu);
  const int size = ::modbus_receive_confirmation(context_.get(), answer_.data());
  if (size >= 0) {
    answer_.resize(static_cast<std::size_t>(size));
    return true;
  }
  const int error = errno;
  answer_.clear();
  Sentence what;
  if (error == ETIMEDOUT) {
    what.format("has answered %s only in part within %.3f s", describe(request).c_str(),
                toSeconds(settings_.response_timeout));
    return fail(ModbusTrouble::kPartial, what.c_str());
  }
  if (error >= MODBUS_ENOBASE) {
    what.format("answers %s with what is no Modbus telegram (%s)", describe(request).c_str(), ::modbus_strerror(error));
    return fail(ModbusTrouble::kBadAnswer, what.c_str());
  }
  what.format("has closed the connection instead of answering %s (%s)", describe(request).c_str(),
              ErrorText(error).c_str());
  return fail(ModbusTrouble::kClosed, what.c_str());
}

bool ModbusConnection::isLate(Instant until, const Wakeup& stop) noexcept {
  if (socket_ < 0 || waitReadable(socket_, until, stop) != Wait::kReadable) return false;
  const Duration after = now() - sent_;
  std::uint8_t byte = 0;
  if (::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) <= 0) return false;
  Sentence what;
  what.format("answered %.3f s after the request, too late for the response time-out of %.3f s", toSeconds(after),
              toSeconds(settings_.response_timeout));
  reason_.format("%s %s", settings_.server.c_str(), what.c_str());
  return true;
}

void ModbusConnection::close() noexcept {
  if (socket_ < 0) return;
  ::modbus_close(context_.get());
  socket_ = -1;
}

void ModbusConnection::abandon() noexcept {
  if (socket_ < 0) return;
  const linger at_once{1, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  ::close(socket_);
  ::modbus_set_socket(context_.get(), -1);
  socket_ = -1;
}

}  // namespace nord_driver::link
